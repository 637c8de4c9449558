#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/normals.h"
#include "hedgerow/workspace.h"
#include "kernels/gather_normals.h"
#include "parallel/parallel.h"

namespace hedgerow::detail {

/// How walking normals are cut into tasks, and what they need of a workspace: one set for each task
/// that may run at once, then the face vectors of polygons.
struct GatherPlan {
  Index task_count = 0;
  Index slot_count = 0;
  Index grain = 0;
  std::size_t set_bytes = 0;
  Index window_faces = 0;
  std::size_t window_bytes = 0;
  std::size_t face_bytes = 0;

  /// Of a task: its set, then its window.
  [[nodiscard]] std::size_t task_bytes() const noexcept { return set_bytes + window_bytes; }
  [[nodiscard]] std::size_t all_task_bytes() const noexcept {
    return static_cast<std::size_t>(slot_count) * task_bytes();
  }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept { return all_task_bytes() + face_bytes; }
};

[[nodiscard]] inline GatherPlan gather_plan(const Connectivity& mesh, const NormalOptions& options,
                                            const Execution& execution) noexcept {
  // Vertices a task: each computes the faces of its first row of vertices again for its window.
  constexpr Index kSmallGrain = 1 << 14;
  constexpr Index kLargeGrain = 1 << 15;
  constexpr Index kTasks = 64;  // wanted, between the two sizes
  GatherPlan plan;
  const Index vertices = mesh.vertex_count();
  plan.grain = par::grain_of(execution, std::clamp(vertices / kTasks, kSmallGrain, kLargeGrain));
  plan.task_count = vertices / plan.grain + (vertices % plan.grain != 0 ? 1 : 0);
  plan.slot_count = par::slot_count(execution, plan.task_count);
  // No vertex of a small mesh can have more corners than are sorted in place.
  if (mesh.halfedge_count() > kernels::kChunk) {
    plan.set_bytes = kernels::IndexSet::bytes(mesh.halfedge_count());
  }
  if (mesh.is_implicit()) {
    plan.window_faces = kernels::TermWindow::capacity_for(mesh.face_count(), options.weight);
    plan.window_bytes = kernels::TermWindow::bytes(plan.window_faces, options.weight);
  }
  if (!mesh.is_triangle_mesh() && options.weight != NormalWeight::max) {
    plan.face_bytes = static_cast<std::size_t>(mesh.face_count()) * sizeof(kernels::Wide);
  }
  return plan;
}

/// The pieces of a workspace that holds what the plan asks for. Sets are cleared when a vertex with
/// many corners needs one: a bit for each half-edge is more than an update of a few vertices costs.
class GatherScratch {
 public:
  GatherScratch(const GatherPlan& plan, Workspace& workspace) noexcept
      : plan_(plan), memory_(workspace.data()) {}

  /// \pre one task at a time has the slot; `own` is false, of the task, and outlives the set
  [[nodiscard]] kernels::IndexSet spill(Index slot, Index halfedge_count, bool& own) noexcept {
    const auto i = static_cast<std::size_t>(slot);
    // What a task has cleared stays so for the next one, as far as there are flags for it.
    return {memory_ + i * plan_.task_bytes(), halfedge_count,
            i < is_zero_.size() ? &is_zero_[i] : &own};
  }
  /// \pre as above
  [[nodiscard]] kernels::TermWindow window(Index slot, NormalWeight weight) noexcept {
    std::byte* task = memory_ + static_cast<std::size_t>(slot) * plan_.task_bytes();
    return {task + plan_.set_bytes, plan_.window_faces, weight};
  }
  /// Null where none are needed.
  [[nodiscard]] kernels::Wide* face_vectors() const noexcept {
    if (plan_.face_bytes == 0) return nullptr;
    return reinterpret_cast<kernels::Wide*>(memory_ + plan_.all_task_bytes());
  }

 private:
  const GatherPlan& plan_;
  std::byte* memory_;
  std::array<bool, 256> is_zero_{};
};

}  // namespace hedgerow::detail
