#include "hedgerow/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/shapes.h"
#include "support/meshes.h"
#include "support/plain_build.h"
#include "support/random_faces.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

using Point = std::array<double, 3>;

MutablePositions all_of(std::vector<float>& xyz) {
  return {xyz.data(), static_cast<std::int64_t>(xyz.size() / 3)};
}
std::vector<float> smoothed(const Connectivity& mesh, std::vector<float> xyz,
                            const SmoothOptions& options,
                            const Execution& execution = Execution::serial()) {
  Workspace workspace;
  EXPECT_TRUE(smooth(mesh, all_of(xyz), options, execution, workspace));
  return xyz;
}
std::vector<float> points_of(const Soup& soup) { return {soup.xyz.begin(), soup.xyz.end()}; }

// From the faces alone: who is joined to whom, and with which angles across.
class PlainRings {
 public:
  explicit PlainRings(const PlainFaces& list) : count_(list.vertex_count) {
    for (const auto& face : list.faces) {
      for (std::size_t k = 0; k < face.size(); ++k) {
        const auto a = static_cast<std::size_t>(face[k]);
        const auto b = static_cast<std::size_t>(face[(k + 1) % face.size()]);
        const auto across = static_cast<std::size_t>(face[(k + 2) % face.size()]);
        across_[{std::min(a, b), std::max(a, b)}].push_back(across);
        neighbours_[a].insert(b);
        neighbours_[b].insert(a);
      }
    }
  }
  // All edges of the vertex have two faces.
  [[nodiscard]] bool is_inner(std::size_t v) const {
    const auto found = neighbours_.find(v);
    if (found == neighbours_.end()) return false;
    return std::all_of(found->second.begin(), found->second.end(), [&](std::size_t w) {
      return across_.at({std::min(v, w), std::max(v, w)}).size() == 2;
    });
  }
  void step(std::vector<Point>& points, double length, bool has_cotangents, bool in_place) const {
    const std::vector<Point> before = points;
    for (std::size_t v = 0; v < static_cast<std::size_t>(count_); ++v) {
      if (!is_inner(v)) continue;
      const std::vector<Point>& from = in_place ? points : before;
      Point mean{};
      double weights = 0;
      for (const std::size_t w : neighbours_.at(v)) {
        double weight = 1;
        if (has_cotangents) {
          weight = 0;
          for (const std::size_t a : across_.at({std::min(v, w), std::max(v, w)})) {
            weight += std::max(0.0, cotangent(from[a], from[v], from[w]));
          }
        }
        for (std::size_t k = 0; k < 3; ++k) mean[k] += weight * from[w][k];
        weights += weight;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        points[v][k] = static_cast<float>(from[v][k] + length * (mean[k] / weights - from[v][k]));
      }
    }
  }

 private:
  static double cotangent(const Point& p, const Point& a, const Point& b) {
    double uu = 0;
    double vv = 0;
    double uv = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      uu += (a[k] - p[k]) * (a[k] - p[k]);
      vv += (b[k] - p[k]) * (b[k] - p[k]);
      uv += (a[k] - p[k]) * (b[k] - p[k]);
    }
    return 1 / std::tan(std::acos(uv / std::sqrt(uu * vv)));
  }

  std::int64_t count_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> across_;
  std::map<std::size_t, std::set<std::size_t>> neighbours_;
};

PlainFaces plain_of(const Soup& soup) {
  PlainFaces list{{}, soup.vertex_count()};
  for (Index f = 0; f < soup.face_count(); ++f) {
    list.faces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      list.faces.back().push_back(soup.corners[3 * static_cast<std::size_t>(f) + k]);
    }
  }
  return list;
}

