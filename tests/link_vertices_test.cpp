#include "kernels/link_vertices.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "kernels/simd_path.h"

namespace hedgerow::kernels {
namespace {

// Slots of one block of vertices with every valence from 0 to beyond a slot: proper fans, open and
// closed, with now and then a neighbour that spoils them, and waste in the lanes not used.
struct BlockOfSlots {
  static constexpr Index kSize = 200;
  std::vector<CornerSlot> slot{kSize};
  std::vector<Index> count;
  Index halfedge_count = 0;

  explicit BlockOfSlots(std::uint32_t seed) {
    std::mt19937 random(seed);
    for (CornerSlot& s : slot) {
      for (Index i = 0; i < CornerSlot::kCapacity; ++i) {
        s.source[i] = kInvalidIndex;
        s.target[i] = 1000 + static_cast<Index>(random() % 8);
        s.halfedge[i] = static_cast<Index>(random());
        s.incoming[i] = static_cast<Index>(random());
      }
      const Index k = static_cast<Index>(random() % (CornerSlot::kCapacity + 3));
      const bool closed = random() % 4 != 0;
      // The fan, its corners in any order.
      std::vector<Index> place(static_cast<std::size_t>(k));
      for (Index i = 0; i < k; ++i) place[static_cast<std::size_t>(i)] = i;
      std::shuffle(place.begin(), place.end(), random);
      for (Index i = 0; i < k; ++i) {
        const Index at = place[static_cast<std::size_t>(i)];
        if (at >= CornerSlot::kCapacity) continue;
        const Index target = closed && i + 1 == k ? 1000 : 1000 + i + 1;
        const bool is_spoilt = random() % 40 == 0;
        s.source[at] = 1000 + i;
        s.target[at] = is_spoilt ? 1000 + static_cast<Index>(random() % 8) : target;
        s.halfedge[at] = halfedge_count + 3 * at;
        s.incoming[at] = halfedge_count + 3 * at + 1;
      }
      halfedge_count += 3 * k;
      count.push_back(k);
    }
  }
};

struct Linked {
  std::vector<Index> opposite;
  std::vector<Index> outgoing;
  std::vector<Index> irregular;
  LinkStats stats;
};

template <class Kernel>
Linked run(BlockOfSlots& block, const Kernel& kernel) {
  Linked linked;
  linked.opposite.assign(static_cast<std::size_t>(block.halfedge_count), -7);
  linked.outgoing.assign(BlockOfSlots::kSize, -7);
  linked.irregular.assign(BlockOfSlots::kSize, -7);
  const CornerSlots slots{{0, BlockOfSlots::kSize}, block.slot.data(), block.count.data()};
  linked.stats =
      kernel(slots, linked.opposite.data(), linked.outgoing.data(), linked.irregular.data());
  return linked;
}

TEST(LinkVertices, GivesTheSameInEveryForm) {
  if (simd_path() == SimdPath::portable) GTEST_SKIP() << "no AVX2, or indices of 64 bits";
  Index irregular = 0;
  Index regular = 0;
  for (std::uint32_t seed = 1; seed <= 500; ++seed) {
    BlockOfSlots block(seed);
    const Linked fast = run(block, link_vertices_avx2);
    const Linked plain = run(block, link_vertices_scalar);
    ASSERT_EQ(fast.opposite, plain.opposite) << "seed " << seed;
    ASSERT_EQ(fast.outgoing, plain.outgoing) << "seed " << seed;
    ASSERT_EQ(fast.irregular, plain.irregular) << "seed " << seed;
    ASSERT_EQ(fast.stats.paired_count, plain.stats.paired_count) << "seed " << seed;
    ASSERT_EQ(fast.stats.step_count, plain.stats.step_count) << "seed " << seed;
    irregular += fast.stats.irregular_count;
    regular += BlockOfSlots::kSize - fast.stats.irregular_count;
  }
  EXPECT_GT(irregular, 10'000);
  EXPECT_GT(regular, 10'000);
}

TEST(LinkVertices, WritesNothingForAVertexItLeaves) {
  BlockOfSlots block(5);
  for (const auto kernel : {link_vertices, link_vertices_scalar}) {
    const Linked linked = run(block, kernel);
    ASSERT_GT(linked.stats.irregular_count, 0);
    for (Index i = 0; i < linked.stats.irregular_count; ++i) {
      const auto v = static_cast<std::size_t>(linked.irregular[static_cast<std::size_t>(i)]);
      EXPECT_EQ(linked.outgoing[v], -7);
      for (Index n = 0; n < std::min(block.count[v], CornerSlot::kCapacity); ++n) {
        const auto h = static_cast<std::size_t>(block.slot[v].halfedge[n]);
        EXPECT_EQ(linked.opposite[h], -7);
      }
    }
  }
}

// The fan v0 -> v1 -> ... of k corners: closed, open, or with one neighbour spoilt.
std::vector<Corner> fan(Index k, bool closed) {
  std::vector<Corner> corners;
  for (Index i = 0; i < k; ++i) {
    const Index target = closed && i + 1 == k ? 1000 : 1000 + i + 1;
    corners.push_back({3 * i, target, 1000 + i, 3 * i + 1});
  }
  return corners;
}

TEST(LinkFan, TakesOpenAndClosedFans) {
  for (Index k = 1; k <= kSmallValence; ++k) {
    for (const bool closed : {false, true}) {
      std::vector<Index> opposite(static_cast<std::size_t>(3 * k), -7);
      Index outgoing = -7;
      LinkStats stats;
      const bool linked = link_fan(fan(k, closed), opposite.data(), outgoing, stats);
      // A closed fan of one is a corner whose neighbours are one vertex: no face has it.
      ASSERT_EQ(linked, !closed || k > 2) << k;
      if (!linked) {
        EXPECT_EQ(outgoing, -7);
        continue;
      }
      EXPECT_EQ(outgoing, 0);
      EXPECT_EQ(stats.boundary_count, closed ? 0 : 1);
      EXPECT_EQ(stats.paired_count, closed ? k : k - 1);
      for (Index i = 0; i < k; ++i) {
        const Index last = closed ? 1 : kInvalidIndex;
        EXPECT_EQ(opposite[static_cast<std::size_t>(3 * i)], i + 1 == k ? last : 3 * i + 4);
      }
    }
  }
}

TEST(LinkFan, LeavesTwoFans) {
  for (Index k = 2; k <= kSmallValence; ++k) {
    for (Index spoilt = 0; spoilt < k; ++spoilt) {
      std::vector<Corner> corners = fan(k, true);
      corners[static_cast<std::size_t>(spoilt)].target = 5000;
      std::vector<Index> opposite(static_cast<std::size_t>(3 * k), -7);
      Index outgoing = -7;
      LinkStats stats;
      ASSERT_TRUE(link_fan(corners, opposite.data(), outgoing, stats)) << "one gap: open";
      if (k < 3) continue;
      corners[static_cast<std::size_t>((spoilt + 1) % k)].target = 5001;
      outgoing = -7;
      EXPECT_FALSE(link_fan(corners, opposite.data(), outgoing, stats)) << "two gaps: two fans";
      EXPECT_EQ(outgoing, -7);
    }
  }
}

}  // namespace
}  // namespace hedgerow::kernels
