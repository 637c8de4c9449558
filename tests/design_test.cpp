#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>

#include <gtest/gtest.h>

#include "hedgerow/build.h"

namespace hedgerow {
namespace {

bool holds(std::span<const Index> column, std::initializer_list<Index> expected) {
  return std::equal(column.begin(), column.end(), expected.begin(), expected.end());
}

TEST(Design, DrawsTheColumnsThatTheBuilderMakes) {
  const std::array<Index, 6> corners = {0, 1, 2, 1, 3, 2};
  auto built = build(FaceList::triangles<Index>(corners, 4), {}, Execution::serial());
  ASSERT_TRUE(built);
  EXPECT_TRUE(holds(built->mesh.origin(), {0, 1, 2, 1, 3, 2}));
  EXPECT_TRUE(holds(built->mesh.opposite(), {-1, 5, -1, -1, -1, 1}));
  EXPECT_TRUE(holds(built->mesh.outgoing(), {0, 1, 5, 4}));

  built->mesh.materialise(Execution::serial());
  const PolygonView mesh = built->mesh.polygons();
  EXPECT_TRUE(holds({mesh.next_of.data(), 6}, {1, 2, 0, 4, 5, 3}));
  EXPECT_TRUE(holds({mesh.face_of.data(), 6}, {0, 0, 0, 1, 1, 1}));
  EXPECT_TRUE(holds({mesh.first_of.data(), 3}, {0, 3, 6}));
}

// 12 bytes of `origin`, 12 of `opposite` and half a vertex of `outgoing` for 32-bit indices.
TEST(Design, TakesTwentySixBytesATriangleOnATorus) {
  constexpr Index kSide = 64;
  Buffer<Index> corners(6 * kSide * kSide);
  std::size_t corner = 0;
  for (Index y = 0; y < kSide; ++y) {
    for (Index x = 0; x < kSide; ++x) {
      const Index right = (x + 1) % kSide;
      const Index above = (y + 1) % kSide;
      for (const Index v : {y * kSide + x, y * kSide + right, above * kSide + x, y * kSide + right,
                            above * kSide + right, above * kSide + x}) {
        corners[corner++] = v;
      }
    }
  }
  const auto built =
      build(FaceList::triangles<Index>(corners.span(), kSide * kSide), {}, Execution::serial());
  ASSERT_TRUE(built);
  EXPECT_EQ(built->mesh.bytes(), std::size_t{26} * 2 * kSide * kSide * sizeof(Index) / 4);
}

}  // namespace
}  // namespace hedgerow
