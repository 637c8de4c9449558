// Catmull and Clark: any faces to quads.
#include "kernels/refine_points.h"
#include "subdivide/level.h"

namespace hedgerow::subdivision {

namespace {

Connectivity finish_quads(Child& child, Index face_count, const Execution& execution) {
  ConnectivityColumns columns;
  Buffer<Index> next(child.origin.size());
  Buffer<Index> face(child.origin.size());
  Buffer<Index> first(at(face_count) + 1);
  first[at(face_count)] = 4 * face_count;
  par::for_each_range(execution, face_count, kLevelGrain, [&](IndexRange range) {
    for (Index f = range.begin; f < range.end; ++f) {
      first[at(f)] = 4 * f;
      for (Index k = 0; k < 4; ++k) {
        next[at(4 * f + k)] = 4 * f + (k + 1) % 4;
        face[at(4 * f + k)] = f;
      }
    }
  });
  columns.origin = std::move(child.origin);
  columns.opposite = std::move(child.opposite);
  columns.outgoing = std::move(child.outgoing);
  columns.fans = Buffer<FanStart>::copy_of(child.fans);
  columns.next = std::move(next);
  columns.face = std::move(face);
  columns.first = std::move(first);
  return Connectivity(std::move(columns));
}

template <Topology Mesh>
void place_quads(const Mesh& mesh, const Level& level, const Ranks& edges,
                 const Execution& execution, Child& child) {
  const Positions& old = level.positions;
  const kernels::Sharpness<Mesh> sharpness{mesh, level.sharpness};
  const Index face_base = mesh.vertex_count();
  const Index edge_base = face_base + mesh.face_count();
  par::for_each_range(execution, mesh.face_count(), kLevelGrain, [&](IndexRange range) {
    for (Index f = range.begin; f < range.end; ++f) {
      kernels::store(kernels::face_centre(mesh, old, FaceId(f)), child.point(face_base + f));
    }
  });
  const Positions centres{child.point(face_base), mesh.face_count()};
  const auto smooth_edge = [&](HalfedgeId h) {
    const VertexId left(mesh.face(h).value);
    const VertexId right(mesh.face(mesh.opposite[h]).value);
    return 0.25 *
           ((kernels::point_at(old, mesh.origin[h]) + kernels::point_at(old, mesh.target(h))) +
            (kernels::point_at(centres, left) + kernels::point_at(centres, right)));
  };
  par::for_each_range(execution, mesh.halfedge_count(), kLevelGrain, [&](IndexRange range) {
    for (Index i = range.begin; i < range.end; ++i) {
      const HalfedgeId h(i);
      if (kernels::smaller_side(mesh, h) != h) continue;
      kernels::store(kernels::edge_point(mesh, old, sharpness, h, smooth_edge),
                     child.point(edge_base + edges.before[at(i)]));
    }
  });
  const auto smooth = [&](VertexId v) { return kernels::quad_smooth(mesh, old, centres, v); };
  par::for_each_range(execution, mesh.vertex_count(), kLevelGrain, [&](IndexRange range) {
    for (Index v = range.begin; v < range.end; ++v) {
      kernels::store(
          kernels::vertex_point(mesh, old, sharpness, VertexId(v), smooth, kernels::spline_point),
          child.point(v));
    }
  });
}

template <Topology Mesh>
Result<SubdivisionOutput> refine_view(const Mesh& mesh, const Level& level,
                                      const Execution& execution) {
  const Index parents = mesh.halfedge_count();
  const Result<Index> halfedges = checked_count(std::int64_t{4} * parents);
  if (!halfedges) return fail(halfedges.error());
  const Ranks edges = rank_edges(mesh, execution);
  const Index edge_base = mesh.vertex_count() + mesh.face_count();
  const Result<Index> vertices =
      checked_count(std::int64_t{mesh.vertex_count()} + mesh.face_count() + edges.count);
  if (!vertices) return fail(vertices.error());

  Child child(*vertices, *halfedges);
  par::for_each_range(execution, parents, kLevelGrain, [&](IndexRange range) {
    kernels::fill_quads(range, mesh, edges.before.data(), child.columns());
  });
  const kernels::QuadView quads{{child.origin.data(), *halfedges},
                                {child.opposite.data(), *halfedges}};
  start_old_as_before(
      mesh, quads, [](HalfedgeId h) { return HalfedgeId(4 * h.value); }, execution, child);
  par::for_each_range(execution, mesh.face_count(), kLevelGrain, [&](IndexRange range) {
    for (Index f = range.begin; f < range.end; ++f) {
      // One half-edge leaves the centre towards each side of the face: the first has the first.
      child.outgoing[at(mesh.vertex_count() + f)] = 4 * mesh.first(FaceId(f)).value + 2;
    }
  });
  par::for_each_range(execution, parents, kLevelGrain, [&](IndexRange range) {
    for (Index h = range.begin; h < range.end; ++h) {
      if (kernels::smaller_side(mesh, HalfedgeId(h)).value != h) continue;
      child.outgoing[at(edge_base + edges.before[at(h)])] =
          kernels::quad_edge_start(mesh, HalfedgeId(h));
    }
  });
  place_quads(mesh, level, edges, execution, child);
  SubdivisionOutput output;
  output.sharpness = halve_sharpness(
      mesh, level.sharpness, at(*halfedges),
      [&](HalfedgeId h) { return std::pair(4 * h.value, 4 * mesh.next(h).value + 3); }, execution);
  output.positions = std::move(child.xyz);
  output.mesh = finish_quads(child, parents, execution);
  return output;
}

}  // namespace

Result<SubdivisionOutput> refine_quads(const Level& level, const Execution& execution) {
  return level.mesh->visit([&](const auto& view) { return refine_view(view, level, execution); });
}

}  // namespace hedgerow::subdivision
