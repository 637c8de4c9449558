#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/dirty_normals.h"
#include "hedgerow/execution.h"
#include "hedgerow/positions.h"
#include "hedgerow/ray/ray.h"
#include "hedgerow/result.h"

/// Embree over the engine's own arrays. This library alone includes Embree, and no header of it
/// does.
namespace hedgerow::ray {

/// Positions that Embree may read, with the bytes that are readable from `positions.data` on.
///
/// Embree loads each vertex as 16 bytes, so 16 bytes must be readable from the start of the last
/// one: 4 behind its z where the stride is 12. Scenes refuse what ends earlier (`needs_padding`).
struct PaddedPositions {
  Positions positions{};
  std::size_t readable_bytes = 0;

  /// Over a `Buffer`, which always has readable bytes behind its end.
  [[nodiscard]] static PaddedPositions of(const Buffer<float>& xyz) noexcept {
    return {{xyz.data(), static_cast<std::int64_t>(xyz.size() / 3)},
            xyz.size_bytes() + kReadableTailBytes};
  }
};

/// Bytes that Embree reads of `positions`, from `positions.data` on: 0 if there are none.
[[nodiscard]] std::size_t bytes_read(const Positions& positions) noexcept;

/// A connection to Embree, which scenes share.
///
/// Threads    Starts none: scenes are built in the caller's arena. Leaves tbb::global_control alone
///            and reads no configuration but the file .embree3 that Embree itself looks for in the
///            working and the home directory.
/// Lifetime   Scenes keep it alive.
class Device {
 public:
  /// Errors     ray_library: value = Embree's error code.
  [[nodiscard]] static Result<Device> create();

  Device(Device&&) noexcept;
  Device& operator=(Device&&) noexcept;
  ~Device();

  /// Embree's version as it says it: 31305 is 3.13.5.
  [[nodiscard]] int version() const noexcept;
  /// Bytes that Embree holds for the trees of all scenes of the device.
  [[nodiscard]] std::int64_t held_bytes() const noexcept;

  struct Handle;
  [[nodiscard]] const std::shared_ptr<Handle>& handle() const noexcept { return handle_; }

