#include "kernels/link_vertices.h"

#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace hedgerow::kernels {
namespace {

// Corners of one block of vertices with every valence from 0 to beyond kSmallValence: proper fans,
// open and closed, with now and then a neighbour that spoils them.
struct BlockOfCorners {
  std::vector<Index> ends;
  std::vector<Corner> corners;
  Index halfedge_count = 0;

  explicit BlockOfCorners(std::uint32_t seed) {
    std::mt19937 random(seed);
    for (Index v = 0; v < 200; ++v) {
      const Index k = static_cast<Index>(random() % (kSmallValence + 4));
      const bool closed = random() % 2 == 0;
      for (Index i = 0; i < k; ++i) {
        const Index target = closed && i + 1 == k ? 1000 : 1000 + i + 1;
        const Index spoilt = random() % 40 == 0 ? 1000 + static_cast<Index>(random() % 8) : target;
        corners.push_back({halfedge_count, spoilt, 1000 + i, halfedge_count + 1});
        halfedge_count += 3;
      }
      ends.push_back(static_cast<Index>(corners.size()));
    }
    corners.resize(corners.size() + kCornerPadding, Corner{0, 1000, 1000, 0});
  }
};

struct Linked {
  std::vector<Index> opposite;
  std::vector<Index> outgoing;
  std::vector<Index> irregular;
  LinkStats stats;
};

template <class Kernel>
Linked run(const BlockOfCorners& block, const Kernel& kernel) {
  const auto size = static_cast<Index>(block.ends.size());
  Linked linked;
  linked.opposite.assign(static_cast<std::size_t>(block.halfedge_count), -7);
  linked.outgoing.assign(block.ends.size(), -7);
  linked.irregular.assign(block.ends.size(), -7);
  linked.stats = kernel(VertexBlock{0, size}, block.ends.data(), block.corners.data(),
                        linked.opposite.data(), linked.outgoing.data(), linked.irregular.data());
  return linked;
}

TEST(LinkVertices, GivesTheSameAsTheScalarForm) {
  Index irregular = 0;
  Index regular = 0;
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    const BlockOfCorners block(seed);
    const Linked fast = run(block, link_vertices);
    const Linked plain = run(block, link_vertices_scalar);
    ASSERT_EQ(fast.opposite, plain.opposite) << "seed " << seed;
    ASSERT_EQ(fast.outgoing, plain.outgoing) << "seed " << seed;
    ASSERT_EQ(fast.irregular, plain.irregular) << "seed " << seed;
    ASSERT_EQ(fast.stats.paired_count, plain.stats.paired_count) << "seed " << seed;
    irregular += fast.stats.irregular_count;
    regular += static_cast<Index>(block.ends.size()) - fast.stats.irregular_count;
  }
  EXPECT_GT(irregular, 1000);
  EXPECT_GT(regular, 10'000);
}

TEST(LinkVertices, WritesNothingForAVertexItLeaves) {
  const BlockOfCorners block(5);
  const Linked linked = run(block, link_vertices);
  ASSERT_GT(linked.stats.irregular_count, 0);
  for (Index i = 0; i < linked.stats.irregular_count; ++i) {
    const auto v = static_cast<std::size_t>(linked.irregular[static_cast<std::size_t>(i)]);
    EXPECT_EQ(linked.outgoing[v], -7);
  }
}

}  // namespace
}  // namespace hedgerow::kernels
