#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "triangulate.h"

namespace hedgerow {
namespace {

struct Polygon {
  std::vector<float> xyz;
  std::vector<Index> vertices;

  void add(double x, double y) {
    vertices.push_back(static_cast<Index>(vertices.size()));
    // In a plane that no axis is at right angles to.
    for (const double c : {x, y, 0.3 * x - 0.7 * y}) xyz.push_back(static_cast<float>(c));
  }
  [[nodiscard]] Positions positions() const {
    return {xyz.data(), static_cast<std::int64_t>(vertices.size())};
  }
  /// Twice the area of the triangle of three corners, in x and y.
  [[nodiscard]] double area(Index a, Index b, Index c) const {
    const auto at = [&](Index i, std::size_t axis) {
      return static_cast<double>(xyz[3 * static_cast<std::size_t>(i) + axis]);
    };
    return (at(b, 0) - at(a, 0)) * (at(c, 1) - at(a, 1)) -
           (at(b, 1) - at(a, 1)) * (at(c, 0) - at(a, 0));
  }
};

/// n - 2 triangles with no turned one that make up the polygon's area: together they are a cut.
void expect_cut(const Polygon& polygon, bool is_turned = false) {
  ray::Triangulator triangulator;
  const auto triangles = triangulator.cut(polygon.vertices, polygon.positions());
  ASSERT_EQ(triangles.size() + 2, polygon.vertices.size());
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const double area = polygon.area(a, b, c) * (is_turned ? -1 : 1);
    EXPECT_GE(area, -1e-6);
    sum += area;
  }
  double whole = 0;
  const auto count = static_cast<Index>(polygon.vertices.size());
  for (Index i = 1; i + 1 < count; ++i) whole += polygon.area(0, i, i + 1);
  EXPECT_NEAR(sum, std::abs(whole), 1e-5 * (1 + std::abs(whole)));
}

Polygon star(int points, double inner) {
  Polygon polygon;
  for (int i = 0; i < 2 * points; ++i) {
    const double angle = i * 3.14159265358979 / points;
    const double radius = i % 2 == 0 ? 1 : inner;
    polygon.add(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

TEST(Triangulate, MakesAFanOfAConvexPolygon) {
  const Polygon polygon = star(20, 1);
  ray::Triangulator triangulator;
  const auto triangles = triangulator.cut(polygon.vertices, polygon.positions());
  for (const auto& triangle : triangles) EXPECT_EQ(triangle[0], 0);
  expect_cut(polygon);
}

TEST(Triangulate, CutsStarsCombsAndSpirals) {
  for (const int points : {3, 4, 5, 9, 50}) expect_cut(star(points, 0.2));
  Polygon comb;
  comb.add(0, 0);
  comb.add(40, 0);
  for (int i = 20; i-- > 0;) {
    comb.add(2 * i + 1.5, 10);
    comb.add(2 * i + 0.5, 1);
  }
  expect_cut(comb);
  Polygon spiral;
  for (int i = 0; i <= 60; ++i)
    spiral.add((1 + i * 0.1) * std::cos(i * 0.3), (1 + i * 0.1) * std::sin(i * 0.3));
  for (int i = 60; i-- > 0;)
    spiral.add((0.6 + i * 0.1) * std::cos(i * 0.3), (0.6 + i * 0.1) * std::sin(i * 0.3));
  expect_cut(spiral);
}

TEST(Triangulate, CutsClockwisePolygonsTheirOwnWay) {
  Polygon polygon = star(7, 0.3);
  std::ranges::reverse(polygon.vertices);
  ray::Triangulator triangulator;
  const auto triangles = triangulator.cut(polygon.vertices, polygon.positions());
  ASSERT_EQ(triangles.size(), 12U);
  for (const auto& [a, b, c] : triangles) {
    const auto at = [&](Index i) { return polygon.vertices[static_cast<std::size_t>(i)]; };
    EXPECT_LT(polygon.area(at(a), at(b), at(c)), 0);
  }
}

TEST(Triangulate, EndsOnPolygonsWithoutAnInside) {
  for (const double height : {0.0, 1.0}) {
    Polygon polygon;  // a line; then one that crosses itself many times
    for (int i = 0; i < 101; ++i) polygon.add(i % 7, height * (i % 5));
    ray::Triangulator triangulator;
    const auto triangles = triangulator.cut(polygon.vertices, polygon.positions());
    EXPECT_EQ(triangles.size(), 99U);
    std::vector<int> uses(101);
    for (const auto& triangle : triangles) {
      for (const Index i : triangle) ++uses[static_cast<std::size_t>(i)];
    }
    EXPECT_EQ(std::ranges::count(uses, 0), 0);
  }
}

// A hundred thousand corners, every second one reflex: the search for ears has to end in time.
TEST(Triangulate, EndsOnAHugeStar) {
  const Polygon polygon = star(50000, 0.99999);
  ray::Triangulator triangulator;
  EXPECT_EQ(triangulator.cut(polygon.vertices, polygon.positions()).size(), 99998U);
}

}  // namespace
}  // namespace hedgerow
