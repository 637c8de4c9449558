// Voronoi cells, against the definition: each holds what is nearest to its site.
#include "hedgerow/voronoi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/validate.h"
#include "support/planar_checks.h"
#include "support/point_sets.h"
#include "support/threads.h"

namespace hedgerow {
namespace {

using test::Spread;

constexpr Box2 kUnit{{0, 0}, {1, 1}};

Voronoi diagram_of(const std::vector<Point2>& sites, const Box2& box) {
  Result<Voronoi> result = voronoi(sites, box, Execution::serial());
  EXPECT_TRUE(result.has_value());
  return result ? std::move(*result) : Voronoi{};
}

double squared(const Point2& a, const Point2& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

std::vector<Point2> corners_of(const Voronoi& diagram, Index cell) {
  std::vector<Point2> corners;
  diagram.mesh.visit([&](const auto& mesh) {
    const HalfedgeId start = mesh.first(FaceId(cell));
    HalfedgeId h = start;
    do {
      corners.push_back(diagram.points.data()[mesh.origin[h].value]);
      h = mesh.next(h);
    } while (h != start);
  });
  return corners;
}

double area_of(const Box2& box) { return (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]); }

double sum_of_areas(const Voronoi& diagram) {
  double sum = 0;
  for (Index f = 0; f < diagram.mesh.face_count(); ++f) sum += cell_area(diagram, FaceId(f));
  return sum;
}

// The box cut by the line between the site and each other one: Sutherland and Hodgman's way.
std::vector<Point2> plain_cell(const std::vector<Point2>& sites, Index site, const Box2& box) {
  const Point2& s = sites[static_cast<std::size_t>(site)];
  std::vector<Point2> cell = {
      box.low, {box.high[0], box.low[1]}, box.high, {box.low[0], box.high[1]}};
  for (const Point2& t : sites) {
    if (t == s) continue;
    const Point2 middle{(s[0] + t[0]) / 2, (s[1] + t[1]) / 2};
    const auto beyond = [&](const Point2& p) {
      return (p[0] - middle[0]) * (t[0] - s[0]) + (p[1] - middle[1]) * (t[1] - s[1]);
    };
    std::vector<Point2> kept;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Point2& p = cell[i];
      const Point2& q = cell[(i + 1) % cell.size()];
      const double at_p = beyond(p);
      const double at_q = beyond(q);
      if (at_p <= 0) kept.push_back(p);
      if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
        const double t_cut = at_p / (at_p - at_q);
        kept.push_back({p[0] + t_cut * (q[0] - p[0]), p[1] + t_cut * (q[1] - p[1])});
      }
    }
    cell = kept;
  }
  return cell;
}

double plain_area(const std::vector<Point2>& corners) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Point2& o = corners[0];
    const Point2& p = corners[i];
    const Point2& q = corners[i + 1];
    twice += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
  }
  return twice / 2;
}

void expect_right(const std::vector<Point2>& sites, const Box2& box) {
  const Voronoi diagram = diagram_of(sites, box);
  const auto first = test::first_points(sites);
  std::vector<Index> expected;
  for (const auto& [p, i] : first) expected.push_back(i);
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(std::vector<Index>(diagram.sites.begin(), diagram.sites.end()), expected);
  ASSERT_EQ(diagram.mesh.face_count(), static_cast<Index>(expected.size()));
  EXPECT_TRUE(validate(diagram.mesh, Execution::serial()).empty());
  const double size = area_of(box);
  EXPECT_NEAR(sum_of_areas(diagram), size, 1e-12 * size);
  for (Index f = 0; f < diagram.mesh.face_count(); ++f) {
    const std::vector<Point2> plain = plain_cell(sites, expected[static_cast<std::size_t>(f)], box);
    EXPECT_NEAR(cell_area(diagram, FaceId(f)), plain_area(plain), 1e-9 * size) << "cell " << f;
  }
}

TEST(Voronoi, HasNoCellsWithoutSites) {
  const Voronoi diagram = diagram_of({}, kUnit);
  EXPECT_EQ(diagram.mesh.face_count(), 0);
  EXPECT_EQ(diagram.mesh.vertex_count(), 0);
}

