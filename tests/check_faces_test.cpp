#include "kernels/check_faces.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace hedgerow::kernels {
namespace {

constexpr Index kRunLength = 37;  // not a multiple of what the fast form takes at once
constexpr int kBlockShift = 4;
constexpr Index kVertexCount = 1000;

// Mostly good triangles in a mostly local order, some bad in each possible way.
std::vector<Index> random_triangles(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto count = random() % 200;
  std::vector<Index> corners;
  for (std::size_t f = 0; f < count; ++f) {
    const Index near = static_cast<Index>(random() % 30 == 0 ? random() % 900 : f);
    for (int k = 0; k < 3; ++k) corners.push_back(near + 3 * k + static_cast<Index>(random() % 3));
    if (seed % 2 == 0 || random() % 60 != 0) continue;
    const std::size_t base = corners.size() - 3;
    const Index wrong[] = {-1, -2'000'000'000, kVertexCount, 2'147'483'647};
    if (random() % 2 == 0) corners[base + random() % 3] = wrong[random() % 4];
    if (random() % 2 == 0) corners[base + random() % 3] = corners[base + random() % 3];
  }
  return corners;
}

FaceCheck check_runs_sse(IndexRange range, const FaceColumns& faces, Index run_length,
                         int block_shift, RunBlocks* runs) noexcept {
  FaceCheck check;
  if (check_triangle_runs_sse(range, faces, run_length, block_shift, runs, check)) return check;
  return check_runs_scalar(range, faces, run_length, block_shift, runs);
}

// The widest of this machine, and the one below it.
class CheckRunsForms : public testing::TestWithParam<decltype(&check_runs)> {};
INSTANTIATE_TEST_SUITE_P(Forms, CheckRunsForms, testing::Values(&check_runs, &check_runs_sse));

TEST_P(CheckRunsForms, GiveTheSameAsTheScalarForm) {
  Index bad = 0;
  for (std::uint32_t seed = 1; seed <= 2000; ++seed) {
    const std::vector<Index> corners = random_triangles(seed);
    const FaceColumns faces = {corners.data(), nullptr, static_cast<Index>(corners.size() / 3),
                               kVertexCount};
    const Index run_count = (faces.face_count + kRunLength - 1) / kRunLength;
    std::vector<RunBlocks> fast(static_cast<std::size_t>(run_count));
    std::vector<RunBlocks> plain(fast.size());
    const IndexRange all = {0, run_count};
    const FaceCheck fast_check = GetParam()(all, faces, kRunLength, kBlockShift, fast.data());
    const FaceCheck plain_check =
        check_runs_scalar(all, faces, kRunLength, kBlockShift, plain.data());
    ASSERT_EQ(fast_check.bad_count, plain_check.bad_count) << "seed " << seed;
    bad += fast_check.bad_count;
    if (fast_check.bad_count > 0) continue;
    for (std::size_t r = 0; r < fast.size(); ++r) {
      ASSERT_EQ(fast[r].count, plain[r].count) << "seed " << seed << ", run " << r;
      for (Index i = 0; i < std::min(fast[r].count, RunBlocks::kCapacity); ++i) {
        ASSERT_EQ(fast[r].block[i], plain[r].block[i]) << "seed " << seed << ", run " << r;
      }
    }
  }
  EXPECT_GT(bad, 100);
}

TEST(CheckRuns, MarksARunThatTouchesMoreBlocksThanItCanHold) {
  std::vector<Index> corners;
  for (Index f = 0; f < 20; ++f) {
    for (Index k = 0; k < 3; ++k) corners.push_back(40 * f + k);
  }
  RunBlocks run;
  const FaceColumns faces = {corners.data(), nullptr, 20, kVertexCount};
  EXPECT_EQ(check_runs({0, 1}, faces, 20, kBlockShift, &run).bad_count, 0);
  EXPECT_EQ(run.count, RunBlocks::kCapacity + 1);
}

}  // namespace
}  // namespace hedgerow::kernels
