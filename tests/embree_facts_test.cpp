// What hedgerow::ray relies on, asked of the installed Embree itself. Where one of these fails, the
// sentence in its name no longer holds, and the code that quotes it has to change.
#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <set>
#include <thread>
#include <vector>
#include <xmmintrin.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "embree_api.h"
#include "hedgerow/shapes.h"
#include "support/allocations.h"
#include "support/guarded.h"
#include "support/worker_count.h"

namespace hedgerow {
namespace {

using ray::Coherence;
using ray::embree::Query;

constexpr std::array<std::uint32_t, 3> kTriangle = {0, 1, 2};
constexpr std::array<float, 9> kCorners = {0, 0, 0, 1, 0, 0, 0, 1, 0};

/// One geometry in one scene, by the plainest calls.
class Embree {
 public:
  explicit Embree(RTCGeometryType type = RTC_GEOMETRY_TYPE_TRIANGLE, bool is_moving = false)
      : device(rtcNewDevice(nullptr)),
        scene(rtcNewScene(device)),
        geometry(rtcNewGeometry(device, type)) {
    if (is_moving) {
      rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
      rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
      rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
    }
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() {
    rtcReleaseGeometry(geometry);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  void share_vertices(const float* xyz, std::size_t count, std::size_t stride = 12) const {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, xyz, 0,
                               stride, count);
  }
  void share_faces(const std::uint32_t* corners, std::size_t count, std::size_t sides = 3) const {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                               sides == 3 ? RTC_FORMAT_UINT3 : RTC_FORMAT_UINT4, corners, 0,
                               sides * sizeof(std::uint32_t), count);
  }
  void commit() {
    rtcCommitGeometry(geometry);
    if (!is_attached_) rtcAttachGeometryByID(scene, geometry, 0);
    is_attached_ = true;
    rtcCommitScene(scene);
  }
  [[nodiscard]] RTCRayHit down(float x, float y) const {
    RTCRayHit ray{};
    ray.ray.org_x = x;
    ray.ray.org_y = y;
    ray.ray.org_z = 5;
    ray.ray.dir_z = -1;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    Query(Coherence::incoherent).intersect(scene, ray);
    return ray;
  }
  [[nodiscard]] bool meets(float x, float y) const {
    return down(x, y).hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }

  RTCDevice device;
  RTCScene scene;
  RTCGeometry geometry;

 private:
  bool is_attached_ = false;
};

std::vector<std::uint32_t> corners_of(const Soup& soup) {
  return {soup.corners.begin(), soup.corners.end()};
}

TEST(EmbreeFacts, SixteenBytesOfTheLastVertexAreRead) {
  constexpr std::size_t kLastVertex = 2 * 12;
  const test::Guarded memory(kLastVertex + 16, true);
  ASSERT_TRUE(memory.is_ready());
  std::memcpy(memory.floats(), kCorners.data(), sizeof kCorners);
  Embree embree;
  embree.share_vertices(memory.floats(), 3);
  embree.share_faces(kTriangle.data(), 1);
  embree.commit();
  EXPECT_TRUE(embree.meets(0.2F, 0.2F));
}

TEST(EmbreeFactsDeathTest, FourBytesBehindTheLastVertexHaveToBeThere) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer catches the signal";
#endif
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const test::Guarded memory(sizeof kCorners, true);
        std::memcpy(memory.floats(), kCorners.data(), sizeof kCorners);
        Embree embree;
        embree.share_vertices(memory.floats(), 3);
        embree.share_faces(kTriangle.data(), 1);
        embree.commit();
        std::_Exit(embree.meets(0.2F, 0.2F) ? 0 : 1);
      },
      ::testing::KilledBySignal(SIGSEGV), "");
}

