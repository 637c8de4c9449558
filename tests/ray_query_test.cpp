#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/ray/scene.h"
#include "hedgerow/ray/surface.h"
#include "support/ray_cases.h"

namespace hedgerow {
namespace {

using ray::Coherence;
using ray::Hit;
using ray::Motion;
using ray::PaddedPositions;
using ray::Ray;
using ray::Scene;
using ray::SurfacePoint;
using test::RayMesh;

constexpr int kRays = 2000;
constexpr double kTolerance = 1e-4;  // of a ray as long as the mesh, in float

FaceId face_at(const Connectivity& mesh, const SurfacePoint& point) {
  return mesh.visit([&](const auto& view) { return face_of(view, point); });
}

/// True if `hit` is one that the slow answer allows: the first, or one that is as near.
void expect_allowed(const RayMesh& subject, const Ray& ray, const Hit& hit,
                    const ray::PrimitiveMap& map, const std::vector<test::SlowHit>& slow) {
  const bool is_on_edge = std::ranges::any_of(
      slow, [](const test::SlowHit& candidate) { return candidate.margin < kTolerance; });
  if (!hit.valid()) {
    EXPECT_TRUE(slow.empty() || is_on_edge) << subject.name;
    return;
  }
  ASSERT_FALSE(slow.empty()) << subject.name;
  const SurfacePoint point = map.point(hit);
  const FaceId face = face_at(subject.mesh, point);
  const bool is_known = std::ranges::any_of(slow, [&](const test::SlowHit& candidate) {
    return candidate.face == face && std::abs(candidate.t - hit.t) < kTolerance * (1 + candidate.t);
  });
  EXPECT_TRUE(is_known) << subject.name << " face " << face.value << " at " << hit.t;
  if (!is_on_edge) {
    EXPECT_EQ(face, slow.front().face) << subject.name;
  }

  const ray::Vec3 met = subject.mesh.visit(
      [&](const auto& view) { return interpolate(view, point, subject.soup.positions()); });
  const auto size = static_cast<float>(test::diagonal_of(subject.soup));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(met[axis], ray.origin[axis] + hit.t * ray.direction[axis], size * kTolerance);
  }
  EXPECT_NEAR(point.weights[0] + point.weights[1] + point.weights[2], 1, 1e-5);
}

class RayQuery : public ::testing::TestWithParam<ray::SceneOptions> {};

TEST_P(RayQuery, MeetsTheFaceThatEveryTriangleTriedByItselfMeets) {
  for (const RayMesh& subject : test::ray_meshes()) {
    const Scene scene = *scene_of(subject, GetParam());
    const auto triangles = test::triangles_of(subject.soup);
    int misses = 0;
    for (const Ray& ray : test::random_rays(subject.soup, kRays, 1)) {
      const auto slow = test::slow_hits(subject.soup, triangles, ray);
      const Hit hit = scene.intersect(ray);
      expect_allowed(subject, ray, hit, scene.primitives(), slow);
      if (!hit.valid()) ++misses;
      const bool is_on_edge = !slow.empty() && slow.front().margin < kTolerance;
      if (!is_on_edge) {
        EXPECT_EQ(scene.is_occluded(ray), !slow.empty()) << subject.name;
      }
    }
    EXPECT_GT(misses, 0) << subject.name;
    EXPECT_LT(misses, kRays) << subject.name;
  }
}

TEST_P(RayQuery, TracesEightRaysAsItTracesOne) {
  for (const RayMesh& subject : test::ray_meshes()) {
    const Scene scene = *scene_of(subject, GetParam());
    const auto triangles = test::triangles_of(subject.soup);
    const std::vector<Ray> rays = test::random_rays(subject.soup, 803, 2);
    for (std::size_t begin = 0; begin < rays.size(); begin += 8) {
      ray::RayPacket packet;
      packet.count = static_cast<int>(std::min<std::size_t>(8, rays.size() - begin));
      for (int i = 0; i < packet.count; ++i) {
        packet.set(static_cast<std::size_t>(i), rays[begin + static_cast<std::size_t>(i)]);
      }
      const ray::HitPacket hits = scene.intersect(packet);
      const ray::OccludedPacket occluded = scene.is_occluded(packet);
      for (std::size_t i = 0; i < 8; ++i) {
        if (static_cast<int>(i) >= packet.count) {
          EXPECT_FALSE(hits[i].valid() || occluded[i]);
          continue;
        }
        const auto slow = test::slow_hits(subject.soup, triangles, rays[begin + i]);
        expect_allowed(subject, rays[begin + i], hits[i], scene.primitives(), slow);
        if (slow.empty()) {
          EXPECT_FALSE(occluded[i]);
        }
        if (hits[i].valid() && slow.front().margin > kTolerance) {
          EXPECT_TRUE(occluded[i]);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Trees, RayQuery,
    ::testing::Values(ray::SceneOptions{}, ray::SceneOptions{.is_watertight = true},
                      ray::SceneOptions{.motion = Motion::moving},
                      ray::SceneOptions{.motion = Motion::moving, .piece_faces = 100}));

TEST(RayQueryRange, KeepsToNearAndFar) {
  const RayMesh subject("icosphere", std::move(test::ray_meshes().front().soup));
  const Scene scene = *scene_of(subject);
  Ray ray{.origin = {-3, 0.1F, 0.2F}, .direction = {1, 0, 0}};
  const Hit first = scene.intersect(ray);
  ASSERT_TRUE(first.valid());
  EXPECT_NEAR(first.t, 2, 0.1);
  ray.near = 2.5F;
  EXPECT_NEAR(scene.intersect(ray).t, 4, 0.1);
  ray.far = 3;
  EXPECT_FALSE(scene.intersect(ray).valid());
  EXPECT_FALSE(scene.is_occluded(ray));
}

TEST(RayQueryRange, MeetsNothingWithANan) {
  const RayMesh subject("icosphere", std::move(test::ray_meshes().front().soup));
  const Scene scene = *scene_of(subject);
  const Ray good{.origin = {-3, 0.1F, 0.2F}, .direction = {1, 0, 0}};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  ray::RayPacket packet;
  for (std::size_t i = 0; i < 8; ++i) {
    Ray bad = good;
    if (i < 3) bad.origin[i] = nan;
    if (i >= 3 && i < 6) bad.direction[i - 3] = nan;
    if (i == 6) bad.near = nan;
    if (i == 7) bad.far = nan;
    EXPECT_FALSE(scene.intersect(bad).valid()) << i;
    EXPECT_FALSE(scene.is_occluded(bad)) << i;
    packet.set(i, bad);
  }
  for (const Hit& hit : scene.intersect(packet)) EXPECT_FALSE(hit.valid());
  for (const bool is_occluded : scene.is_occluded(packet)) EXPECT_FALSE(is_occluded);
  EXPECT_TRUE(scene.is_occluded(good));
}

TEST(RayQueryRange, FindsTheSameHitsWhateverItMayExpect) {
  const RayMesh subject("icosphere", std::move(test::ray_meshes().front().soup));
  const Scene scene = *scene_of(subject);
  for (const Ray& ray : test::random_rays(subject.soup, 500, 3)) {
    const Hit coherent = scene.intersect(ray, Coherence::coherent);
    const Hit incoherent = scene.intersect(ray, Coherence::incoherent);
    EXPECT_EQ(coherent.t, incoherent.t);
    EXPECT_EQ(coherent.primitive, incoherent.primitive);
  }
}

}  // namespace
}  // namespace hedgerow
