#include "gather_plan.h"
#include "hedgerow/normals.h"
#include "kernels/gather_normals.h"
#include "normals_check.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kGatheredFaceGrain = 1 << 13;  // faces a task

template <class View>
NormalStats run(const View& view, const detail::GatherPlan& plan, detail::GatherScratch& scratch,
                const kernels::GatherInput& input, const kernels::NormalWriter& writer,
                const Execution& execution) {
  const Index vertices = view.vertex_count();
  return par::reduce_tasks<NormalStats>(
      execution, plan.task_count,
      [&](Index task, Index slot) {
        bool is_zero = false;
        kernels::IndexSet spill = scratch.spill(slot, view.halfedge_count(), is_zero);
        const Index begin = task * plan.grain;
        const Index end = vertices - begin < plan.grain ? vertices : begin + plan.grain;
        kernels::TermWindow window = scratch.window(slot, input.weight);
        return kernels::gather_normals({begin, end}, view, input, spill, window, writer);
      },
      kernels::merge);
}

}  // namespace

std::size_t gather_vertex_normals_scratch_bytes(const Connectivity& mesh,
                                                const NormalOptions& options,
                                                const Execution& execution) {
  return detail::gather_plan(mesh, options, execution).scratch_bytes();
}

Result<NormalStats> gather_vertex_normals(const Connectivity& mesh, Positions positions,
                                          NormalsOut out, const NormalOptions& options,
                                          const Execution& execution, Workspace& workspace) {
  const std::int64_t vertices = mesh.vertex_count();
  if (auto ok = detail::check_arrays(positions, vertices, out, vertices); !ok) {
    return fail(ok.error());
  }
  if (vertices == 0) return NormalStats{};
  const detail::GatherPlan plan = detail::gather_plan(mesh, options, execution);
  if (!workspace.reserve(plan.scratch_bytes())) {
    return fail({ErrorCode::scratch_too_small, kInvalidIndex,
                 static_cast<std::int64_t>(workspace.size_bytes()),
                 static_cast<std::int64_t>(plan.scratch_bytes())});
  }
  detail::GatherScratch scratch(plan, workspace);
  kernels::GatherInput input{{positions},
                             options.weight,
                             mesh.origin().data(),
                             mesh.opposite().data(),
                             mesh.halfedge_count(),
                             mesh.is_triangle_mesh(),
                             nullptr};
  if (kernels::Wide* faces = scratch.face_vectors(); faces != nullptr) {
    const kernels::FaceSource source(face_list(mesh));
    par::for_each_range(execution.with_grain(0), mesh.face_count(), kGatheredFaceGrain,
                        [&](IndexRange range) {
                          kernels::fill_face_vectors(range, source, input.points, options.weight,
                                                     options.polygon, faces);
                        });
    input.faces = faces;
  }
  // Not streamed: few normals are written between so many reads that their lines are given up half
  // full.
  const kernels::NormalWriter writer{out, options.degenerate};
  return mesh.visit(
      [&](const auto& view) { return run(view, plan, scratch, input, writer, execution); });
}

}  // namespace hedgerow
