// What corners add, as rows: each form of the kernels against the plain one, and the window over
// the faces against rows made for each face alone.

#include "kernels/term_rows.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/buffer.h"
#include "kernels/gather_normals.h"
#include "kernels/pair_windows.h"
#include "support/normal_meshes.h"

namespace hedgerow {
namespace {

using kernels::NormalWriter;
using kernels::TermRow;
using kernels::Triangles;

constexpr float kScales[] = {1.0F, 1e-25F, 1e18F, 1e30F};

// Random triangles over few vertices, some of them degenerate, some too small or too large for
// float; the last vertex is among them.
Soup random_triangles(unsigned seed, Index count) {
  Soup soup = test::random_soup(seed, 40, count, 3);
  std::mt19937 random(seed);
  for (float& x : soup.xyz.span()) x *= kScales[random() % 8 < 5 ? 0 : random() % 4];
  const auto corner = [&](Index c) -> Index& { return soup.corners.data()[c]; };
  for (Index f = 0; f < count; f += 11) corner(3 * f) = corner(3 * f + 1);
  if (count > 0) corner(3 * (count - 1)) = 39;
  return soup;
}

bool same_terms(std::span<const TermRow> a, std::span<const TermRow> b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool is_nan = a[i].term.x != a[i].term.x && b[i].term.x != b[i].term.x;
    if (!is_nan && std::memcmp(&a[i].term, &b[i].term, sizeof(kernels::Float3)) != 0) return false;
    if ((a[i].count > 0) != (b[i].count > 0)) return false;
  }
  return a.size() == b.size();
}

struct TermForm {
  const char* name;
  decltype(&kernels::fill_term_rows_scalar) fill;
  decltype(&kernels::add_terms_scalar) add;
};

std::vector<TermForm> forms(const kernels::Points& points) {
  std::vector<TermForm> all = {{"sse", kernels::fill_term_rows_sse, kernels::add_terms_sse}};
  if (kernels::suits_avx2(points)) {
    all.push_back({"avx2", kernels::fill_term_rows_avx2, kernels::add_terms_avx2});
  }
  if (kernels::suits_avx512(points)) {
    all.push_back({"avx512", kernels::fill_term_rows_avx512, kernels::add_terms_avx512});
  }
  return all;
}

TEST(TermRows, AreTheSameInEveryForm) {
  for (const Index count : {0, 1, 3, 7, 8, 9, 40, 63, 64, 65, 200}) {
    const Soup soup = random_triangles(static_cast<unsigned>(count) + 1, count);
    const kernels::Points points{soup.positions()};
    const Triangles triangles{soup.corners.data(), count, 3 * count};
    for (const NormalWeight weight : test::kWeights) {
      const auto rows = static_cast<std::size_t>(count * kernels::rows_of(weight));
      Buffer<TermRow> expected(rows);
      kernels::fill_term_rows_scalar(triangles, points, weight, expected.data());
      for (const TermForm& form : forms(points)) {
        Buffer<TermRow> found(rows);
        form.fill(triangles, points, weight, found.data());
        EXPECT_TRUE(same_terms(expected.span(), found.span()))
            << form.name << ", " << count << " triangles, " << static_cast<int>(weight);
      }
    }
  }
}

// Adds triangles to the sums of blocks of vertices, by every form.
void expect_same_sums(const kernels::Points& points, const Triangles& triangles,
                      std::initializer_list<IndexRange> blocks) {
  for (const NormalWeight weight : test::kWeights) {
    for (const IndexRange range : blocks) {
      const bool is_inside = range.size() == points.positions.count;
      const auto sums_of = [&](auto add) {
        Buffer<TermRow> sums(static_cast<std::size_t>(range.size()), TermRow{});
        add(triangles, {points, weight, {range.begin, range.size(), sums.data()}, is_inside});
        return sums;
      };
      const Buffer<TermRow> expected = sums_of(kernels::add_terms_scalar);
      for (const TermForm& form : forms(points)) {
        EXPECT_TRUE(same_terms(expected.span(), sums_of(form.add).span()))
            << form.name << ", weight " << static_cast<int>(weight) << ", from " << range.begin;
      }
    }
  }
}

TEST(TermRows, AddUpTheSameInEveryFormInsideABlockAndAcross) {
  const Index count = 150;
  const Soup soup = random_triangles(5, count);
  expect_same_sums({soup.positions()}, {soup.corners.data(), count, 3 * count},
                   {{0, 40}, {7, 19}, {39, 40}});
}

// Triangles of which pairs repeat along rows of vertices, by patterns of all kinds: the six corners
// of a pair lie near one another, so that they meet each vertex in every possible order, or far
// apart; a triangle may have a vertex twice. Each row is broken off somewhere, and some positions
// are too large for float.
std::vector<Index> rows_of_pairs(std::mt19937& random, Index vertex_count) {
  std::vector<Index> corners;
  Index pattern[6] = {};
  for (int row = 0; row < 12; ++row) {
    const Index spread = random() % 2 == 0 ? 5 : 90;
    const auto pairs = static_cast<Index>(random() % 70);
    for (Index& c : std::span(pattern).subspan(row % 4 == 1 ? 3 : 0)) {
      c = static_cast<Index>(random() % static_cast<unsigned>(spread));
    }
    if (row % 3 == 0) std::ranges::copy(std::vector<Index>{1, 2, 82, 1, 82, 81}, pattern);
    if (row % 6 == 3) std::ranges::copy(std::vector<Index>{1, 82, 0, 0, 82, 81}, pattern);
    const Index start = static_cast<Index>(random() % 40);
    for (Index i = 0; i < pairs && start + i + 90 <= vertex_count; ++i) {
      for (const Index c : pattern) corners.push_back(start + c + i);
    }
    for (unsigned i = random() % 4; i > 0; --i) {
      for (int k = 0; k < 3; ++k) {
        corners.push_back(static_cast<Index>(random() % static_cast<unsigned>(vertex_count)));
      }
    }
  }
  return corners;
}

TEST(TermRows, AddUpTheSameForPairsThatStepByOne) {
  constexpr Index kVertices = 200;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const std::vector<Index> corners = rows_of_pairs(random, kVertices);
    std::vector<float> xyz(3 * kVertices);
    for (float& x : xyz) x = static_cast<float>(random() % 1000) * 0.37F;
    if (seed % 3 == 0) xyz[random() % xyz.size()] = 1e25F;
    const auto count = static_cast<Index>(corners.size() / 3);
    expect_same_sums({{xyz.data(), kVertices}}, {corners.data(), count, 3 * count},
                     {{0, kVertices}, {30, 130}, {100, kVertices}});
  }
}

