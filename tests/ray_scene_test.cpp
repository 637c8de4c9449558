#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/ray/scene.h"
#include "hedgerow/shapes.h"
#include "support/allocations.h"
#include "support/guarded.h"
#include "support/ray_cases.h"
#include "support/threads.h"
#include "support/worker_count.h"

namespace hedgerow {
namespace {

using ray::Device;
using ray::Motion;
using ray::PaddedPositions;
using ray::Ray;
using ray::Scene;
using ray::SceneOptions;
using test::RayMesh;

RayMesh sphere(int level = 4) { return {"icosphere", *shapes::icosphere(level)}; }

float height(const Scene& scene, float x, float y) {
  const ray::Hit hit = scene.intersect(Ray{.origin = {x, y, 100}, .direction = {0, 0, -1}});
  return hit.valid() ? 100 - hit.t : -100;
}

TEST(RayScene, CopiesNothingOfTrianglesAndOfQuads) {
  if (sizeof(Index) != 4) GTEST_SKIP() << "Embree wants 32-bit indices: wider ones are copied";
  for (const RayMesh& subject : test::ray_meshes()) {
    const auto scene = scene_of(subject);
    ASSERT_TRUE(scene);
    if (subject.name == "mixed") {
      EXPECT_EQ(scene->stats().cut_face_count, 3 * 12);
      EXPECT_GT(scene->stats().copied_bytes, 0U);
    } else {
      EXPECT_EQ(scene->stats().copied_bytes, 0U) << subject.name;
      EXPECT_EQ(scene->stats().cut_face_count, 0);
    }
  }
}

// The arrays of the caller are what Embree reads: a change of either shows after a rebuild, though
// nobody was given the new numbers.
TEST(RayScene, ReadsTheArraysOfTheCaller) {
  if (sizeof(Index) != 4) GTEST_SKIP() << "Embree wants 32-bit indices: wider ones are copied";
  std::vector<Index> corners = {0, 1, 2};
  std::vector<float> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0};
  const FaceList faces = FaceList::triangles<Index>(corners, 4);
  const auto built = hedgerow::build(faces, {.borrow_corners = true}, Execution::serial());
  ASSERT_TRUE(built && built->mesh.borrows_origin());
  const auto device = Device::create();
  auto scene = Scene::build(*device, built->mesh, {{xyz.data(), 4}, xyz.size() * sizeof(float)}, {},
                            Execution::serial());
  ASSERT_TRUE(scene);
  EXPECT_EQ(height(*scene, 0.2F, 0.2F), 0);
  EXPECT_EQ(height(*scene, 0.8F, 0.8F), -100);
  corners[0] = 3;
  for (std::size_t i = 2; i < 12; i += 3) xyz[i] = 7;
  ASSERT_TRUE(scene->rebuild(Execution::serial()));
  EXPECT_EQ(height(*scene, 0.2F, 0.2F), -100);
  EXPECT_EQ(height(*scene, 0.8F, 0.8F), 7);
}

TEST(RayScene, AsksForPaddingInsteadOfFaulting) {
  const RayMesh subject = sphere(1);
  const auto device = Device::create();
  for (const std::size_t stride : {std::size_t{12}, std::size_t{16}, std::size_t{32}}) {
    const auto count = static_cast<std::size_t>(subject.soup.vertex_count());
    const std::size_t needed = (count - 1) * stride + 16;
    const test::Guarded memory(needed, true);
    ASSERT_TRUE(memory.is_ready());
    for (std::size_t v = 0; v < count; ++v) {
      std::memcpy(reinterpret_cast<std::byte*>(memory.floats()) + v * stride,
                  subject.soup.positions()[static_cast<Index>(v)], 12);
    }
    const Positions positions{memory.floats(), subject.soup.vertex_count(), stride};
    EXPECT_EQ(ray::bytes_read(positions), needed);
    for (const Motion motion : {Motion::still, Motion::moving}) {
      const auto scene = Scene::build(*device, subject.mesh, {positions, needed},
                                      {.motion = motion}, Execution::serial());
      ASSERT_TRUE(scene);
      EXPECT_NEAR(height(*scene, 0.1F, 0.1F), 1, 0.2);
    }
    const auto refused =
        Scene::build(*device, subject.mesh, {positions, needed - 1}, {}, Execution::serial());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::needs_padding);
    EXPECT_EQ(refused.error().value, static_cast<std::int64_t>(needed) - 1);
    EXPECT_EQ(refused.error().limit, static_cast<std::int64_t>(needed));
    EXPECT_STREQ(name(refused.error().code), "needs-padding");
  }
}