 private:
  explicit Device(std::shared_ptr<Handle> handle) noexcept;
  std::shared_ptr<Handle> handle_;
};

/// Which tree is built.
enum class Motion : std::uint8_t {
  still,   ///< one tree, best for rays; a change of the positions builds it again
  moving,  ///< a tree for each piece that follows its vertices (refit), and one above them
};

struct SceneOptions {
  Motion motion = Motion::still;
  /// No ray slips through between two faces that share an edge, at some cost per ray.
  bool is_watertight = false;
  /// Moving: faces a piece; 0: one piece. A change refits only the pieces whose faces moved, so
  /// pieces should be near each other in space: faces in a local order. Ignored where a mesh has
  /// faces of several kinds.
  Index piece_faces = 0;
};

/// What a scene had to make besides Embree's trees.
struct SceneStats {
  std::size_t copied_bytes = 0;     ///< of indices; 0 for meshes of triangles or quads only
  std::int64_t piece_count = 0;     ///< geometries that Embree was given
  std::int64_t cut_face_count = 0;  ///< faces with more than four corners, cut into triangles
};

/// A mesh that rays can meet.
///
/// Layout     Embree reads `mesh.origin()` as its index buffer and the caller's positions where
///            they are: nothing is copied of a mesh of triangles or of quads (32-bit indices).
///            Other meshes get a table of 32 bytes a face, in which quads stay quads and larger
///            faces are cut into triangles by the positions of the moment. Quads are cut along the
///            diagonal from corner 1 to corner 3, as Embree does.
/// Faces      Those with a vertex that is not finite, or beyond 1.8e18, are never met. A refit
///            builds the pieces anew that have such a face, or had one.
/// Ties       Where several faces are met at the same t (on a shared edge), which one is found
///            depends on the tree, and the tree on the threads that built it; serial builds give
///            the same tree always. `t` does not depend on it.
/// Memory     Where the pieces are large enough to be refitted, a refit asks Embree for no memory
///            but a string of 31 bytes, its name for a log; nothing else is allocated.
/// Threads    Queries: any number at a time. Everything else: exclusive.
/// Lifetime   The mesh and the positions must outlive the scene, stay where they are, and but for
///            the positions stay as they are.
class Scene {
 public:
  /// Builds the tree on the threads of `execution`; a callback is not used: Embree wants TBB, so
  /// the calling thread builds alone.
  ///
  /// Pre        A sound mesh in either form.
  /// Complexity O(F log F) by Embree.
  /// Errors     count_mismatch, bad_stride, null_pointer, needs_padding; not_canonical;
  ///            too_many_elements: beyond Embree's 2^32 or 16 GB of positions; ray_library.
  ///            Throws std::bad_alloc.
  [[nodiscard]] static Result<Scene> build(const Device& device, const Connectivity& mesh,
                                           const PaddedPositions& positions,
                                           const SceneOptions& options, const Execution& execution);

  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// Follows positions that have changed in place, all of them. A moving scene keeps its trees and
  /// fits their boxes; a still one builds anew. Errors: ray_library. Throws std::bad_alloc; the
  /// scene must then not be queried before a rebuild succeeds.
  [[nodiscard]] Result<void> refit(const Execution& execution);
  /// The same, and the positions are elsewhere from now on, e.g. in the other of two buffers.
  /// Errors: those of `build`, with nothing changed.
  [[nodiscard]] Result<void> refit(const PaddedPositions& positions, const Execution& execution);
  /// Follows positions of which only those have changed that `dirty` was found for: refits the
  /// pieces with a dirty face, and the tree above. Embree cannot refit less than a piece.
  ///
  /// Pre        `dirty` is of the mesh that the scene was built from.
  /// Complexity O(dirty faces + faces of their pieces + pieces).
  [[nodiscard]] Result<void> refit(const DirtySet& dirty, const Execution& execution);
  /// Builds all trees anew, as after a deformation that boxes no longer fit well.
  [[nodiscard]] Result<void> rebuild(const Execution& execution);

  [[nodiscard]] const SceneStats& stats() const noexcept;
  [[nodiscard]] PrimitiveMap primitives() const noexcept;
  /// Pieces whose vertices the last refit looked at: all of them unless it was told what moved.
  [[nodiscard]] std::int64_t refitted_pieces() const noexcept;
  /// Whether the last of `build`, `refit` and `rebuild` built the tree of some piece. Pieces of up
  /// to four faces have none: Embree puts them into the tree above.
  [[nodiscard]] bool has_built() const noexcept;

  /// The first face on the ray, from either side. A ray with a NaN meets nothing.
  [[nodiscard]] Hit intersect(const Ray& ray,
                              Coherence coherence = Coherence::incoherent) const noexcept;
  /// Whether any face is on the ray.
  [[nodiscard]] bool is_occluded(const Ray& ray,
                                 Coherence coherence = Coherence::incoherent) const noexcept;
  /// Eight rays at once. \pre 0 <= rays.count <= 8
  [[nodiscard]] HitPacket intersect(const RayPacket& rays,
                                    Coherence coherence = Coherence::coherent) const noexcept;
  [[nodiscard]] OccludedPacket is_occluded(
      const RayPacket& rays, Coherence coherence = Coherence::coherent) const noexcept;

  /// The point of the surface closest to `from`, if it is not further than `radius`. Distances are
  /// computed in double from the float coordinates; of faces equally close the smallest primitive
  /// is taken, whatever the tree. O(log F) where faces are spread out.
  [[nodiscard]] ClosestPoint closest_point(
      const Vec3& from, float radius = std::numeric_limits<float>::infinity()) const noexcept;

  struct Impl;

 private:
  explicit Scene(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hedgerow::ray
