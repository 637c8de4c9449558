// Loop: triangles in four.
#include "kernels/refine_points.h"
#include "subdivide/level.h"

namespace hedgerow::subdivision {

namespace {

void place_quarters(const TriangleView& mesh, const Level& level, const Ranks& edges,
                    const Execution& execution, Child& child) {
  const Positions& old = level.positions;
  const kernels::Sharpness<TriangleView> sharpness{mesh, level.sharpness};
  const auto smooth_edge = [&](HalfedgeId h) {
    const auto corner = [&](HalfedgeId g) { return kernels::point_at(old, mesh.origin[g]); };
    return 0.375 * (corner(h) + corner(mesh.next(h))) +
           0.125 * (corner(mesh.prev(h)) + corner(mesh.prev(mesh.opposite[h])));
  };
  par::for_each_range(execution, mesh.halfedge_count(), kLevelGrain, [&](IndexRange range) {
    for (Index i = range.begin; i < range.end; ++i) {
      const HalfedgeId h(i);
      if (kernels::smaller_side(mesh, h) != h) continue;
      kernels::store(kernels::edge_point(mesh, old, sharpness, h, smooth_edge),
                     child.point(mesh.vertex_count() + edges.before[at(i)]));
    }
  });
  const auto smooth = [&](VertexId v) { return kernels::loop_smooth(mesh, old, v); };
  par::for_each_range(execution, mesh.vertex_count(), kLevelGrain, [&](IndexRange range) {
    for (Index v = range.begin; v < range.end; ++v) {
      kernels::store(
          kernels::vertex_point(mesh, old, sharpness, VertexId(v), smooth, kernels::spline_point),
          child.point(v));
    }
  });
}

}  // namespace

Result<SubdivisionOutput> refine_quarters(const TriangleView& mesh, const Level& level,
                                          const Execution& execution) {
  const Index parents = mesh.halfedge_count();
  const Result<Index> halfedges = checked_count(std::int64_t{4} * parents);
  if (!halfedges) return fail(halfedges.error());
  const Ranks edges = rank_edges(mesh, execution);
  const Result<Index> vertices = checked_count(std::int64_t{mesh.vertex_count()} + edges.count);
  if (!vertices) return fail(vertices.error());

  Child child(*vertices, *halfedges);
  par::for_each_range(execution, parents, kLevelGrain, [&](IndexRange range) {
    kernels::fill_quarters(range, mesh, edges.before.data(), child.columns());
  });
  const TriangleView triangles = triangle_view(child);
  const auto seed = [](HalfedgeId h) { return HalfedgeId(kernels::corner_child(h)); };
  start_old_as_before(mesh, triangles, seed, execution, child);
  par::for_each_range(execution, parents, kLevelGrain, [&](IndexRange range) {
    for (Index h = range.begin; h < range.end; ++h) {
      if (kernels::smaller_side(mesh, HalfedgeId(h)).value != h) continue;
      child.outgoing[at(mesh.vertex_count() + edges.before[at(h)])] =
          kernels::quarter_edge_start(mesh, HalfedgeId(h));
    }
  });
  place_quarters(mesh, level, edges, execution, child);
  SubdivisionOutput output;
  output.sharpness = halve_sharpness(
      mesh, level.sharpness, at(*halfedges),
      [&](HalfedgeId h) {
        return std::pair(kernels::corner_child(h), kernels::corner_child(mesh.next(h)) + 2);
      },
      execution);
  output.positions = std::move(child.xyz);
  output.mesh = finish_triangles(child);
  return output;
}

}  // namespace hedgerow::subdivision