TEST(PairWindows, OfCutCellsAreTheRowsOnTheirSides) {
  kernels::PairWindows windows;
  const Index cell[] = {7, 8, 18, 7, 18, 17};  // rows of ten vertices
  ASSERT_TRUE(windows.find(cell));
  ASSERT_EQ(windows.end() - windows.begin(), 2);
  const kernels::PairWindow& upper = windows.begin()[0];
  EXPECT_EQ(upper.first, 10);
  EXPECT_EQ(std::vector<int>(upper.high, upper.high + 2), (std::vector<int>{2, 1}));
  EXPECT_EQ(std::vector<int>(upper.low, upper.low + 2), (std::vector<int>{-1, 2}));
  const kernels::PairWindow& lower = windows.begin()[1];
  EXPECT_EQ(lower.first, 0);
  EXPECT_EQ(std::vector<int>(lower.high, lower.high + 2), (std::vector<int>{1, -1}));
  EXPECT_EQ(std::vector<int>(lower.low, lower.low + 2), (std::vector<int>{0, 0}));
  const Index twice[] = {7, 8, 7, 7, 18, 17};
  EXPECT_FALSE(windows.find(twice));
}

class Window : public testing::Test {
 protected:
  // Asks for [low, high] and, if it is granted, looks at every row of it.
  bool reach(kernels::TermWindow& window, Index low, Index high) {
    if (!window.reach(low, high, 8, input_)) return false;
    const int rows = kernels::rows_of(input_.weight);
    for (Index f = low; f <= high; ++f) {
      TermRow expected[3];
      kernels::fill_term_rows_scalar({soup_.corners.data() + 3 * f, 1}, input_.points,
                                     input_.weight, expected);
      const TermRow* found = window.rows() + (f & (window.capacity() - 1)) * rows;
      const auto size = static_cast<std::size_t>(rows);
      EXPECT_TRUE(same_terms({expected, size}, {found, size})) << "face " << f;
    }
    return true;
  }

