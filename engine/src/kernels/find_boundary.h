#pragma once

#include "hedgerow/index.h"

namespace hedgerow::kernels {

/// The first half-edge of `range` without opposite, or its end.
///
/// Looks at blocks first, whose bitwise or is negative if one of its elements is: that loop has no
/// branch and becomes vectors, so that long stretches without boundary are read at the speed of
/// memory.
[[nodiscard]] inline Index find_boundary(IndexRange range, const Index* opposite) noexcept {
  constexpr Index kBlock = 64;
  constexpr Index kAhead = 2048;  // two pages: hardware prefetchers stop at the end of each
  constexpr Index kLine = 64 / static_cast<Index>(sizeof(Index));
  Index i = range.begin;
  for (; range.end - i >= kBlock; i += kBlock) {
    const Index ahead = range.end - i >= kAhead + kBlock ? i + kAhead : i;
    for (Index k = 0; k < kBlock; k += kLine) __builtin_prefetch(opposite + ahead + k);
    Index all = 0;
    for (Index k = 0; k < kBlock; ++k) all |= opposite[i + k];
    if (all < 0) break;
  }
  while (i < range.end && opposite[i] >= 0) ++i;
  return i;
}

}  // namespace hedgerow::kernels
