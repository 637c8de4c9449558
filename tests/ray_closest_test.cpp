#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "closest_triangle.h"
#include "hedgerow/ray/scene.h"
#include "hedgerow/ray/surface.h"
#include "support/ray_cases.h"

namespace hedgerow {
namespace {

using ray::ClosestPoint;
using ray::Feature;
using ray::Motion;
using ray::PaddedPositions;
using ray::Scene;
using ray::Vec3;
using test::RayMesh;

std::array<double, 3> wide(const float* xyz) { return {xyz[0], xyz[1], xyz[2]}; }

double slow_distance(const Soup& soup, const std::vector<test::FaceTriangle>& triangles,
                     const Vec3& from) {
  double least = std::numeric_limits<double>::infinity();
  for (const test::FaceTriangle& triangle : triangles) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = wide(soup.positions()[triangle.vertices[k]]);
    }
    least = std::min(least, test::slow_squared_distance(corners, wide(from.data())));
  }
  return std::sqrt(least);
}

/// Distance from a point to the edge of a half-edge, or to its origin.
double distance_to(const RayMesh& subject, const ClosestPoint& closest, const Vec3& from) {
  const Positions positions = subject.soup.positions();
  return subject.mesh.visit([&](const auto& view) {
    const auto start = wide(positions[view.origin[closest.halfedge].value]);
    auto end = start;
    if (closest.feature == Feature::edge)
      end = wide(positions[view.target(closest.halfedge).value]);
    return std::sqrt(test::slow_squared_distance({start, end, end}, wide(from.data())));
  });
}

TEST(RayClosestPoint, IsAsCloseAsTheClosestOfAllTriangles) {
  for (const RayMesh& subject : test::ray_meshes()) {
    const auto triangles = test::triangles_of(subject.soup);
    const auto scene = scene_of(subject);
    ASSERT_TRUE(scene);
    for (const Vec3& from : test::random_points(subject.soup, 1000, 21)) {
      const ClosestPoint closest = scene->closest_point(from);
      ASSERT_TRUE(closest.valid()) << subject.name;
      const double expected = slow_distance(subject.soup, triangles, from);
      EXPECT_NEAR(closest.distance, expected, 1e-9 * (1 + expected)) << subject.name;
      const Vec3 there = subject.mesh.visit([&](const auto& view) {
        return interpolate(view, closest.surface, subject.soup.positions());
      });
      const double reach = test::diagonal_of(subject.soup);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(there[axis], closest.position[axis], 1e-6 * reach) << subject.name;
      }
      if (closest.feature != Feature::face) {
        EXPECT_NEAR(distance_to(subject, closest, from), expected, 1e-9 * (1 + expected));
      }
    }
  }
}

TEST(RayClosestPoint, IsTheSameInEveryTree) {
  for (const RayMesh& subject : test::ray_meshes()) {
    const auto still = scene_of(subject);
    const auto moving = scene_of(subject, {.motion = Motion::moving, .piece_faces = 64});
    ASSERT_TRUE(still && moving);
    std::vector<Vec3> points = test::random_points(subject.soup, 200, 22);
    // At a vertex, all faces round it are equally close.
    for (Index v = 0; v < subject.soup.vertex_count(); v += 7) {
      const float* xyz = subject.soup.positions()[v];
      points.push_back({xyz[0], xyz[1], xyz[2]});
    }
    for (const Vec3& from : points) {
      const ClosestPoint a = still->closest_point(from);
      const ClosestPoint b = moving->closest_point(from);
      EXPECT_EQ(a.distance, b.distance);
      EXPECT_EQ(a.halfedge, b.halfedge);
      EXPECT_EQ(a.feature, b.feature);
      EXPECT_EQ(a.surface.corners, b.surface.corners);
    }
  }
}

TEST(RayClosestPoint, NamesTheVertexAtAVertexAndTheEdgeOnAnEdge) {
  const RayMesh subject("grid", std::move(test::ray_meshes()[2].soup));
  const auto scene = scene_of(subject);
  ASSERT_TRUE(scene);
  const TriangleView view = subject.mesh.triangles();
  for (Index v = 0; v < subject.soup.vertex_count(); ++v) {
    const float* xyz = subject.soup.positions()[v];
    const ClosestPoint closest = scene->closest_point({xyz[0], xyz[1], xyz[2]});
    EXPECT_EQ(closest.distance, 0);
    ASSERT_EQ(closest.feature, Feature::vertex);
    EXPECT_EQ(view.origin[closest.halfedge], VertexId(v));
  }
}