TEST(Voronoi, GivesTheBoxToASingleSite) {
  const Voronoi diagram = diagram_of({{0.3, 0.2}}, kUnit);
  ASSERT_EQ(diagram.mesh.face_count(), 1);
  const std::vector<Point2> corners = corners_of(diagram, 0);
  const std::set<Point2> found(corners.begin(), corners.end());
  EXPECT_EQ(found, (std::set<Point2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(cell_area(diagram, FaceId(0)), 1);
}

TEST(Voronoi, CutsTheBoxInTwoBetweenTwoSites) {
  const Voronoi diagram = diagram_of({{0.25, 0.5}, {0.75, 0.5}}, kUnit);
  ASSERT_EQ(diagram.mesh.face_count(), 2);
  EXPECT_EQ(diagram.mesh.vertex_count(), 6);
  EXPECT_EQ(cell_area(diagram, FaceId(0)), 0.5);
  EXPECT_EQ(cell_area(diagram, FaceId(1)), 0.5);
}

TEST(Voronoi, SharesTheVertexOfFourSitesOnACircle) {
  const Voronoi diagram =
      diagram_of({{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}, kUnit);
  EXPECT_EQ(diagram.mesh.vertex_count(), 9);
  EXPECT_EQ(diagram.mesh.halfedge_count(), 16);
  for (Index f = 0; f < 4; ++f) EXPECT_EQ(cell_area(diagram, FaceId(f)), 0.25);
}

TEST(Voronoi, GivesSitesAtOnePlaceOneCell) {
  const Voronoi diagram = diagram_of({{0.5, 0.25}, {0.5, 0.25}, {0.5, 0.75}}, kUnit);
  EXPECT_EQ(std::vector<Index>(diagram.sites.begin(), diagram.sites.end()),
            (std::vector<Index>{0, 2}));
  EXPECT_EQ(sum_of_areas(diagram), 1);
}

TEST(Voronoi, IsCloserToItsSiteThanToAnyOther) {
  std::mt19937_64 random(3);
  const std::vector<Point2> sites = test::uniform_points(200, random);
  const Voronoi diagram = diagram_of(sites, box_round(sites));
  for (Index f = 0; f < diagram.mesh.face_count(); ++f) {
    for (const Point2& corner : corners_of(diagram, f)) {
      const double own = squared(corner, sites[static_cast<std::size_t>(f)]);
      for (const Point2& other : sites) EXPECT_LE(own, squared(corner, other) + 1e-9);
    }
  }
}

TEST(Voronoi, HoldsForSitesSoNearThatTheirImagesRoundTogether) {
  for (const Point2& other : {Point2{2e-17, 1e-30}, Point2{1e-17, 1e-30}, Point2{1e-17, 3e-17}}) {
    const Voronoi diagram = diagram_of({{1e-17, 0}, other}, {{-1, -1}, {1, 1}});
    EXPECT_EQ(diagram.mesh.face_count(), 2);
    EXPECT_NEAR(sum_of_areas(diagram), 4, 1e-12);
    EXPECT_NEAR(cell_area(diagram, FaceId(0)), 2, 1e-12);
  }
}

TEST(Voronoi, NamesTheFirstSiteThatIsNotInside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    Box2 box;
    std::int64_t axis;
  };
  for (const Case& c :
       {Case{{{0, 0}, {0.5, 1}}, 0}, Case{{{0, 0}, {1, 0.5}}, 1}, Case{{{0, 0}, {0.4, 1}}, 0},
        Case{{{nan, 0}, {1, 1}}, 0}, Case{{{1, 1}, {0, 0}}, 0},
        Case{{{0, 0}, {std::nextafter(0.5, 1), 1}}, 2}}) {
    const std::vector<Point2> sites{{0.1, 0.1}, {0.5, 0.5}, {0.5, 0.5}};
    const Result<Voronoi> result = voronoi(sites, c.box, Execution::serial());
    EXPECT_EQ(result.has_value(), c.axis == 2);
    if (result) continue;
    EXPECT_EQ(result.error().code, ErrorCode::site_outside_box);
    EXPECT_EQ(result.error().value, c.axis);
  }
  const std::vector<Point2> sites{{0.5, 0.5}, {2, 0.5}, {0.5, -2}};
  const Result<Voronoi> result = voronoi(sites, kUnit, Execution::serial());
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().element, 1);
  EXPECT_EQ(result.error().count, 2);
}

TEST(Voronoi, NamesTheFirstSiteThatCannotBeUsed) {
  const std::vector<Point2> sites{{0.5, 0.5}, {std::numeric_limits<double>::infinity(), 0.5}};
  const Result<Voronoi> result = voronoi(sites, kUnit, Execution::serial());
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::coordinate_out_of_range);
  EXPECT_EQ(result.error().element, 1);
}

class VoronoiSpread : public ::testing::TestWithParam<int> {};

TEST_P(VoronoiSpread, HasTheCellsThatLinesCutFromTheBox) {
  const auto spread = static_cast<Spread>(GetParam());
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Point2> sites = test::points_of(spread, 1 + seed, seed);
    expect_right(sites, box_round(sites));
  }
}

TEST_P(VoronoiSpread, AddsUpToTheBoxForManySites) {
  const auto spread = static_cast<Spread>(GetParam());
  const std::vector<Point2> sites = test::points_of(spread, 20000, 9);
  const Box2 box = box_round(sites);
  const Voronoi diagram = diagram_of(sites, box);
  EXPECT_EQ(diagram.mesh.face_count(), static_cast<Index>(test::first_points(sites).size()));
  EXPECT_NEAR(sum_of_areas(diagram), area_of(box), 1e-11 * area_of(box));
}

TEST_P(VoronoiSpread, IsTheSameForEveryThreadCount) {
  const auto spread = static_cast<Spread>(GetParam());
  const std::vector<Point2> sites = test::points_of(spread, 2000, 13);
  const Voronoi serial = diagram_of(sites, box_round(sites));
  for (const int threads : {2, 8}) {
    test::Threads arena(threads);
    const Result<Voronoi> result = voronoi(sites, box_round(sites), arena.execution(50));
    ASSERT_TRUE(result.has_value());
    EXPECT_TRUE(std::ranges::equal(result->mesh.origin(), serial.mesh.origin()));
    EXPECT_TRUE(std::ranges::equal(result->mesh.opposite(), serial.mesh.opposite()));
    EXPECT_TRUE(std::ranges::equal(result->points, serial.points));
    EXPECT_TRUE(std::ranges::equal(result->sites, serial.sites));
  }
}

// All but `wide`, whose cells cannot be told from nothing by their area.
INSTANTIATE_TEST_SUITE_P(Spreads, VoronoiSpread, ::testing::Range(0, test::kSpreadCount - 1));

}  // namespace
}  // namespace hedgerow
