// Kobbelt's sqrt(3): triangles in three, then turned.
#include "kernels/refine_points.h"
#include "subdivide/level.h"

namespace hedgerow::subdivision {

namespace {

// The two points that cut a boundary edge, and the ends of it.
void place_thirds(const TriangleView& mesh, const Positions& old, const kernels::Apexes& apexes,
                  IndexRange faces, Child& child) {
  for (Index f = faces.begin; f < faces.end; ++f) {
    float* out = child.point(apexes.first(FaceId(f)));
    const HalfedgeId first = mesh.first(FaceId(f));
    HalfedgeId h = first;
    while (h.value < first.value + 3 && !apexes.cuts(h)) ++h.value;
    if (h.value == first.value + 3) {
      kernels::store(kernels::face_centre(mesh, old, FaceId(f)), out);
      continue;
    }
    const auto corner = [&](HalfedgeId g) { return kernels::point_at(old, mesh.origin[g]); };
    const kernels::Point a = corner(h);
    const kernels::Point b = corner(mesh.next(h));
    const kernels::Point before = corner(kernels::boundary_before(mesh, h));
    const kernels::Point after = corner(mesh.next(kernels::boundary_after(mesh, h)));
    kernels::store((1.0 / 27) * (before + 16.0 * a + 10.0 * b), out);
    kernels::store((1.0 / 27) * (10.0 * a + 16.0 * b + after), out + 3);
  }
}

void place_all(const kernels::Apexes& apexes, const Positions& old, bool cuts_boundary,
               const Execution& execution, Child& child) {
  const TriangleView& mesh = apexes.mesh;
  par::for_each_range(execution, mesh.face_count(), kLevelGrain,
                      [&](IndexRange range) { place_thirds(mesh, old, apexes, range, child); });
  const auto smooth = [&](VertexId v) { return kernels::sqrt3_smooth(mesh, old, v); };
  const auto crease = [&](kernels::Point p, kernels::Point sum) {
    return cuts_boundary ? (1.0 / 27) * (19.0 * p + 4.0 * sum) : p;
  };
  const kernels::Sharpness<TriangleView> sharpness{mesh, nullptr};
  par::for_each_range(execution, mesh.vertex_count(), kLevelGrain, [&](IndexRange range) {
    for (Index v = range.begin; v < range.end; ++v) {
      kernels::store(kernels::vertex_point(mesh, old, sharpness, VertexId(v), smooth, crease),
                     child.point(v));
    }
  });
}

void start_apexes(const kernels::Apexes& apexes, const TriangleView& triangles,
                  const Execution& execution, Child& child) {
  const TriangleView& mesh = apexes.mesh;
  par::for_each_range(execution, mesh.halfedge_count(), kLevelGrain, [&](IndexRange range) {
    for (Index i = range.begin; i < range.end; ++i) {
      const HalfedgeId h(i);
      const Index apex = apexes.first(mesh.face(h));
      if (apexes.cuts(h)) {
        child.outgoing[at(apex)] = kernels::child_fan(triangles, HalfedgeId(3 * i)).start;
        child.outgoing[at(apex + 1)] = kernels::child_fan(triangles, HalfedgeId(3 * i + 1)).start;
      } else if (h == mesh.first(mesh.face(h)) &&
                 !(apexes.rank != nullptr && kernels::has_boundary_edge(mesh, mesh.face(h)))) {
        child.outgoing[at(apex)] = kernels::child_fan(triangles, HalfedgeId(3 * i + 2)).start;
      }
    }
  });
}

}  // namespace

Result<SubdivisionOutput> refine_thirds(const TriangleView& mesh, const Level& level,
                                        bool cuts_boundary, const Execution& execution) {
  const Index parents = mesh.halfedge_count();
  const Result<Index> halfedges = checked_count(std::int64_t{3} * parents);
  if (!halfedges) return fail(halfedges.error());
  Ranks cut;
  if (cuts_boundary) {
    cut = rank_marked(execution, mesh.face_count(),
                      [&](Index f) { return kernels::has_boundary_edge(mesh, FaceId(f)); });
  }
  const Result<Index> vertices =
      checked_count(std::int64_t{mesh.vertex_count()} + mesh.face_count() + cut.count);
  if (!vertices) return fail(vertices.error());

  Child child(*vertices, *halfedges);
  const kernels::Apexes apexes{mesh, cuts_boundary ? cut.before.data() : nullptr};
  par::for_each_range(execution, parents, kLevelGrain, [&](IndexRange range) {
    kernels::fill_thirds(range, apexes, child.columns());
  });
  const TriangleView triangles = triangle_view(child);
  // A cut edge leaves its origin no child of its own: the edge before it, turned, has one there.
  const auto seed = [&](HalfedgeId h) {
    return HalfedgeId(3 * (apexes.cuts(h) ? mesh.opposite[mesh.prev(h)] : h).value);
  };
  start_old(mesh, triangles, seed, execution, child);
  start_apexes(apexes, triangles, execution, child);
  place_all(apexes, level.positions, cuts_boundary, execution, child);
  SubdivisionOutput output;
  output.positions = std::move(child.xyz);
  output.mesh = finish_triangles(child);
  return output;
}

}  // namespace hedgerow::subdivision
