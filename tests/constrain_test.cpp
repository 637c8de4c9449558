// Triangulations with given edges.
#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/triangulate.h"
#include "hedgerow/validate.h"
#include "support/planar_checks.h"
#include "support/point_sets.h"

namespace hedgerow {
namespace {

using kernels::orient2d;
using test::Spread;
using Ends = std::array<Index, 2>;

const Point2& at(const std::vector<Point2>& points, Index i) {
  return points[static_cast<std::size_t>(i)];
}

ConstrainedTriangulation constrained(const std::vector<Point2>& points,
                                     const std::vector<Ends>& edges) {
  auto result = triangulate_constrained(points, edges, Execution::serial());
  EXPECT_TRUE(result.has_value());
  return result ? std::move(*result) : ConstrainedTriangulation{};
}

// Between the ends of a segment, both left out.
bool is_between(const Point2& p, const Point2& a, const Point2& b) {
  return orient2d(a, b, p) == 0 && p != a && p != b && std::min(a, b) < p && p < std::max(a, b);
}

// Inside of both, so that not both can be edges.
bool do_cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return orient2d(a, b, c) * orient2d(a, b, d) < 0 && orient2d(c, d, a) * orient2d(c, d, b) < 0;
}

std::set<std::pair<Point2, Point2>> constrained_edges(const std::vector<Point2>& points,
                                                      const ConstrainedTriangulation& made) {
  const TriangleView mesh = made.mesh.triangles();
  std::set<std::pair<Point2, Point2>> edges;
  for (const Index h : made.constrained) {
    edges.emplace(at(points, mesh.origin[HalfedgeId(h)].value),
                  at(points, mesh.target(HalfedgeId(h)).value));
  }
  return edges;
}

// Each given edge is there, cut where points lie on it, and nothing else is called constrained.
void expect_edges(const std::vector<Point2>& points, const std::vector<Ends>& edges,
                  const ConstrainedTriangulation& made) {
  std::set<std::pair<Point2, Point2>> expected;
  for (const Ends& ends : edges) {
    const Point2 a = at(points, ends[0]);
    const Point2 b = at(points, ends[1]);
    std::set<Point2> way{a, b};
    for (const Point2& p : points) {
      if (is_between(p, a, b)) way.insert(p);
    }
    for (auto p = way.begin(), q = std::next(p); q != way.end(); ++p, ++q) {
      expected.insert(std::minmax(*p, *q));
    }
  }
  std::set<std::pair<Point2, Point2>> found;
  for (const auto& [p, q] : constrained_edges(points, made)) found.insert(std::minmax(p, q));
  EXPECT_EQ(found, expected);
}

void expect_legal_but_for_constraints(const std::vector<Point2>& points,
                                      const ConstrainedTriangulation& made) {
  const TriangleView mesh = made.mesh.triangles();
  const std::set<Index> is_constrained(made.constrained.begin(), made.constrained.end());
  for (HalfedgeId h(0); h.value < mesh.halfedge_count(); ++h.value) {
    const auto point = [&](HalfedgeId g) { return at(points, mesh.origin[g].value); };
    const HalfedgeId o = mesh.opposite[h];
    ASSERT_GT(orient2d(point(h), point(mesh.next(h)), point(mesh.prev(h))), 0);
    if (!o.valid() || is_constrained.count(h.value) > 0) continue;
    EXPECT_LE(
        kernels::incircle(point(h), point(mesh.next(h)), point(mesh.prev(h)), point(mesh.prev(o))),
        0);
  }
}

TEST(Constrain, KeepsTheLongDiagonalOfAKite) {
  const std::vector<Point2> points{{-2, 0}, {0, -1}, {2, 0}, {0, 1}};
  const ConstrainedTriangulation made = constrained(points, {{0, 2}});
  EXPECT_EQ(made.constrained.size(), 2U);
  expect_edges(points, {{0, 2}}, made);
}

TEST(Constrain, CutsAnEdgeAtThePointsOnItsWay) {
  const std::vector<Point2> points{{0, 0}, {1, 1}, {3, 3}, {4, 4}, {4, 0}, {0, 4}, {2, 1}, {2, 3}};
  const ConstrainedTriangulation made = constrained(points, {{3, 0}});
  EXPECT_EQ(made.constrained.size(), 6U);
  expect_edges(points, {{3, 0}}, made);
}

TEST(Constrain, TakesAnEdgeOfTheHullAndOneThatIsGivenTwice) {
  const std::vector<Point2> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 2}};
  const ConstrainedTriangulation made = constrained(points, {{0, 1}, {4, 2}, {2, 4}});
  EXPECT_EQ(made.constrained.size(), 3U);
}

