#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tbb/task_arena.h>

#include "frames/rays.h"
#include "frames/stages.h"
#include "hedgerow/dirty_normals.h"
#include "hedgerow/topology.h"
#include "hedgerow/workspace.h"

namespace hedgerow::bench {

enum FramePart : std::size_t { kDeform, kNormals, kRefit, kRays, kHits, kFrameParts };
using PartTimes = std::array<double, kFrameParts>;  ///< milliseconds

/// What changes from frame to frame, and how much is computed again.
enum class Change : std::uint8_t {
  some,        ///< the blob moves; what depends on it is computed again
  some_whole,  ///< the blob moves; everything is computed again, for comparison
  all,         ///< every vertex moves
};

/// The threads of a frame: the calling one, or those of an arena.
struct FrameThreads {
  tbb::task_arena* arena = nullptr;  ///< null: the calling thread

  [[nodiscard]] Execution execution() const;
};

/// Everything that one frame writes. The connectivity is shared.
///
/// Threads    Different frames may be worked on at the same time.
/// Lifetime   `subject` must outlive it.
class Frame {
 public:
  Frame(const Subject& subject, const ray::Device& device, const FrameOptions& options);

  /// Deforms, and brings normals and trees up to date.
  void update(float time, Change change, const FrameThreads& threads, PartTimes& times);
  /// Traces the rays, and asks the mesh at the hits.
  void trace(const FrameThreads& threads, PartTimes& times);

  /// Empty if every answer of the last frame is right, else what is not. Tries `sample` rays.
  [[nodiscard]] std::string check(std::int64_t sample) const;
  /// Rays, hits, and what was dirty.
  [[nodiscard]] std::string rates() const;

  /// Allocations within the refits so far, which are Embree's: see `Scene`.
  [[nodiscard]] std::int64_t refit_allocations() const noexcept { return refit_allocations_; }

  [[nodiscard]] ray::Scene& scene() noexcept { return scene_; }
  [[nodiscard]] Positions positions() const noexcept { return {xyz_.data(), subject_.vertices()}; }

 private:
  [[nodiscard]] NormalsOut normals_out() noexcept { return {normals_.data(), subject_.vertices()}; }
  void move(float time, Change change, const FrameThreads& threads);
  [[nodiscard]] bool compute_all(const Execution& execution);
  [[nodiscard]] bool compute_moved(const Execution& execution);
  template <Topology Mesh>
  [[nodiscard]] float ask(const Mesh& mesh, const ray::HitPacket& packet) const;

  const Subject& subject_;
  Buffer<float> xyz_;
  Buffer<float> normals_;
  DirtySet dirty_;
  Workspace workspace_;
  Packets packets_;
  std::vector<ray::HitPacket> hits_;
  std::vector<float> answers_;
  ray::Scene scene_;
  std::int64_t refit_allocations_ = 0;
  bool is_good_ = true;
};

}  // namespace hedgerow::bench
