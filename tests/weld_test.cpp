#include "hedgerow/weld.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/random_faces.h"

namespace hedgerow::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::vector<Index> list(const Buffer<Index>& column) { return {column.begin(), column.end()}; }

Weld weld_of(const std::vector<float>& xyz, double distance) {
  auto weld = find_weld({xyz.data(), static_cast<std::int64_t>(xyz.size() / 3)}, distance);
  EXPECT_TRUE(weld);
  return std::move(*weld);
}

/// The smallest vertex of each one's group: every pair compared, until nothing changes.
std::vector<Index> groups(const std::vector<float>& xyz, double distance) {
  const std::size_t count = xyz.size() / 3;
  const auto is_near = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float p = xyz[3 * a + axis];
      const float q = xyz[3 * b + axis];
      if (std::isnan(p) || std::isnan(q)) return false;
      if (p == q) continue;
      sum += (static_cast<double>(p) - q) * (static_cast<double>(p) - q);
    }
    return sum <= distance * distance;
  };
  std::vector<Index> group(count);
  for (std::size_t v = 0; v < count; ++v) group[v] = static_cast<Index>(v);
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = 0; b < count; ++b) {
        if (a == b || group[b] <= group[a] || !is_near(a, b)) continue;
        group[b] = group[a];
        is_changed = true;
      }
    }
  }
  return group;
}

void expect_groups(const Weld& weld, const std::vector<Index>& group) {
  std::vector<Index> kept;
  for (std::size_t v = 0; v < group.size(); ++v) {
    if (group[v] == static_cast<Index>(v)) kept.push_back(static_cast<Index>(v));
  }
  EXPECT_EQ(list(weld.new_to_old), kept);
  ASSERT_EQ(weld.old_to_new.size(), group.size());
  for (std::size_t v = 0; v < group.size(); ++v) {
    EXPECT_EQ(weld.new_to_old[static_cast<std::size_t>(weld.old_to_new[v])], group[v]) << v;
  }
}

/// Points in clusters, on a lattice or anywhere, some of them twice and some not finite.
std::vector<float> random_points(Random& random) {
  const int count = random.below(120);
  const int kind = random.below(4);
  std::vector<float> xyz;
  for (int i = 0; i < 3 * count; ++i) {
    const auto any = static_cast<float>(random.below(1000)) / 1000;
    const auto whole = static_cast<float>(random.below(5) - 2);
    float x = kind == 0 ? any : kind == 1 ? whole : whole + any / 100;
    if (kind == 3 && random.one_in(10)) x *= 1e30F;
    if (kind == 3 && random.one_in(40)) x = random.one_in(2) ? kInfinity : -kInfinity;
    if (random.one_in(200)) x = kNan;
    xyz.push_back(x);
  }
  for (int copies = random.below(20); copies > 0 && count > 0; --copies) {
    const auto from = static_cast<std::size_t>(random.below(count));
    for (std::size_t axis = 0; axis < 3; ++axis) xyz.push_back(xyz[3 * from + axis]);
  }
  return xyz;
}

TEST(Welds, AreTheGroupsThatComparingEveryPairFinds) {
  for (std::uint64_t seed = 0; seed < 3000 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::vector<float> xyz = random_points(random);
    const double distance =
        random.any_of<double>({0, 1e-40, 1e-3, 0.01, 0.1, 0.3, 1, 1.5, 2, 10, 1e20, 1e40});
    expect_groups(weld_of(xyz, distance), groups(xyz, distance));
  }
}

TEST(Welds, ReachExactlyAsFarAsTheDistance) {
  const std::vector<float> xyz = {0, 0, 0, 3, 4, 0};
  EXPECT_EQ(weld_of(xyz, 5).merged_count(), 1);
  EXPECT_EQ(weld_of(xyz, 4.9999999).merged_count(), 0);
  // At any place of the grid of cells.
  for (int i = -2000; i < 2000; ++i) {
    const float x = static_cast<float>(i) / 256;
    EXPECT_EQ(weld_of({x, 0, 0, x + 0.25F, 0, 0}, 0.25).merged_count(), 1) << x;
    EXPECT_EQ(weld_of({x, 0, 0, x + 0.25F, 0, 0}, 0.2499).merged_count(), 0) << x;
  }
}

TEST(Welds, JoinARowOfNeighboursIntoOne) {
  std::vector<float> xyz;
  for (int i = 100; i > 0; --i) xyz.insert(xyz.end(), {static_cast<float>(i), 0, 0});
  const Weld weld = weld_of(xyz, 1);
  EXPECT_EQ(list(weld.new_to_old), std::vector<Index>{0});
}

TEST(Welds, TakeZeroForMinusZeroAndNothingForNotANumber) {
  const std::vector<float> xyz = {0, -0.0F, 1, -0.0F, 0, 1, kNan, 0, 0, kNan, 0, 0};
  EXPECT_EQ(list(weld_of(xyz, 0).new_to_old), (std::vector<Index>{0, 2, 3}));
  EXPECT_EQ(list(weld_of(xyz, 100).new_to_old), (std::vector<Index>{0, 2, 3}));
  EXPECT_TRUE(list(weld_of({}, 1).new_to_old).empty());
}

// Each of these takes minutes if points of neighbouring cells are compared one by one.
TEST(Welds, AreQuickWhereManyPointsCrowd) {
  constexpr int kCount = 200'000;
  const std::vector<float> one_place(3 * kCount, 1.5F);
  EXPECT_EQ(weld_of(one_place, 0.1).vertex_count(), 1);
  std::vector<float> clusters;
  Random random(1);
  for (int i = 0; i < kCount; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto spread = static_cast<float>(random.below(1 << 20)) / (1 << 26);
      clusters.push_back(spread + (axis == 0 && i % 2 == 0 ? 1.02F : 0.0F));
    }
  }
  EXPECT_EQ(weld_of(clusters, 1).vertex_count(), 2);
  EXPECT_EQ(weld_of(clusters, 1.02).vertex_count(), 1);
  EXPECT_EQ(weld_of(clusters, 1e6).vertex_count(), 1);
}

TEST(Welds, GiveAFaceListItsNewVertices) {
  Soup soup;
  const std::vector<float> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  soup.xyz = Buffer<float>::copy_of(xyz);
  soup.corners = Buffer<Index>::copy_of(std::vector<Index>{0, 1, 2, 3, 4, 5});
  const Soup one = welded(soup, weld_of(xyz, 0));
  EXPECT_EQ(one.vertex_count(), 4);
  EXPECT_EQ(list(one.corners), (std::vector<Index>{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(one.xyz[3 * 3], 1.0F);
}

TEST(Welds, RefuseAStrideThatNoPositionHas) {
  const float xyz[6] = {};
  const auto weld = find_weld({xyz, 2, 10}, 1);
  ASSERT_FALSE(weld);
  EXPECT_EQ(weld.error().code, ErrorCode::bad_stride);
}

}  // namespace
}  // namespace hedgerow::test
