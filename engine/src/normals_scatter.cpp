#include <algorithm>

#include "hedgerow/normals.h"
#include "kernels/scatter_normals.h"
#include "normals_check.h"
#include "parallel/parallel.h"
#include "scatter/run_table.h"
#include "scatter/sliding_sums.h"

namespace hedgerow {

namespace {

using detail::RunTable;
using detail::ScatterPlan;
using detail::WindowPlan;

// Blocks a task: the fewest that keep the visits of runs below 3/2 of the corners, and no more
// tasks than threads where no number does (faces in random order).
Index fewest_blocks(const RunTable& table, const Execution& execution,
                    std::int64_t corner_count) noexcept {
  const ScatterPlan& plan = table.plan();
  const auto threads = static_cast<Index>(execution.threads());
  const Index per_thread = (plan.block_count + threads - 1) / threads;
  for (Index size = 1; size < per_thread; size *= 2) {
    std::int64_t visited = 0;
    for (Index run = 0; run < plan.run_count && 2 * visited <= 3 * corner_count; ++run) {
      visited += table.corner_count(run) * table.count_groups(run, size);
    }
    if (2 * visited <= 3 * corner_count) return size;
  }
  return std::max<Index>(per_thread, 1);
}

// More blocks a task where nearly all of these can slide a window over them.
WindowPlan plan_tasks(const RunTable& table, const Execution& execution,
                      std::int64_t corner_count) noexcept {
  constexpr Index kTasksPerThread = 8;
  const Index fewest = fewest_blocks(table, execution, corner_count);
  const Index wanted =
      table.plan().block_count / (kTasksPerThread * static_cast<Index>(execution.threads()));
  if (wanted > fewest) {
    const WindowPlan plan(table, wanted);
    if (8 * plan.sliding_count() >= 7 * plan.large_count()) return plan;
  }
  return WindowPlan(table, fewest);
}

}  // namespace

std::size_t scatter_vertex_normals_scratch_bytes(const FaceList& faces, const NormalOptions&,
                                                 const Execution& execution) {
  return detail::scatter_plan(faces, execution).scratch_bytes();
}

Result<NormalStats> scatter_vertex_normals(const FaceList& faces, Positions positions,
                                           NormalsOut out, const NormalOptions& options,
                                           const Execution& execution, Workspace& workspace) {
  if (auto ok = check(faces); !ok) return fail(ok.error());
  if (auto ok = detail::check_arrays(positions, faces.vertex_count, out, faces.vertex_count); !ok) {
    return fail(ok.error());
  }
  const ScatterPlan plan = detail::scatter_plan(faces, execution);
  if (!workspace.reserve(plan.scratch_bytes())) {
    return fail({ErrorCode::scratch_too_small, kInvalidIndex,
                 static_cast<std::int64_t>(workspace.size_bytes()),
                 static_cast<std::int64_t>(plan.scratch_bytes())});
  }
  const kernels::ScatterInput input{
      kernels::FaceSource(faces), {positions}, options.weight, options.polygon};
  RunTable table(plan, input.faces, workspace.data());
  if (!table.fill(execution)) return fail(detail::find_bad_index(input.faces));

  auto* sums = reinterpret_cast<kernels::VertexSum*>(workspace.data() + plan.table_bytes());
  const kernels::NormalWriter writer =
      detail::normal_writer(out, faces.vertex_count, options.degenerate);
  const WindowPlan windows = plan_tasks(table, execution, faces.corner_count());
  // Sums are only needed while their task is at work, so tasks take turns in the same memory.
  const bool has_turns = par::slot_count(execution, windows.task_count()) < windows.task_count();
  return par::reduce_tasks<NormalStats>(
      execution, windows.task_count(),
      [&](Index task, Index slot) {
        const std::size_t place = static_cast<std::size_t>(has_turns ? slot : task) *
                                  (static_cast<std::size_t>(windows.group()) << plan.block_shift);
        return windows.slides(task)
                   ? detail::scatter_sliding(input, table, windows, task, sums + place, writer)
                   : detail::scatter_whole(input, table, windows.blocks_of(task), sums + place,
                                           writer);
      },
      kernels::merge);
}

}  // namespace hedgerow