TEST(Constrain, NamesTheEdgeThatCrossesAnEarlierOne) {
  const std::vector<Point2> points{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {5, 1}};
  const std::vector<Ends> edges{{0, 1}, {0, 2}, {1, 4}, {1, 3}};
  const auto made = triangulate_constrained(points, edges, Execution::serial());
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().code, ErrorCode::crossing_edges);
  EXPECT_EQ(made.error().element, 3);
  EXPECT_EQ(made.error().value, 1);
}

TEST(Constrain, NamesAnEdgeWithoutTwoPoints) {
  const std::vector<Point2> points{{0, 0}, {2, 0}, {2, 2}, {0, 0}};
  struct Case {
    Ends ends;
    ErrorCode code;
    Index value;
  };
  for (const Case& c :
       {Case{{0, 4}, ErrorCode::index_out_of_range, 4},
        Case{{-1, 2}, ErrorCode::index_out_of_range, -1},
        Case{{1, 1}, ErrorCode::repeated_vertex, 1}, Case{{0, 3}, ErrorCode::repeated_vertex, 3}}) {
    const std::vector<Ends> edges{{0, 1}, c.ends};
    const auto made = triangulate_constrained(points, edges, Execution::serial());
    ASSERT_FALSE(made.has_value());
    EXPECT_EQ(made.error().code, c.code);
    EXPECT_EQ(made.error().element, 1);
    EXPECT_EQ(made.error().value, c.value);
  }
}

TEST(Constrain, HasNoEdgesAmongPointsOnALine) {
  const std::vector<Point2> points{{0, 0}, {1, 1}, {2, 2}};
  EXPECT_TRUE(constrained(points, {{0, 2}}).constrained.empty());
}

class ConstrainSpread : public ::testing::TestWithParam<int> {};

TEST_P(ConstrainSpread, HasTheEdgesAndIsDelaunayElsewhere) {
  const auto spread = static_cast<Spread>(GetParam());
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Point2> points = test::points_of(spread, 4 + seed, seed);
    std::mt19937_64 random(seed);
    std::vector<Ends> edges;
    for (int i = 0; i < 60; ++i) {
      const Ends ends{static_cast<Index>(random() % points.size()),
                      static_cast<Index>(random() % points.size())};
      const Point2& a = at(points, ends[0]);
      const Point2& b = at(points, ends[1]);
      const bool fits = a != b && std::none_of(edges.begin(), edges.end(), [&](const Ends& e) {
                          return do_cross(a, b, at(points, e[0]), at(points, e[1]));
                        });
      if (fits) edges.push_back(ends);
    }
    const ConstrainedTriangulation made = constrained(points, edges);
    EXPECT_TRUE(validate(made.mesh, Execution::serial()).empty());
    EXPECT_EQ(test::PlanarCheck(points, made.mesh).covers_the_hull(), "");
    if (made.mesh.face_count() == 0) continue;
    expect_edges(points, edges, made);
    expect_legal_but_for_constraints(points, made);
  }
}

INSTANTIATE_TEST_SUITE_P(Spreads, ConstrainSpread, ::testing::Range(0, test::kSpreadCount));

}  // namespace
}  // namespace hedgerow