TEST(EmbreeFacts, NoByteBehindTheLastIndexIsRead) {
  const Soup soup = *shapes::icosphere(3);
  const std::vector<std::uint32_t> corners = corners_of(soup);
  const std::size_t bytes = corners.size() * sizeof(std::uint32_t);
  for (const bool is_moving : {false, true}) {
    const test::Guarded memory(bytes, true);
    ASSERT_TRUE(memory.is_ready());
    auto* shared = reinterpret_cast<std::uint32_t*>(memory.floats());
    std::memcpy(shared, corners.data(), bytes);
    Embree embree(RTC_GEOMETRY_TYPE_TRIANGLE, is_moving);
    embree.share_vertices(soup.xyz.data(), static_cast<std::size_t>(soup.vertex_count()));
    embree.share_faces(shared, corners.size() / 3);
    embree.commit();
    embree.commit();
    EXPECT_TRUE(embree.meets(0.2F, 0.2F));
  }
}

TEST(EmbreeFacts, SharedBuffersAreReadWhereTheyAre) {
  std::vector<float> xyz(kCorners.begin(), kCorners.end());
  xyz.push_back(0);
  Embree embree;
  embree.share_vertices(xyz.data(), 3);
  embree.share_faces(kTriangle.data(), 1);
  embree.commit();
  EXPECT_EQ(rtcGetGeometryBufferData(embree.geometry, RTC_BUFFER_TYPE_VERTEX, 0), xyz.data());
  EXPECT_EQ(rtcGetGeometryBufferData(embree.geometry, RTC_BUFFER_TYPE_INDEX, 0), kTriangle.data());
  for (std::size_t i = 2; i < 9; i += 3) xyz[i] = 3;
  rtcUpdateGeometryBuffer(embree.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  embree.commit();
  EXPECT_EQ(embree.down(0.2F, 0.2F).ray.tfar, 2);
}

TEST(EmbreeFacts, CornersOfATriangleWeighOneLessUAndVThenUThenV) {
  const std::array<float, 10> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  Embree embree;
  embree.share_vertices(xyz.data(), 3);
  embree.share_faces(kTriangle.data(), 1);
  embree.commit();
  const RTCRayHit hit = embree.down(0.25F, 0.5F);
  EXPECT_NEAR(hit.hit.u, 0.25F, 1e-6);
  EXPECT_NEAR(hit.hit.v, 0.5F, 1e-6);
}

// u runs from corner 0 to 1 and v from 0 to 3. The corners lie in no plane: the height tells which
// diagonal the quad is cut along.
TEST(EmbreeFacts, AQuadIsTheTriangles013And231) {
  const std::array<float, 13> xyz = {0, 0, 1, 1, 0, 0, 1, 1, 1, 0, 1, 0, 0};
  const std::array<std::uint32_t, 4> quad = {0, 1, 2, 3};
  Embree embree(RTC_GEOMETRY_TYPE_QUAD);
  embree.share_vertices(xyz.data(), 4);
  embree.share_faces(quad.data(), 1, 4);
  embree.commit();
  const RTCRayHit low = embree.down(0.25F, 0.125F);
  EXPECT_NEAR(low.hit.u, 0.25F, 1e-6);
  EXPECT_NEAR(low.hit.v, 0.125F, 1e-6);
  EXPECT_NEAR(5 - low.ray.tfar, 1 - 0.25F - 0.125F, 1e-6);
  const RTCRayHit high = embree.down(0.75F, 0.875F);
  EXPECT_NEAR(high.hit.u, 0.75F, 1e-6);
  EXPECT_NEAR(high.hit.v, 0.875F, 1e-6);
  EXPECT_NEAR(5 - high.ray.tfar, 0.75F + 0.875F - 1, 1e-6);
}

TEST(EmbreeFacts, AQuadThatRepeatsItsLastCornerIsATriangle) {
  const std::array<float, 10> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  const std::array<std::uint32_t, 4> quad = {0, 1, 2, 2};
  Embree embree(RTC_GEOMETRY_TYPE_QUAD);
  embree.share_vertices(xyz.data(), 3);
  embree.share_faces(quad.data(), 1, 4);
  embree.commit();
  const RTCRayHit hit = embree.down(0.25F, 0.5F);
  ASSERT_NE(hit.hit.geomID, RTC_INVALID_GEOMETRY_ID);
  EXPECT_NEAR(hit.hit.u, 0.25F, 1e-6);
  EXPECT_NEAR(hit.hit.v, 0.5F, 1e-6);
  EXPECT_FALSE(embree.meets(0.6F, 0.6F));
}

TEST(EmbreeFacts, ATriangleWithAVertexThatIsNotFiniteIsLeftOut) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1.9e18F}) {
    const std::array<float, 13> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, bad, 0};
    const std::array<std::uint32_t, 6> faces = {0, 1, 2, 1, 3, 2};
    Embree embree;
    embree.share_vertices(xyz.data(), 4);
    embree.share_faces(faces.data(), 2);
    embree.commit();
    EXPECT_TRUE(embree.meets(0.2F, 0.2F));
    EXPECT_FALSE(embree.meets(0.8F, 0.8F));
  }
}