  kernels::TermWindow window_over(Index capacity) {
    memory_ = Buffer<std::byte>(kernels::TermWindow::bytes(capacity, input_.weight));
    return {memory_.data(), capacity, input_.weight};
  }

  static constexpr Index kFaces = 5000;

  Soup soup_ = random_triangles(9, kFaces);
  Buffer<Index> opposite_ = Buffer<Index>(3 * kFaces, kInvalidIndex);
  kernels::GatherInput input_{{soup_.positions()}, NormalWeight::area, soup_.corners.data(),
                              opposite_.data(),    3 * kFaces,         true};
  Buffer<std::byte> memory_;
};

TEST_F(Window, HoldsWhatItReaches) {
  for (const NormalWeight weight : test::kWeights) {
    input_.weight = weight;
    for (const Index capacity : {64, 256, 4096}) {
      kernels::TermWindow window = window_over(capacity);
      std::mt19937 random(static_cast<unsigned>(capacity));
      int granted = 0;
      for (int i = 0; i < 400; ++i) {
        const Index middle = i * (kFaces / 400) + static_cast<Index>(random() % 100);
        const Index low = std::max<Index>(0, middle - static_cast<Index>(random() % 40));
        const Index high = std::min<Index>(kFaces - 1, middle + static_cast<Index>(random() % 20));
        granted += static_cast<int>(reach(window, low, std::max(low, high)));
      }
      EXPECT_GT(granted, 50) << "capacity " << capacity;
    }
  }
}

TEST_F(Window, SlidesOverAllFacesOfALocalOrder) {
  kernels::TermWindow window = window_over(1024);
  // Eight vertices at a time meet sixteen faces more, and those of a row before.
  for (Index f = 0; f + 16 <= kFaces; f += 16) {
    EXPECT_TRUE(reach(window, std::max<Index>(0, f - 500), f + 15)) << f;
  }
}

TEST_F(Window, RefusesFacesThatLieTooFarApart) {
  kernels::TermWindow window = window_over(256);
  EXPECT_FALSE(reach(window, 0, 1000));
  EXPECT_TRUE(reach(window, 100, 200));
}

// Jumps all over the mesh: what has been earned is spent soon, then one jump in a few is paid for.
TEST_F(Window, PaysForJumpsInABadOrder) {
  kernels::TermWindow window = window_over(256);
  std::mt19937 random(3);
  int granted = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto f = static_cast<Index>(random() % (kFaces - 150));
    granted += static_cast<int>(reach(window, f, f + 140));
  }
  EXPECT_GT(granted, 50);
  EXPECT_LT(granted, 300);  // each takes 192 faces or more, and earns 32
}

TEST_F(Window, EndsInARowOfZeros) {
  const kernels::TermWindow window = window_over(64);
  const TermRow& zero = window.rows()[window.zero_row()];
  EXPECT_EQ(zero.term.x, 0);
  EXPECT_EQ(zero.term.y, 0);
  EXPECT_EQ(zero.term.z, 0);
  EXPECT_EQ(zero.count, 0);
}

}  // namespace
}  // namespace hedgerow