// The row 0 1 2 3 4 of a pentagon, flat: its diagonals are no edges of it.
TEST(RayClosestPoint, TakesADiagonalForTheInside) {
  Soup soup;
  soup.xyz =
      Buffer<float>::copy_of(std::vector<float>{0, 0, 0, 2, 0, 0, 3, 1, 0, 2, 2, 0, 0, 2, 0});
  soup.corners = Buffer<Index>::copy_of(std::vector<Index>{0, 1, 2, 3, 4});
  soup.offsets = Buffer<Index>::copy_of(std::vector<Index>{0, 5});
  const RayMesh subject("pentagon", std::move(soup));
  const auto scene = scene_of(subject);
  ASSERT_TRUE(scene);
  int faces = 0;
  for (float x = 0.25F; x < 2; x += 0.25F) {
    for (float y = 0.25F; y < 2; y += 0.25F) {
      const ClosestPoint closest = scene->closest_point({x, y, 1});
      EXPECT_EQ(closest.distance, 1);
      faces += closest.feature == Feature::face ? 1 : 0;
    }
  }
  EXPECT_EQ(faces, 49);
  const ClosestPoint edge = scene->closest_point({1, -1, 0});
  EXPECT_EQ(edge.feature, Feature::edge);
  EXPECT_EQ(edge.halfedge, HalfedgeId(0));
  const ClosestPoint closing = scene->closest_point({-1, 1, 0});
  EXPECT_EQ(closing.feature, Feature::edge);
  EXPECT_EQ(closing.halfedge, HalfedgeId(4));
  const ClosestPoint corner = scene->closest_point({9, 1, 0});
  EXPECT_EQ(corner.feature, Feature::vertex);
  EXPECT_EQ(corner.halfedge, HalfedgeId(2));
}

TEST(RayClosestPoint, TakesTheDiagonalOfAQuadForTheInside) {
  Soup soup;
  soup.xyz = Buffer<float>::copy_of(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  soup.corners = Buffer<Index>::copy_of(std::vector<Index>{0, 1, 2, 3});
  soup.offsets = Buffer<Index>::copy_of(std::vector<Index>{0, 4});
  const RayMesh subject("quad", std::move(soup));
  const auto scene = scene_of(subject);
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->closest_point({0.5F, 0.5F, 2}).feature, Feature::face);
  for (Index k = 0; k < 4; ++k) {
    const std::array<Vec3, 4> outside = {
        {{0.5F, -1, 0}, {2, 0.5F, 0}, {0.5F, 2, 0}, {-1, 0.5F, 0}}};
    const ClosestPoint closest = scene->closest_point(outside[static_cast<std::size_t>(k)]);
    EXPECT_EQ(closest.feature, Feature::edge);
    EXPECT_EQ(closest.halfedge, HalfedgeId(k));
  }
}

TEST(RayClosestPoint, StaysWithinTheRadius) {
  const RayMesh subject("icosphere", std::move(test::ray_meshes()[0].soup));
  const auto scene = scene_of(subject);
  ASSERT_TRUE(scene);
  const auto triangles = test::triangles_of(subject.soup);
  for (const Vec3& from : test::random_points(subject.soup, 300, 23)) {
    const double distance = slow_distance(subject.soup, triangles, from);
    EXPECT_FALSE(scene->closest_point(from, static_cast<float>(distance * 0.99)).valid());
    EXPECT_TRUE(scene->closest_point(from, static_cast<float>(distance * 1.01)).valid());
  }
  EXPECT_FALSE(scene->closest_point({0, 0, 0}, 0).valid());
}

TEST(RayClosestPoint, IsNoneFromAPointThatIsNotFinite) {
  const RayMesh subject("icosphere", std::move(test::ray_meshes()[0].soup));
  const auto scene = scene_of(subject);
  ASSERT_TRUE(scene);
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    EXPECT_FALSE(scene->closest_point({0, bad, 0}).valid());
    EXPECT_FALSE(scene->closest_point({0, -bad, 0}).valid());
  }
  EXPECT_FALSE(scene->closest_point({0, 0, 0}, std::numeric_limits<float>::quiet_NaN()).valid());
  EXPECT_FALSE(scene->closest_point({0, 0, 0}, -1).valid());
}

// Thin, flat and pointed triangles, and those that are only an edge or a point.
TEST(ClosestOnTriangle, AgreesWithTryingEverythingOnAnyTriangle) {
  std::uint64_t state = 1;
  const auto number = [&](double scale) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (static_cast<double>(state >> 11U) / 0x1p53 - 0.5) * scale;
  };
  const auto point = [&](double flatness) {
    return ray::Point{number(2), number(2) * flatness, number(2) * flatness};
  };
  for (int i = 0; i < 20000; ++i) {
    const double flatness = i % 4 == 0 ? 1 : i % 4 == 1 ? 1e-6 : i % 4 == 2 ? 1e-12 : 0;
    std::array<ray::Point, 3> corners = {point(flatness), point(flatness), point(flatness)};
    if (i % 8 == 7) corners[2] = corners[1];
    if (i % 16 == 15) corners[1] = corners[2] = corners[0];
    const ray::Point from = {number(4), number(4), number(4)};
    const ray::TrianglePoint found = ray::closest_on_triangle(corners, from);
    const double squared = ray::detail::squared_distance(corners, found, from);
    EXPECT_NEAR(squared, test::slow_squared_distance(corners, from), 1e-9) << i;
    EXPECT_NEAR(found.weights[0] + found.weights[1] + found.weights[2], 1, 1e-12);
    for (const double weight : found.weights) EXPECT_GE(weight, 0);
  }
}

}  // namespace
}  // namespace hedgerow