TEST(Smooth, DoesWhatTheFacesSay) {
  for (const Soup& soup : {*shapes::torus(10, 7), *shapes::terrain(9, 8), *shapes::icosphere(2)}) {
    const PlainRings plain(plain_of(soup));
    const Connectivity open = built(soup);
    const Connectivity closed = std::move(*close_boundary(open, Execution::serial()));
    for (const SmoothWeights weights : {SmoothWeights::umbrella, SmoothWeights::cotangent}) {
      for (const SmoothUpdate update : {SmoothUpdate::double_buffered, SmoothUpdate::in_place}) {
        const SmoothOptions options{3, 0.75F, weights, update};
        std::vector<Point> expected;
        for (std::size_t i = 0; i < soup.xyz.size(); i += 3) {
          expected.push_back({soup.xyz[i], soup.xyz[i + 1], soup.xyz[i + 2]});
        }
        for (int i = 0; i < options.iterations; ++i) {
          plain.step(expected, 0.75, weights == SmoothWeights::cotangent,
                     update == SmoothUpdate::in_place);
        }
        const std::vector<float> found = smoothed(open, points_of(soup), options);
        for (std::size_t i = 0; i < found.size(); ++i) {
          ASSERT_NEAR(found[i], expected[i / 3][i % 3], 2e-6) << i;
        }
        EXPECT_EQ(smoothed(closed, points_of(soup), options), found);
      }
    }
  }
}

TEST(Smooth, GivesTheSameBitsOnAllThreads) {
  const Soup soup = *shapes::gyroid(14);
  const Connectivity mesh = built(soup);
  for (const SmoothWeights weights : {SmoothWeights::umbrella, SmoothWeights::cotangent}) {
    const SmoothOptions options{5, 1, weights, SmoothUpdate::double_buffered};
    const std::vector<float> expected = smoothed(mesh, points_of(soup), options);
    for (const int count : kThreadCounts) {
      Threads threads(count);
      EXPECT_EQ(smoothed(mesh, points_of(soup), options, threads.execution(3)), expected);
    }
  }
}

// Meshes in the closed form take the plain way round each ring, triangles in the default form the
// widest that the processor has: many vertices at a time, some left to the plain way.
TEST(Smooth, GivesTheSameBitsByThePlainWay) {
  Random random(11);
  bool is_moved = false;
  for (const Soup& soup : {*shapes::gyroid(14), *shapes::terrain(23, 31),
                           *shapes::fan(40, shapes::FanEnds::closed), *shapes::icosphere(4)}) {
    const Connectivity open = built(soup);
    const Connectivity closed = std::move(*close_boundary(open, Execution::serial()));
    std::vector<float> xyz = points_of(soup);
    for (float& x : xyz) {
      x = static_cast<float>(random.below(1 << 20)) / 1024;
      if (random.below(64) == 0) x *= 1e38F;
      if (random.below(512) == 0) x = std::numeric_limits<float>::infinity();
    }
    for (const SmoothUpdate update : {SmoothUpdate::double_buffered, SmoothUpdate::in_place}) {
      for (const float step : {1.0F, 0.3F}) {
        const SmoothOptions options{4, step, SmoothWeights::umbrella, update};
        const std::vector<float> found = smoothed(open, xyz, options);
        const std::vector<float> expected = smoothed(closed, xyz, options);
        ASSERT_EQ(found.size(), expected.size());
        EXPECT_EQ(std::memcmp(found.data(), expected.data(), sizeof(float) * found.size()), 0);
        is_moved |= found != xyz;
      }
    }
  }
  EXPECT_TRUE(is_moved);
}

TEST(Smooth, HoldsTheBoundaryAndWhatIsNotManifold) {
  Random random(6);
  std::size_t held_count = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const PlainFaces list = random_faces(seed);
    const auto built = build_plain(list);
    if (!built) continue;
    std::vector<float> xyz;
    for (Index i = 0; i < 3 * built->mesh.vertex_count(); ++i) {
      xyz.push_back(static_cast<float>(random.below(2001)) / 64);
    }
    const std::vector<float> found = smoothed(built->mesh, xyz, {2});
    std::set<std::size_t> held;
    built->mesh.visit([&](const auto& view) {
      for (HalfedgeId h(0); h.value < view.halfedge_count(); ++h.value) {
        if (view.opposite[h].valid()) continue;
        held.insert(static_cast<std::size_t>(view.origin[h].value));
        held.insert(static_cast<std::size_t>(view.target(h).value));
      }
      for (const FanStart& fan : view.fans) held.insert(static_cast<std::size_t>(fan.vertex.value));
    });
    held_count += held.size();
    for (const std::size_t v : held) {
      EXPECT_EQ(std::memcmp(&found[3 * v], &xyz[3 * v], sizeof(float[3])), 0) << seed << " " << v;
    }
  }
  EXPECT_GT(held_count, 1000U);
}

