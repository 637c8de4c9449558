#include "imr/center.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "parallel_ranges.h"

namespace hedgerow::bench {

namespace {

/// Four points: as many sums at a time wait for none of each other.
constexpr std::size_t kStep = 12;
constexpr std::size_t kBlock = 1024 * kStep;

/// Floats ahead that are asked for: the processor by itself asks for too few.
constexpr std::size_t kAhead = 512;

using Sums = std::array<double, 3>;

Sums sum_of(const float* begin, const float* end) {
  std::array<double, kStep> sums{};
  const float* p = begin;
  for (; end - p >= static_cast<std::ptrdiff_t>(kStep); p += kStep) {
    __builtin_prefetch(p + kAhead);
    for (std::size_t i = 0; i < kStep; ++i) sums[i] += double{p[i]};
  }
  for (std::size_t i = 0; p != end; ++p, ++i) sums[i] += double{*p};
  Sums total{};
  for (std::size_t i = 0; i < kStep; ++i) total[i % 3] += sums[i];
  return total;
}

void subtract(const Sums& mean, float* begin, float* end) {
  std::array<float, kStep> offsets{};
  for (std::size_t i = 0; i < kStep; ++i) offsets[i] = static_cast<float>(mean[i % 3]);
  float* p = begin;
  for (; end - p >= static_cast<std::ptrdiff_t>(kStep); p += kStep) {
    __builtin_prefetch(p + kAhead);
    for (std::size_t i = 0; i < kStep; ++i) p[i] -= offsets[i];
  }
  for (std::size_t i = 0; p != end; ++p, ++i) *p -= offsets[i];
}

}  // namespace

void center(Buffer<float>& xyz, const Execution& execution) {
  const std::size_t blocks = (xyz.size() + kBlock - 1) / kBlock;
  const auto begin_of = [&](std::size_t block) {
    return xyz.data() + std::min(xyz.size(), block * kBlock);
  };
  std::vector<Sums> sums(blocks);
  for_ranges(execution, blocks, 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) sums[b] = sum_of(begin_of(b), begin_of(b + 1));
  });
  Sums mean{};
  for (const Sums& sum : sums) {
    for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += sum[axis];
  }
  for (double& x : mean) x /= static_cast<double>(xyz.size() / 3);
  for_ranges(execution, blocks, 4, [&](std::size_t first, std::size_t last) {
    subtract(mean, begin_of(first), begin_of(last));
  });
}

}  // namespace hedgerow::bench
