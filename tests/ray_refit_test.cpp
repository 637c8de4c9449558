#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/dirty_normals.h"
#include "hedgerow/ray/scene.h"
#include "hedgerow/shapes.h"
#include "support/ray_cases.h"

namespace hedgerow {
namespace {

using ray::Motion;
using ray::PaddedPositions;
using ray::Scene;
using test::RayMesh;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

RayMesh ball() { return {"icosphere", *shapes::icosphere(4)}; }

Result<Scene> moving_scene(const RayMesh& subject, Index piece_faces) {
  return Scene::build(*ray::Device::create(), subject.mesh, PaddedPositions::of(subject.soup.xyz),
                      {.motion = Motion::moving, .piece_faces = piece_faces}, Execution::serial());
}

bool is_within(const Soup& soup, Index v) {
  const float* xyz = soup.positions()[v];
  return std::all_of(xyz, xyz + 3, [](float x) { return std::abs(x) < 1.8e18F; });
}

/// Compares with every triangle whose corners are within reach, but close to edges.
void expect_the_slow_hits(const Scene& scene, const Soup& soup, int at_least = 60) {
  std::vector<test::FaceTriangle> triangles = test::triangles_of(soup);
  std::erase_if(triangles, [&](const test::FaceTriangle& triangle) {
    return !std::ranges::all_of(triangle.vertices, [&](Index v) { return is_within(soup, v); });
  });
  int met = 0;
  for (const ray::Ray& ray : test::random_rays(*shapes::icosphere(1), 150, 3)) {
    const auto slow = test::slow_hits(soup, triangles, ray);
    if (!slow.empty() && slow.front().margin < 1e-3) continue;
    const ray::Hit hit = scene.intersect(ray);
    ASSERT_EQ(hit.valid(), !slow.empty());
    if (!hit.valid()) continue;
    EXPECT_NEAR(hit.t, slow.front().t, 1e-3 * slow.front().t);
    ++met;
  }
  EXPECT_GE(met, at_least);
}

// A vertex may fly off for a frame: its faces go with it and come back with it, and no others.
TEST(RayRefit, LosesNoFaceButThoseOfAVertexThatIsNotFinite) {
  for (const Index piece_faces : {0, 1000, 100}) {
    RayMesh subject = ball();
    auto scene = moving_scene(subject, piece_faces);
    ASSERT_TRUE(scene);
    const Buffer<float> rest = Buffer<float>::copy_of(subject.soup.xyz.span());
    for (const float bad : {kNan, kInfinity, -1.9e18F}) {
      for (std::size_t v = 0; v < 2500; v += 100) subject.soup.xyz[3 * v + v / 100 % 3] = bad;
      ASSERT_TRUE(scene->refit(Execution::serial()));
      EXPECT_TRUE(scene->has_built());
      expect_the_slow_hits(*scene, subject.soup);
      std::ranges::copy(rest, subject.soup.xyz.begin());
      ASSERT_TRUE(scene->refit(Execution::serial()));
      EXPECT_TRUE(scene->has_built());
      expect_the_slow_hits(*scene, subject.soup);
      ASSERT_TRUE(scene->refit(Execution::serial()));
      EXPECT_FALSE(scene->has_built());
    }
  }
}

TEST(RayRefit, FindsFacesThatWereNotFiniteWhenTheSceneWasMade) {
  RayMesh subject = ball();
  const Buffer<float> rest = Buffer<float>::copy_of(subject.soup.xyz.span());
  std::ranges::fill(subject.soup.xyz, kNan);
  auto scene = moving_scene(subject, 500);
  ASSERT_TRUE(scene);
  expect_the_slow_hits(*scene, subject.soup, 0);
  std::ranges::copy(rest, subject.soup.xyz.begin());
  ASSERT_TRUE(scene->refit(Execution::serial()));
  expect_the_slow_hits(*scene, subject.soup);
}

// The piece of a vertex that flies off, and then of one beside it while the first is still away.
TEST(RayRefit, RemembersWhatIsMissingFromAPieceWhenOtherVerticesMove) {
  RayMesh subject = ball();
  auto scene = moving_scene(subject, 500);
  ASSERT_TRUE(scene);
  DirtySet dirty(subject.mesh);
  const auto follow = [&](Index v, std::int64_t pieces) {
    ASSERT_TRUE(dirty.find(subject.mesh, MovedVertices::range({v, v + 1})));
    ASSERT_TRUE(scene->refit(dirty, Execution::serial()));
    EXPECT_LE(scene->refitted_pieces(), pieces);
    expect_the_slow_hits(*scene, subject.soup);
  };
  const Index away = subject.soup.corners[0];
  const Index beside = subject.soup.corners[60];
  float& x = subject.soup.xyz[3 * static_cast<std::size_t>(away)];
  const float at_rest = x;
  x = kInfinity;
  follow(away, 6);
  subject.soup.xyz[3 * static_cast<std::size_t>(beside)] *= 1.1F;
  follow(beside, 6);
  x = at_rest;
  follow(away, 6);
  EXPECT_TRUE(scene->has_built());
  follow(away, 6);
  EXPECT_FALSE(scene->has_built());
}

}  // namespace
}  // namespace hedgerow
