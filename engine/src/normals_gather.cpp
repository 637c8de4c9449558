#include <algorithm>
#include <cstring>

#include "hedgerow/normals.h"
#include "kernels/gather_normals.h"
#include "normals_check.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kGrain = 1 << 12;      // vertices a task
constexpr Index kFaceGrain = 1 << 13;  // faces a task

// One set per task that may run at once, then the face vectors.
struct Plan {
  Index task_count = 0;
  Index slot_count = 0;
  Index grain = 0;
  std::size_t set_bytes = 0;
  std::size_t face_bytes = 0;

  [[nodiscard]] std::size_t scratch_bytes() const noexcept {
    return static_cast<std::size_t>(slot_count) * set_bytes + face_bytes;
  }
};

Plan plan_of(const Connectivity& mesh, const NormalOptions& options,
             const Execution& execution) noexcept {
  Plan plan;
  const Index vertices = mesh.vertex_count();
  plan.grain = par::grain_of(execution, kGrain);
  plan.task_count = vertices / plan.grain + (vertices % plan.grain != 0 ? 1 : 0);
  plan.slot_count = par::slot_count(execution, plan.task_count);
  // No vertex of a small mesh can have more corners than are sorted in place.
  if (mesh.halfedge_count() > kernels::kChunk) {
    plan.set_bytes = kernels::HalfedgeSet::bytes(mesh.halfedge_count());
  }
  if (!mesh.is_triangle_mesh() && options.weight != NormalWeight::max) {
    plan.face_bytes = static_cast<std::size_t>(mesh.face_count()) * sizeof(kernels::Wide);
  }
  return plan;
}

template <class View>
NormalStats run(const View& view, const Plan& plan, const kernels::GatherInput& input,
                const kernels::NormalWriter& writer, const Execution& execution, std::byte* sets) {
  const Index vertices = view.vertex_count();
  return par::reduce_tasks<NormalStats>(
      execution, plan.task_count,
      [&](Index task, Index slot) {
        kernels::HalfedgeSet spill(sets + static_cast<std::size_t>(slot) * plan.set_bytes,
                                   view.halfedge_count());
        const Index begin = task * plan.grain;
        const Index end = vertices - begin < plan.grain ? vertices : begin + plan.grain;
        return kernels::gather_normals({begin, end}, view, input, spill, writer);
      },
      kernels::merge);
}

}  // namespace

std::size_t gather_vertex_normals_scratch_bytes(const Connectivity& mesh,
                                                const NormalOptions& options,
                                                const Execution& execution) {
  return plan_of(mesh, options, execution).scratch_bytes();
}

Result<NormalStats> gather_vertex_normals(const Connectivity& mesh, Positions positions,
                                          NormalsOut out, const NormalOptions& options,
                                          const Execution& execution, Workspace& workspace) {
  const std::int64_t vertices = mesh.vertex_count();
  if (auto ok = detail::check_arrays(positions, vertices, out, vertices); !ok) {
    return fail(ok.error());
  }
  if (vertices == 0) return NormalStats{};
  const Plan plan = plan_of(mesh, options, execution);
  if (!workspace.reserve(plan.scratch_bytes())) {
    return fail({ErrorCode::scratch_too_small, kInvalidIndex,
                 static_cast<std::int64_t>(workspace.size_bytes()),
                 static_cast<std::int64_t>(plan.scratch_bytes())});
  }
  std::byte* sets = workspace.data();
  const std::size_t all_sets = static_cast<std::size_t>(plan.slot_count) * plan.set_bytes;
  if (all_sets > 0) std::memset(sets, 0, all_sets);

  kernels::GatherInput input{{positions},           options.weight,          mesh.origin().data(),
                             mesh.halfedge_count(), mesh.is_triangle_mesh(), nullptr};
  if (plan.face_bytes > 0) {
    auto* faces = reinterpret_cast<kernels::Wide*>(sets + all_sets);
    const kernels::FaceSource source(face_list(mesh));
    par::for_each_range(execution.with_grain(0), mesh.face_count(), kFaceGrain,
                        [&](IndexRange range) {
                          kernels::fill_face_vectors(range, source, input.points, options.weight,
                                                     options.polygon, faces);
                        });
    input.faces = faces;
  }
  // Not streamed: groups of 16 vertices are too few to wait for the end of their writes.
  const kernels::NormalWriter writer{out, options.degenerate};
  return mesh.visit(
      [&](const auto& view) { return run(view, plan, input, writer, execution, sets); });
}

}  // namespace hedgerow
