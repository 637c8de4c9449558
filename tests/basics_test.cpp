#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

#include "hedgerow/buffer.h"
#include "hedgerow/column.h"
#include "hedgerow/index.h"
#include "hedgerow/workspace.h"

namespace hedgerow {
namespace {

bool is_cache_line_aligned(const void* address) {
  return reinterpret_cast<std::uintptr_t>(address) % 64 == 0;
}

TEST(Ids, AreInvalidUntilGivenAValue) {
  EXPECT_FALSE(VertexId().valid());
  EXPECT_EQ(VertexId().value, kInvalidIndex);
  EXPECT_TRUE(VertexId(0).valid());
}

TEST(Ids, AreOneIndexWide) {
  EXPECT_EQ(sizeof(Index) * 8, std::size_t{HEDGEROW_INDEX_BITS});
  EXPECT_EQ(sizeof(VertexId), sizeof(Index));
}

TEST(Ids, OfDifferentKindsDoNotConvert) {
  EXPECT_FALSE((std::is_convertible_v<VertexId, HalfedgeId>));
  EXPECT_FALSE((std::is_constructible_v<HalfedgeId, VertexId>));
  EXPECT_FALSE((std::is_convertible_v<Index, VertexId>));
}

TEST(Columns, TypePlainIndicesOnAccess) {
  const std::array<Index, 3> values = {2, 0, -1};
  const Column<HalfedgeId, VertexId> origin(values.data(), 3);
  EXPECT_EQ(origin[HalfedgeId(0)], VertexId(2));
  EXPECT_FALSE(origin[HalfedgeId(2)].valid());
  EXPECT_EQ(origin.data(), values.data());
}

TEST(Buffers, StartOnACacheLineAndHaveAReadableTail) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{1000}, std::size_t{3} << 20}) {
    const Buffer<float> buffer(size, 1.0F);
    EXPECT_TRUE(is_cache_line_aligned(buffer.data()));
    const volatile std::byte* tail = reinterpret_cast<const std::byte*>(buffer.end());
    for (std::size_t i = 0; i < kReadableTailBytes; ++i) (void)tail[i];
    EXPECT_EQ(buffer[size - 1], 1.0F);
  }
}

TEST(Buffers, GiveTheirMemoryAwayWhenMoved) {
  Buffer<int> from(4, 7);
  const int* memory = from.data();
  const Buffer<int> to = std::move(from);
  EXPECT_EQ(to.data(), memory);
  EXPECT_TRUE(from.empty());  // NOLINT(bugprone-use-after-move): this is the contract
}

TEST(Workspaces, KeepTheirMemoryWhenLessIsAskedFor) {
  Workspace workspace;
  ASSERT_TRUE(workspace.reserve(1000));
  const std::byte* memory = workspace.data();
  EXPECT_TRUE(is_cache_line_aligned(memory));
  ASSERT_TRUE(workspace.reserve(10));
  EXPECT_EQ(workspace.data(), memory);
}

TEST(Workspaces, OverACallersSpanNeverGrow) {
  std::array<std::byte, 256> memory{};
  Workspace workspace{std::span<std::byte>(memory)};
  EXPECT_TRUE(workspace.reserve(256 - 63));
  EXPECT_TRUE(is_cache_line_aligned(workspace.data()));
  EXPECT_FALSE(workspace.reserve(257));
  EXPECT_GE(workspace.data(), memory.data());
}

}  // namespace
}  // namespace hedgerow
