#include "outliers.h"

#include <cmath>
#include <cstddef>

#include "parallel/parallel.h"

namespace hedgerow::ray {
namespace {

constexpr float kLimit = 1.844e18F;  // Embree's FLT_LARGE is 1.844E18f, too
constexpr Index kGrain = 1 << 14;

// No branches: compilers make lanes of them. A comparison with a NaN is false.
int outside(float coordinate) noexcept { return std::abs(coordinate) < kLimit ? 0 : 1; }

int outside_at(const Positions& positions, Index v) noexcept {
  const float* xyz = positions[v];
  return outside(xyz[0]) + outside(xyz[1]) + outside(xyz[2]);
}

template <class Kernel>
bool is_any(const Execution& execution, Index count, const Kernel& kernel) {
  const auto join = [](int a, int b) { return a | b; };
  return par::reduce<int>(execution, count, kGrain, kernel, join) != 0;
}

}  // namespace

bool has_outlier(const Positions& positions, Index count, const Execution& execution) {
  return is_any(execution, count, [&](IndexRange range) {
    int found = 0;
    if (positions.stride_bytes == 3 * sizeof(float)) {
      const float* end = positions[range.begin] + 3 * static_cast<std::ptrdiff_t>(range.size());
      for (const float* at = positions[range.begin]; at != end; ++at) found |= outside(*at);
    } else {
      for (Index v = range.begin; v < range.end; ++v) found |= outside_at(positions, v);
    }
    return found;
  });
}

bool has_outlier(const Positions& positions, std::span<const Index> ids,
                 const Execution& execution) {
  return is_any(execution, static_cast<Index>(ids.size()), [&](IndexRange range) {
    int found = 0;
    for (Index i = range.begin; i < range.end; ++i) {
      found |= outside_at(positions, ids[static_cast<std::size_t>(i)]);
    }
    return found;
  });
}

bool has_outlier(const Positions& positions, std::span<const std::uint32_t> corners) noexcept {
  int found = 0;
  for (const std::uint32_t v : corners) found |= outside_at(positions, static_cast<Index>(v));
  return found != 0;
}

}  // namespace hedgerow::ray
