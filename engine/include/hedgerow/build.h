#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/defect.h"
#include "hedgerow/execution.h"
#include "hedgerow/face_list.h"
#include "hedgerow/result.h"

namespace hedgerow {

/// Which way the builder brings the corners of a vertex together; the result is the same.
enum class BuildStrategy : std::uint8_t {
  automatic,  ///< chosen from a measure of the input's locality
  window,     ///< each block of vertices scans the runs of faces that touch it: local input
  partition,  ///< corners are first partitioned by block of vertices: any input
};

namespace detail {
struct BuildScratch;
}

/// Memory that one build leaves for the next, so that a second build of the same size and threads
/// allocates nothing but its result.
///
/// Threads    One build at a time.
/// Lifetime   Holds nothing that a result refers to: it may go before or after.
class BuildWorkspace {
 public:
  BuildWorkspace();
  BuildWorkspace(BuildWorkspace&&) noexcept;
  BuildWorkspace& operator=(BuildWorkspace&&) noexcept;
  ~BuildWorkspace();

  /// For `build` alone. \pre not moved from
  [[nodiscard]] detail::BuildScratch& scratch() const noexcept { return *scratch_; }

 private:
  std::unique_ptr<detail::BuildScratch> scratch_;
};

struct BuildOptions {
  Policies policies{};
  /// View the caller's corner (and offset) arrays as the `origin` (and `first`) column instead of
  /// copying them. They must then outlive the mesh and stay unchanged. Ignored where the faces are
  /// not `FaceList::is_native`, or a policy changed the face list.
  bool borrow_corners = false;
  BuildStrategy strategy = BuildStrategy::automatic;
  /// Scratch memory to use and to grow; null: the build brings its own and frees it.
  BuildWorkspace* workspace = nullptr;
};

/// What the build counted, beside the defects.
struct BuildStats {
  std::int64_t edge_count = 0;           ///< distinct unordered vertex pairs on kept faces
  std::int64_t boundary_edge_count = 0;  ///< of those, with exactly one half-edge
  std::array<std::int64_t, kDefectKindCount> defect_count{};
  BuildStrategy strategy = BuildStrategy::automatic;  ///< the one that was used
  /// Corner visits plus comparisons made while pairing: grows linearly with the input whatever its
  /// valences are.
  std::int64_t step_count = 0;
  /// Faces scanned per face by the window strategy, times 1000; 0 for partition.
  std::int64_t scan_per_mille = 0;
};

struct BuildOutput {
  Connectivity mesh;
  /// All defects of the input, in the order of `DefectKind`, then of the element that names it.
  Buffer<Defect> defects;
  BuildStats stats;
  /// faces_new_to_old[f] is the input face that became f. Empty: no face was dropped.
  Buffer<Index> faces_new_to_old;
  /// vertices_new_to_old[v] is the input vertex that v is or was split from. Empty: none was
  /// added or dropped.
  Buffer<Index> vertices_new_to_old;
};

/// Builds connectivity from a face list, and classifies every defect in the same passes. Numbering
/// the half-edges by corners is that of S. Campagna, L. Kobbelt and H.-P. Seidel, "Directed edges",
/// 1998.
///
/// Pre        The arrays of `faces` are as long as it says; what stands in them may be anything.
/// Pairs      Two half-edges become opposite if they are the only ones on their edge and run in
///            different directions; anything else is left without opposite and reported.
/// Output     Canonical form (I8), default boundary form; `outgoing[v]` starts the fan that holds
///            the smallest half-edge leaving v: at the end of the fan if the fan is open, at that
///            half-edge if it is closed.
/// Complexity O(V + H), whatever the valences. Bytes: reads 4 H (twice when the input is local),
///            writes 4 H + 4 V; scratch 16 H more when it is not (20 H of polygons).
/// Errors     What `check(FaceList)` finds, unsupported_policy, and the first defect whose policy
///            is `fail`. Throws std::bad_alloc. On either, nothing has happened.
/// Threads    Those of `execution`; same bytes for all of them.
/// Lifetime   The result shares nothing with `faces`, unless `borrow_corners` says so.
[[nodiscard]] Result<BuildOutput> build(const FaceList& faces, const BuildOptions& options,
                                        const Execution& execution);

/// The same, from buffers that the mesh takes over as its `origin` and `first` columns: no copy.
/// `offsets` empty means triangles. The buffers are only moved from on success.
[[nodiscard]] Result<BuildOutput> build(Buffer<Index>&& corners, Buffer<Index>&& offsets,
                                        std::int64_t vertex_count, const BuildOptions& options,
                                        const Execution& execution);

}  // namespace hedgerow