TEST(RayScene, RefusesPositionsThatAreTooFewOrOddlySpaced) {
  const RayMesh subject = sphere(1);
  const auto device = Device::create();
  const auto code_of = [&](const Positions& positions) {
    const auto scene = Scene::build(*device, subject.mesh, {positions, std::size_t{1} << 40U}, {},
                                    Execution::serial());
    EXPECT_FALSE(scene);
    return scene ? ErrorCode::ray_library : scene.error().code;
  };
  const float* xyz = subject.soup.xyz.data();
  const std::int64_t count = subject.soup.vertex_count();
  EXPECT_EQ(code_of({xyz, count - 1}), ErrorCode::count_mismatch);
  EXPECT_EQ(code_of({nullptr, count}), ErrorCode::null_pointer);
  EXPECT_EQ(code_of({xyz, count, 14}), ErrorCode::bad_stride);
  EXPECT_EQ(code_of({xyz, count, 8}), ErrorCode::bad_stride);
  EXPECT_EQ(code_of({xyz, count, std::size_t{1} << 32U}), ErrorCode::too_many_elements);
}

TEST(RayScene, IsEmptyWithoutFaces) {
  Connectivity empty;
  const auto device = Device::create();
  for (const Motion motion : {Motion::still, Motion::moving}) {
    auto scene =
        Scene::build(*device, empty, {}, {.motion = motion, .piece_faces = 8}, Execution::serial());
    ASSERT_TRUE(scene);
    EXPECT_EQ(height(*scene, 0, 0), -100);
    EXPECT_FALSE(scene->closest_point({0, 0, 0}).valid());
    EXPECT_TRUE(scene->refit(Execution::serial()));
    EXPECT_TRUE(scene->rebuild(Execution::serial()));
  }
}

TEST(RayScene, TakesTheClosedFormOfAMesh) {
  RayMesh subject("grid", *shapes::grid(10, 10));
  const auto open = scene_of(subject);
  auto closed = close_boundary(subject.mesh, Execution::serial());
  ASSERT_TRUE(closed);
  subject.mesh = std::move(*closed);
  const auto scene = scene_of(subject);
  ASSERT_TRUE(scene);
  for (const Ray& ray : test::random_rays(subject.soup, 200, 5)) {
    EXPECT_EQ(scene->intersect(ray).primitive, open->intersect(ray).primitive);
  }
}

/// Lifts the vertices near (x, y) of a height field and returns them.
std::vector<Index> lift(Soup& soup, float x, float y, float radius, float by) {
  std::vector<Index> moved;
  for (Index v = 0; v < soup.vertex_count(); ++v) {
    float* xyz = soup.xyz.data() + 3 * v;
    if ((xyz[0] - x) * (xyz[0] - x) + (xyz[1] - y) * (xyz[1] - y) > radius * radius) continue;
    xyz[2] += by;
    moved.push_back(v);
  }
  return moved;
}

TEST(RayScene, FollowsWhatMovedAndRefitsNoOtherPiece) {
  RayMesh subject("grid", *shapes::grid(100, 100));
  auto pieces = scene_of(subject, {.motion = Motion::moving, .piece_faces = 500});
  auto whole = scene_of(subject, {.motion = Motion::moving});
  ASSERT_TRUE(pieces && whole);
  EXPECT_EQ(pieces->stats().piece_count, 40);
  EXPECT_EQ(whole->stats().piece_count, 1);
  DirtySet dirty(subject.mesh);
  for (int frame = 0; frame < 5; ++frame) {
    const auto x = static_cast<float>(20 + 10 * frame);
    const std::vector<Index> moved = lift(subject.soup, x, 50, 4, 10);
    ASSERT_TRUE(dirty.find(subject.mesh, MovedVertices::list(moved)));
    ASSERT_TRUE(pieces->refit(dirty, Execution::serial()));
    ASSERT_TRUE(whole->refit(dirty, Execution::serial()));
    EXPECT_GT(pieces->refitted_pieces(), 0);
    EXPECT_LT(pieces->refitted_pieces(), 8);
    const auto fresh = scene_of(subject);
    for (const Ray& ray : test::random_rays(subject.soup, 300, 7)) {
      const ray::Hit expected = fresh->intersect(ray);
      for (const Scene* scene : {&*pieces, &*whole}) {
        const ray::Hit hit = scene->intersect(ray);
        ASSERT_EQ(hit.valid(), expected.valid());
        if (hit.valid()) {
          EXPECT_NEAR(hit.t, expected.t, 1e-4 * expected.t);
        }
      }
    }
  }
  ASSERT_TRUE(dirty.find(subject.mesh, MovedVertices::list({})));
  ASSERT_TRUE(pieces->refit(dirty, Execution::serial()));
  EXPECT_EQ(pieces->refitted_pieces(), 0);
  ASSERT_TRUE(dirty.find(subject.mesh, MovedVertices::range({0, subject.mesh.vertex_count()})));
  ASSERT_TRUE(pieces->refit(dirty, Execution::serial()));
  EXPECT_EQ(pieces->refitted_pieces(), 40);
}

