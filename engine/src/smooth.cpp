#include "hedgerow/smooth.h"

#include "float3_check.h"
#include "kernels/smooth_vertices.h"
#include "parallel/parallel.h"
#include "triangle_mesh.h"

namespace hedgerow {

namespace {

constexpr Index kSmoothGrain = 1 << 11;

using kernels::SmoothStep;

Positions as_input(const MutablePositions& positions) noexcept {
  return {positions.data, positions.count, positions.stride_bytes};
}

// To and fro between the caller's array and the scratch, from which the last is copied back.
template <class Mesh>
void smooth_double_buffered(const Mesh& mesh, const MutablePositions& own,
                            const MutablePositions& scratch, const SmoothOptions& options,
                            const Execution& execution) {
  const auto run = [&](const auto& kernel) {
    par::for_each_range(execution, mesh.vertex_count(), kSmoothGrain, kernel);
  };
  for (int i = 0; i < options.iterations; ++i) {
    const MutablePositions& from = i % 2 == 0 ? own : scratch;
    const MutablePositions& to = i % 2 == 0 ? scratch : own;
    const SmoothStep step{as_input(from), to, options.step};
    run([&](IndexRange range) { kernels::smooth_vertices(range, mesh, step, options.weights); });
  }
  if (options.iterations % 2 == 1) {
    run([&](IndexRange range) { kernels::copy_positions(range, as_input(scratch), own); });
  }
}

}  // namespace

Result<void> smooth(const Connectivity& mesh, MutablePositions positions,
                    const SmoothOptions& options, const Execution& execution,
                    Workspace& workspace) {
  HEDGEROW_ASSERT(options.step > 0 && options.step <= 1);
  if (auto ok = detail::check_float3(positions, mesh.vertex_count()); !ok) return ok;
  if (options.weights == SmoothWeights::cotangent) {
    if (auto ok = detail::check_triangles(mesh); !ok) return ok;
  }
  if (options.update == SmoothUpdate::in_place) {
    mesh.visit([&](const auto& view) {
      const SmoothStep step{as_input(positions), positions, options.step};
      for (int i = 0; i < options.iterations; ++i) {
        kernels::smooth_vertices({0, view.vertex_count()}, view, step, options.weights);
      }
    });
    return {};
  }
  const std::size_t bytes = static_cast<std::size_t>(mesh.vertex_count()) * sizeof(float[3]);
  if (!workspace.reserve(bytes)) {
    return fail({ErrorCode::scratch_too_small, kInvalidIndex,
                 static_cast<std::int64_t>(workspace.size_bytes()),
                 static_cast<std::int64_t>(bytes)});
  }
  const MutablePositions scratch{reinterpret_cast<float*>(workspace.data()), mesh.vertex_count()};
  mesh.visit([&](const auto& view) {
    smooth_double_buffered(view, positions, scratch, options, execution);
  });
  return {};
}

}  // namespace hedgerow