bool count_progress(void* user, double /*done*/) {
  ++*static_cast<std::atomic<int>*>(user);
  return true;
}
bool count_requests(void* user, ssize_t /*bytes*/, bool /*post*/) {
  ++*static_cast<std::atomic<int>*>(user);
  return true;
}

// How a rebuild is told from a refit: only a build reports progress. Memory would not do: a rebuild
// works in that of the build before.
TEST(EmbreeFacts, AMovingSceneIsRefittedUntilItsIndicesAreCalledNew) {
  Soup soup = *shapes::icosphere(5);
  const std::vector<std::uint32_t> corners = corners_of(soup);
  std::atomic<int> progress = 0;
  std::atomic<int> requests = 0;
  Embree embree(RTC_GEOMETRY_TYPE_TRIANGLE, true);
  rtcSetSceneProgressMonitorFunction(embree.scene, count_progress, &progress);
  rtcSetDeviceMemoryMonitorFunction(embree.device, count_requests, &requests);
  embree.share_vertices(soup.xyz.data(), static_cast<std::size_t>(soup.vertex_count()));
  embree.share_faces(corners.data(), corners.size() / 3);
  embree.commit();
  const int build_progress = progress;
  const int build_requests = requests;
  EXPECT_GT(build_progress, 0);
  EXPECT_GT(build_requests, 0);
  constexpr int kFrames = 10;
  const int allocations = test::allocation_count();
  for (int frame = 0; frame < kFrames; ++frame) {
    for (float& coordinate : soup.xyz) coordinate *= 1.01F;
    rtcUpdateGeometryBuffer(embree.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    embree.commit();
  }
  EXPECT_EQ(progress, build_progress);
  EXPECT_LE(test::allocation_count() - allocations, kFrames);  // a string each
  EXPECT_EQ(requests, build_requests);
  EXPECT_NEAR(5 - embree.down(0.01F, 0.02F).ray.tfar, std::pow(1.01, 10), 0.01);
  rtcUpdateGeometryBuffer(embree.geometry, RTC_BUFFER_TYPE_INDEX, 0);
  embree.commit();
  EXPECT_GT(progress, build_progress);
}

TEST(EmbreeFacts, ACommitStaysInTheArenaThatItIsCalledIn) {
  const Soup soup = *shapes::icosphere(6);
  const std::vector<std::uint32_t> corners = corners_of(soup);
  for (const bool is_moving : {false, true}) {
    Embree embree(RTC_GEOMETRY_TYPE_TRIANGLE, is_moving);
    embree.share_vertices(soup.xyz.data(), static_cast<std::size_t>(soup.vertex_count()));
    embree.share_faces(corners.data(), corners.size() / 3);
    tbb::task_arena alone(1);
    const int before = test::worker_entries();
    alone.execute([&] { embree.commit(); });
    EXPECT_EQ(test::worker_entries(), before);
    EXPECT_TRUE(embree.meets(0.2F, 0.2F));
  }
}

TEST(EmbreeFacts, ADeviceLeavesTheLimitOfThreadsAlone) {
  constexpr auto kLimit = tbb::global_control::max_allowed_parallelism;
  const std::size_t before = tbb::global_control::active_value(kLimit);
  const Embree embree;
  EXPECT_EQ(tbb::global_control::active_value(kLimit), before);
}

TEST(EmbreeFacts, ACommitLeavesTheModeOfFloatingPointAlone) {
  const Soup soup = *shapes::icosphere(4);
  const std::vector<std::uint32_t> corners = corners_of(soup);
  const unsigned before = _mm_getcsr();
  Embree embree;
  embree.share_vertices(soup.xyz.data(), static_cast<std::size_t>(soup.vertex_count()));
  embree.share_faces(corners.data(), corners.size() / 3);
  embree.commit();
  (void)embree.meets(0, 0);
  EXPECT_EQ(_mm_getcsr() & 0xFFC0U, before & 0xFFC0U);
}

TEST(EmbreeFacts, AnOccludedRayEndsAtMinusInfinity) {
  const std::array<float, 10> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  Embree embree;
  embree.share_vertices(xyz.data(), 3);
  embree.share_faces(kTriangle.data(), 1);
  embree.commit();
  for (const float x : {0.2F, 0.9F}) {
    RTCRay ray = embree.down(-5, -5).ray;
    ray.org_x = x;
    ray.org_y = 0.5F;
    ray.tfar = std::numeric_limits<float>::infinity();
    Query(Coherence::incoherent).occluded(embree.scene, ray);
    EXPECT_EQ(ray.tfar < 0, x < 0.5F);
  }
}

TEST(EmbreeFacts, LanesThatAreNotValidAreLeftAlone) {
  const std::array<float, 10> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  Embree embree;
  embree.share_vertices(xyz.data(), 3);
  embree.share_faces(kTriangle.data(), 1);
  embree.commit();
  RTCRayHit8 rays{};
  alignas(32) std::array<int, 8> valid{};
  for (std::size_t i = 0; i < 8; ++i) {
    valid[i] = i % 3 == 0 ? -1 : 0;
    rays.ray.org_x[i] = 0.2F;
    rays.ray.org_y[i] = 0.2F;
    rays.ray.org_z[i] = 5;
    rays.ray.dir_z[i] = -1;
    rays.ray.tfar[i] = 100;
    rays.ray.mask[i] = ~0U;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  Query(Coherence::coherent).intersect(valid.data(), embree.scene, rays);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(rays.hit.geomID[i] == 0, i % 3 == 0);
    EXPECT_EQ(rays.ray.tfar[i], i % 3 == 0 ? 5.0F : 100.0F);
  }
}

struct Offered {
  std::set<unsigned> primitives;
  float radius_to_set = -1;
};
bool remember(RTCPointQueryFunctionArguments* arguments) {
  auto& offered = *static_cast<Offered*>(arguments->userPtr);
  offered.primitives.insert(arguments->primID);
  if (offered.radius_to_set < 0) return false;
  arguments->query->radius = offered.radius_to_set;
  return true;
}

TEST(EmbreeFacts, APointQueryOffersWhatIsInTheRadiusAndFollowsASmallerOne) {
  const Soup soup = *shapes::grid(100, 100);
  const std::vector<std::uint32_t> corners = corners_of(soup);
  Embree embree;
  embree.share_vertices(soup.xyz.data(), static_cast<std::size_t>(soup.vertex_count()));
  embree.share_faces(corners.data(), corners.size() / 3);
  embree.commit();
  const auto offered_in = [&](float radius, float radius_to_set) {
    RTCPointQuery query{};
    query.x = 50.2F;
    query.y = 50.4F;
    query.radius = radius;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    Offered offered{{}, radius_to_set};
    rtcPointQuery(embree.scene, &query, &context, remember, &offered);
    return offered.primitives;
  };
  const std::set<unsigned> all = offered_in(std::numeric_limits<float>::infinity(), -1);
  EXPECT_EQ(all.size(), corners.size() / 3);
  const std::set<unsigned> near = offered_in(5, -1);
  EXPECT_LT(near.size(), 1000U);
  for (std::uint32_t f = 0; f < corners.size() / 3; ++f) {
    const float* xyz = soup.positions()[soup.corners[3 * f]];
    const float squared =
        (xyz[0] - 50.2F) * (xyz[0] - 50.2F) + (xyz[1] - 50.4F) * (xyz[1] - 50.4F) + xyz[2] * xyz[2];
    if (squared < 24) {
      EXPECT_TRUE(near.contains(f)) << f;
    }
  }
  EXPECT_LT(offered_in(std::numeric_limits<float>::infinity(), 2).size(), 1000U);
}

}  // namespace
}  // namespace hedgerow