TEST(RayScene, GoesOverToPositionsElsewhere) {
  RayMesh subject("grid", *shapes::grid(20, 20));
  auto scene = scene_of(subject, {.motion = Motion::moving, .piece_faces = 100});
  ASSERT_TRUE(scene);
  Buffer<float> other = Buffer<float>::copy_of(subject.soup.xyz.span());
  for (std::size_t i = 2; i < other.size(); i += 3) other[i] = 42;
  ASSERT_TRUE(scene->refit(PaddedPositions::of(other), Execution::serial()));
  EXPECT_EQ(height(*scene, 3.3F, 3.4F), 42);
  EXPECT_NEAR(scene->closest_point({3, 3, 50}).distance, 8, 1e-5);
  PaddedPositions bad = PaddedPositions::of(other);
  bad.readable_bytes = other.size_bytes();
  const auto refused = scene->refit(bad, Execution::serial());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::needs_padding);
  EXPECT_EQ(height(*scene, 3.3F, 3.4F), 42);
}

// Embree makes one string a commit, its name for a log; see EmbreeFacts.
TEST(RayScene, RefitsWithoutBuildingAndAllocatesNothingOfItsOwn) {
  RayMesh subject = sphere(6);
  const auto device = Device::create();
  ASSERT_TRUE(device);
  EXPECT_GE(device->version(), 31300);
  for (const Index piece_faces : {0, 4000}) {
    auto scene =
        Scene::build(*device, subject.mesh, PaddedPositions::of(subject.soup.xyz),
                     {.motion = Motion::moving, .piece_faces = piece_faces}, Execution::serial());
    ASSERT_TRUE(scene);
    EXPECT_TRUE(scene->has_built());
    const std::int64_t held = device->held_bytes();
    EXPECT_GT(held, 0);
    ASSERT_TRUE(scene->refit(Execution::serial()));
    ASSERT_TRUE(scene->refit(Execution::serial()));
    constexpr int kFrames = 20;
    const int allocations = test::allocation_count();
    for (int frame = 0; frame < kFrames; ++frame) {
      for (float& coordinate : subject.soup.xyz) coordinate *= 1.001F;
      ASSERT_TRUE(scene->refit(Execution::serial()));
      EXPECT_FALSE(scene->has_built());
    }
    EXPECT_LE(test::allocation_count() - allocations, kFrames);
    EXPECT_EQ(device->held_bytes(), held);
    ASSERT_TRUE(scene->rebuild(Execution::serial()));
    EXPECT_TRUE(scene->has_built());
  }
}

TEST(RayScene, BuildsAStillSceneAnewWhenItMoves) {
  RayMesh subject = sphere(4);
  auto scene = scene_of(subject);
  ASSERT_TRUE(scene);
  for (float& coordinate : subject.soup.xyz) coordinate *= 2;
  ASSERT_TRUE(scene->refit(Execution::serial()));
  EXPECT_TRUE(scene->has_built());
  EXPECT_NEAR(height(*scene, 0.1F, 0.1F), 2, 0.1);
}

TEST(RayScene, UsesTheCallingThreadAloneWhenToldSo) {
  const RayMesh subject = sphere(6);
  const int before = test::worker_entries();
  auto scene = scene_of(subject, {.motion = Motion::moving});
  ASSERT_TRUE(scene);
  ASSERT_TRUE(scene->refit(Execution::serial()));
  const auto loop = [](void*, Index count, Index, void (*body)(void*, Index, Index), void* user) {
    body(user, 0, count);
  };
  ASSERT_TRUE(scene->rebuild(Execution::callback(loop, nullptr, 2)));
  EXPECT_EQ(test::worker_entries(), before);
}

TEST(RayScene, MeetsTheSameAtTheSameDistanceWhateverTheThreads) {
  const RayMesh subject("gyroid", *shapes::gyroid(24));
  const auto serial = scene_of(subject);
  ASSERT_TRUE(serial);
  for (const int count : test::kThreadCounts) {
    test::Threads threads(count);
    const auto scene = scene_of(subject, {}, threads.execution());
    ASSERT_TRUE(scene);
    for (const Ray& ray : test::random_rays(subject.soup, 500, 11)) {
      EXPECT_EQ(scene->intersect(ray).t, serial->intersect(ray).t);
    }
  }
}

}  // namespace
}  // namespace hedgerow