TEST(Smooth, LeavesAFlatMeshFlatAndByCotangentsAsItIs) {
  Soup soup = *shapes::grid(12, 9);
  for (std::size_t i = 2; i < soup.xyz.size(); i += 3) soup.xyz[i] = 0.5F;
  const Connectivity mesh = built(soup);
  const std::vector<float> found =
      smoothed(mesh, points_of(soup), {10, 1, SmoothWeights::cotangent});
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], soup.xyz[i], 1e-5);
}

TEST(Smooth, LeavesWhatHasNoFiniteMean) {
  Soup soup = *shapes::torus(8, 6);
  soup.xyz[0] = std::numeric_limits<float>::quiet_NaN();
  const Connectivity mesh = built(soup);
  const std::vector<float> found = smoothed(mesh, points_of(soup), {3});
  EXPECT_TRUE(std::isnan(found[0]));
  EXPECT_EQ(std::count_if(found.begin(), found.end(), [](float x) { return !std::isfinite(x); }),
            1);
}

TEST(Smooth, KeepsTheBytesBetweenAndAllocatesNothingTwice) {
  const Soup soup = *shapes::torus(8, 6);
  const Connectivity mesh = built(soup);
  std::vector<float> padded(4 * static_cast<std::size_t>(mesh.vertex_count()), 7.0F);
  for (std::size_t i = 0; i < soup.xyz.size(); ++i) padded[i / 3 * 4 + i % 3] = soup.xyz[i];
  Workspace workspace;
  const MutablePositions positions{padded.data(), mesh.vertex_count(), sizeof(float[4])};
  ASSERT_TRUE(smooth(mesh, positions, {3}, Execution::serial(), workspace));
  const std::vector<float> expected = smoothed(mesh, points_of(soup), {3});
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(padded[i / 3 * 4 + i % 3], expected[i]);
  for (std::size_t v = 0; 4 * v < padded.size(); ++v) EXPECT_EQ(padded[4 * v + 3], 7.0F);
  EXPECT_EQ(
      workspace.size_bytes() / sizeof(float[3]) >= static_cast<std::size_t>(mesh.vertex_count()),
      true);
}

TEST(Smooth, RefusesWhatDoesNotFitAndMovesNothing) {
  const auto built = build_plain(mixed_row());
  ASSERT_TRUE(built);
  std::vector<float> xyz(3 * static_cast<std::size_t>(built->mesh.vertex_count()), 1.0F);
  const auto error = [&](const MutablePositions& positions, const SmoothOptions& options) {
    Workspace workspace;
    const auto done = smooth(built->mesh, positions, options, Execution::serial(), workspace);
    return done ? Error{} : done.error();
  };
  const MutablePositions good = all_of(xyz);
  EXPECT_EQ(error({good.data, good.count - 1}, {}).code, ErrorCode::count_mismatch);
  EXPECT_EQ(error({good.data, good.count, 6}, {}).code, ErrorCode::bad_stride);
  EXPECT_EQ(error({nullptr, good.count}, {}).code, ErrorCode::null_pointer);
  EXPECT_EQ(error(good, {1, 1, SmoothWeights::cotangent}).code, ErrorCode::not_triangles);
  std::array<std::byte, 8> few{};
  Workspace fixed{std::span<std::byte>(few)};
  const auto small = smooth(built->mesh, good, {}, Execution::serial(), fixed);
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().code, ErrorCode::scratch_too_small);
  EXPECT_TRUE(std::all_of(xyz.begin(), xyz.end(), [](float x) { return x == 1.0F; }));
}

}  // namespace
}  // namespace hedgerow::test
