// Triangulations of a thousand point sets beside those of CGAL.
#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include "hedgerow/triangulate.h"
#include "support/planar_checks.h"
#include "support/point_sets.h"

namespace hedgerow::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel>;
using Edge = std::pair<Point2, Point2>;

Edge edge_between(const Point2& a, const Point2& b) { return {std::min(a, b), std::max(a, b)}; }

std::set<Edge> edges_of(const std::vector<Point2>& points, const Connectivity& mesh) {
  const TriangleView view = mesh.triangles();
  const auto at = [&](VertexId v) { return points[static_cast<std::size_t>(v.value)]; };
  std::set<Edge> edges;
  for (HalfedgeId h(0); h.value < view.halfedge_count(); ++h.value) {
    edges.insert(edge_between(at(view.origin[h]), at(view.target(h))));
  }
  return edges;
}

Point2 point_of(const Delaunay::Vertex_handle& v) { return {v->point().x(), v->point().y()}; }

// Edges that every Delaunay triangulation of the points has: on the hull, or with the corner on one
// side strictly outside the circle of the other side.
std::set<Edge> certain_edges(const Delaunay& delaunay) {
  std::set<Edge> edges;
  for (auto e = delaunay.finite_edges_begin(); e != delaunay.finite_edges_end(); ++e) {
    const auto face = e->first;
    const int i = e->second;
    const auto other = face->neighbor(i);
    const int j = other->index(face);
    const auto a = face->vertex(Delaunay::cw(i));
    const auto b = face->vertex(Delaunay::ccw(i));
    const bool is_hull = delaunay.is_infinite(face) || delaunay.is_infinite(other);
    if (is_hull || kernels::incircle(point_of(face->vertex(0)), point_of(face->vertex(1)),
                                     point_of(face->vertex(2)), point_of(other->vertex(j))) < 0) {
      edges.insert(edge_between(point_of(a), point_of(b)));
    }
  }
  return edges;
}

void expect_the_same(const std::vector<Point2>& points) {
  std::vector<Kernel::Point_2> theirs;
  for (const Point2& p : points) theirs.emplace_back(p[0], p[1]);
  const Delaunay delaunay(theirs.begin(), theirs.end());
  const Result<Triangulation> ours = triangulate(points, Execution::serial());
  ASSERT_TRUE(ours.has_value());
  ASSERT_EQ(static_cast<std::size_t>(ours->mesh.face_count()), delaunay.number_of_faces());
  if (ours->mesh.face_count() == 0) return;
  const std::set<Edge> mine = edges_of(points, ours->mesh);
  const std::set<Edge> certain = certain_edges(delaunay);
  EXPECT_TRUE(std::includes(mine.begin(), mine.end(), certain.begin(), certain.end()));
  const auto edge_count = delaunay.number_of_vertices() + delaunay.number_of_faces() - 1;
  EXPECT_EQ(mine.size(), edge_count);
}

TEST(TriangulateBesideCgal, HasTheSameEdgesOnAThousandPointSets) {
  // Two thirds spread evenly or in clusters; a third with lines, circles, grids and repetition.
  constexpr Spread kDegenerate[] = {Spread::repeated, Spread::tenths, Spread::small_whole,
                                    Spread::grid,     Spread::line,   Spread::two_lines,
                                    Spread::circle};
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    const Spread spread = seed % 3 == 0   ? kDegenerate[seed / 3 % std::size(kDegenerate)]
                          : seed % 3 == 1 ? Spread::uniform
                                          : Spread::clusters;
    expect_the_same(points_of(spread, 1 + seed % 500, seed));
  }
}

}  // namespace
}  // namespace hedgerow::test
