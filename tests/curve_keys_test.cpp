#include "kernels/curve_keys.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "reorder/stable_sort.h"
#include "support/threads.h"

namespace hedgerow::kernels {
namespace {

TEST(MortonKey, InterleavesTheBitsOfTheAxes) {
  EXPECT_EQ(morton_key({0, 0, 1}), 1U);
  EXPECT_EQ(morton_key({0, 1, 0}), 2U);
  EXPECT_EQ(morton_key({1, 0, 0}), 4U);
  EXPECT_EQ(morton_key({3, 0, 1}), 0b100101U);
  constexpr std::uint32_t kLast = (1U << kBitsPerAxis) - 1;
  EXPECT_EQ(morton_key({kLast, kLast, kLast}), (std::uint64_t{1} << 63U) - 1);
}

// All cells of a cube of 2^bits cells a side, somewhere on the lattice, in the order of the curve.
std::vector<std::pair<std::uint64_t, Cell>> along_curve(Cell corner, unsigned bits) {
  std::vector<std::pair<std::uint64_t, Cell>> cells;
  const std::uint32_t side = 1U << bits;
  for (std::uint32_t x = 0; x < side; ++x) {
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t z = 0; z < side; ++z) {
        const Cell cell = {corner[0] + x, corner[1] + y, corner[2] + z};
        cells.emplace_back(hilbert_key(cell), cell);
      }
    }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

TEST(HilbertKey, StepsFromEachCellToOneThatSharesASide) {
  for (const Cell corner : {Cell{0, 0, 0}, Cell{8, 16, 24}, Cell{1U << 20U, 1U << 19U, 0}}) {
    const auto cells = along_curve(corner, 3);
    for (std::size_t i = 1; i < cells.size(); ++i) {
      ASSERT_EQ(cells[i].first, cells[i - 1].first + 1);
      int steps = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        steps += std::abs(static_cast<int>(cells[i].second[k]) -
                          static_cast<int>(cells[i - 1].second[k]));
      }
      ASSERT_EQ(steps, 1);
    }
  }
}

TEST(Lattice, PlacesWhatIsNotFiniteInTheLastCell) {
  const std::vector<float> xyz = {0, 0, 0, 2, 4, 1, std::nanf(""), 1, 1};
  const Box box = find_box({0, 3}, {xyz.data(), 3});
  EXPECT_EQ(box.high[1], 4);
  const Lattice lattice(box);
  constexpr std::uint32_t kLast = (1U << kBitsPerAxis) - 1;
  EXPECT_EQ(lattice.cell(&xyz[0]), (Cell{0, 0, 0}));
  EXPECT_EQ(lattice.cell(&xyz[3]), (Cell{kLast / 2, kLast, kLast / 4}));
  EXPECT_EQ(lattice.cell(&xyz[6]), (Cell{kLast, kLast, kLast}));
}

TEST(Lattice, TakesPointsThatAreAllTheSameOrTheWidestThereAre) {
  constexpr float kMax = std::numeric_limits<float>::max();
  const std::vector<float> same = {7, 7, 7, 7, 7, 7};
  EXPECT_EQ(Lattice(find_box({0, 2}, {same.data(), 2})).cell(&same[0]), (Cell{0, 0, 0}));
  const std::vector<float> wide = {-kMax, 0, 0, kMax, 0, 0};
  constexpr std::uint32_t kLast = (1U << kBitsPerAxis) - 1;
  EXPECT_EQ(Lattice(find_box({0, 2}, {wide.data(), 2})).cell(&wide[3]), (Cell{kLast, 0, 0}))
      << "lowest is " << wide[0];
  const Lattice none(find_box({0, 0}, {}));
  EXPECT_EQ(none.cell(&same[0]), (Cell{0, 0, 0}));
}

TEST(StableSort, AgreesWithTheStandardOne) {
  std::mt19937_64 random(9);
  for (const Index count : {0, 1, 2, 1000, 200'000}) {
    for (const unsigned bits : {1U, 11U, 12U, 40U, 63U}) {
      std::vector<KeyedItem> expected;
      for (Index i = 0; i < count; ++i) expected.push_back({random() >> (64U - bits), i});
      for (const int threads : {1, 8}) {
        test::Threads pool(threads);
        Buffer<KeyedItem> items = Buffer<KeyedItem>::copy_of(expected);
        const Buffer<Index> found =
            hedgerow::detail::sorted_items(std::move(items), pool.execution());
        std::vector<KeyedItem> sorted = expected;
        std::stable_sort(sorted.begin(), sorted.end(),
                         [](const KeyedItem& a, const KeyedItem& b) { return a.key < b.key; });
        ASSERT_EQ(found.size(), sorted.size());
        for (std::size_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(found[i], sorted[i].item);
      }
    }
  }
}

}  // namespace
}  // namespace hedgerow::kernels
