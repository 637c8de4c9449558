#include "hedgerow/triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/digest.h"
#include "hedgerow/validate.h"
#include "support/planar_checks.h"
#include "support/point_sets.h"
#include "support/threads.h"

namespace hedgerow {
namespace {

using test::PlanarCheck;
using test::Spread;

Triangulation triangulation_of(const std::vector<Point2>& points) {
  Result<Triangulation> result = triangulate(points, Execution::serial());
  EXPECT_TRUE(result.has_value());
  return result ? std::move(*result) : Triangulation{};
}

// What the builder makes of the same faces.
std::uint64_t built_digest(const Connectivity& mesh) {
  const auto faces = FaceList::triangles(mesh.origin(), mesh.vertex_count());
  const Result<BuildOutput> output = build(faces, {}, Execution::serial());
  return output ? digest(output->mesh, Execution::serial()) : 0;
}

void expect_right(const std::vector<Point2>& points) {
  const Triangulation result = triangulation_of(points);
  ASSERT_EQ(result.mesh.vertex_count(), static_cast<Index>(points.size()));
  const PlanarCheck check(points, result.mesh);
  EXPECT_EQ(check.every_circle_is_empty(), "");
  EXPECT_EQ(check.covers_the_hull(), "");
  EXPECT_EQ(digest(result.mesh, Execution::serial()), built_digest(result.mesh));
}

TEST(Triangulate, MakesNoFaceOfFewerThanThreePoints) {
  EXPECT_EQ(triangulation_of({}).mesh.vertex_count(), 0);
  EXPECT_EQ(triangulation_of({{1, 2}}).mesh.face_count(), 0);
  const Triangulation two = triangulation_of({{1, 2}, {3, 4}});
  EXPECT_EQ(two.mesh.face_count(), 0);
  EXPECT_EQ(two.mesh.vertex_count(), 2);
  EXPECT_TRUE(two.same_as.empty());
}

TEST(Triangulate, TurnsATriangleLeft) {
  const Triangulation result = triangulation_of({{0, 0}, {0, 1}, {1, 0}});
  ASSERT_EQ(result.mesh.face_count(), 1);
  const std::vector<Index> origin(result.mesh.origin().begin(), result.mesh.origin().end());
  const std::vector<Index> left[] = {{0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  EXPECT_EQ(std::count(std::begin(left), std::end(left), origin), 1);
}

TEST(Triangulate, TakesTheShorterDiagonalOfAKite) {
  const Triangulation result = triangulation_of({{-2, 0}, {0, -1}, {2, 0}, {0, 1}});
  ASSERT_EQ(result.mesh.face_count(), 2);
  EXPECT_EQ(result.mesh.opposite().size(), 6U);
  for (Index h = 0; h < 6; ++h) {
    const TriangleView mesh = result.mesh.triangles();
    if (!mesh.opposite[HalfedgeId(h)].valid()) continue;
    EXPECT_EQ(mesh.origin[HalfedgeId(h)].value % 2, 1);
  }
}

TEST(Triangulate, LeavesPointsOnALineWithoutFaces) {
  for (const Point2 step : {Point2{1, 0}, Point2{0, 1}, Point2{1, 3}, Point2{-0.1, 0.1}}) {
    std::vector<Point2> points;
    for (int i : {3, 0, 4, 1, 2, 9, 8}) points.push_back({i * step[0], i * step[1]});
    const Triangulation result = triangulation_of(points);
    EXPECT_EQ(PlanarCheck(points, result.mesh).covers_the_hull(), "");
  }
}

TEST(Triangulate, NamesTheFirstPointOfEachPlace) {
  const Triangulation result =
      triangulation_of({{5, 5}, {0, 0}, {1, 0}, {0, 0}, {-0.0, 0.0}, {5, 5}, {0, 1}});
  const std::vector<Index> same_as(result.same_as.begin(), result.same_as.end());
  EXPECT_EQ(same_as, (std::vector<Index>{0, 1, 2, 1, 1, 0, 6}));
  EXPECT_FALSE(result.mesh.triangles().outgoing[VertexId(3)].valid());
  EXPECT_EQ(result.mesh.face_count(), 2);
}

TEST(Triangulate, NamesTheFirstPointThatCannotBeUsed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  struct Case {
    Point2 bad;
    std::int64_t axis;
  };
  for (const Case& c :
       {Case{{nan, 0}, 0}, Case{{0, infinity}, 1}, Case{{0, 1e-300}, 1}, Case{{-1e300, 0}, 0}}) {
    const std::vector<Point2> points{{0, 0}, {1, 0}, c.bad, {2, 2}, c.bad};
    const Result<Triangulation> result = triangulate(points, Execution::serial());
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::coordinate_out_of_range);
    EXPECT_EQ(result.error().element, 2);
    EXPECT_EQ(result.error().value, c.axis);
    EXPECT_EQ(result.error().limit, 200);
    EXPECT_EQ(result.error().count, 2);
  }
}

class TriangulateSpread : public ::testing::TestWithParam<int> {};

TEST_P(TriangulateSpread, HasEmptyCirclesAndAConvexHull) {
  const auto spread = static_cast<Spread>(GetParam());
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    expect_right(test::points_of(spread, 1 + seed % 40, seed));
  }
  expect_right(test::points_of(spread, 200, 1000));
}

TEST_P(TriangulateSpread, HoldsForManyPoints) {
  const auto spread = static_cast<Spread>(GetParam());
  const std::vector<Point2> points = test::points_of(spread, 20000, 7);
  const Triangulation result = triangulation_of(points);
  const PlanarCheck check(points, result.mesh);
  EXPECT_EQ(check.every_edge_is_legal(), "");
  EXPECT_EQ(check.covers_the_hull(), "");
  EXPECT_EQ(digest(result.mesh, Execution::serial()), built_digest(result.mesh));
}

TEST_P(TriangulateSpread, IsTheSameForEveryThreadCountAndGrain) {
  const auto spread = static_cast<Spread>(GetParam());
  const std::vector<Point2> points = test::points_of(spread, 5000, 11);
  const Triangulation serial = triangulation_of(points);
  for (const int threads : test::kThreadCounts) {
    for (const Index grain : {1, 37, 4000}) {
      test::Threads arena(threads);
      const Result<Triangulation> result = triangulate(points, arena.execution().with_grain(grain));
      ASSERT_TRUE(result.has_value());
      EXPECT_TRUE(std::ranges::equal(result->mesh.origin(), serial.mesh.origin()));
      EXPECT_TRUE(std::ranges::equal(result->mesh.opposite(), serial.mesh.opposite()));
      EXPECT_TRUE(std::ranges::equal(result->mesh.outgoing(), serial.mesh.outgoing()));
      EXPECT_TRUE(std::ranges::equal(result->same_as, serial.same_as));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Spreads, TriangulateSpread, ::testing::Range(0, test::kSpreadCount));

}  // namespace
}  // namespace hedgerow
