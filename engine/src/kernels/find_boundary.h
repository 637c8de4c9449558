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
  Index i = range.begin;
  for (; range.end - i >= kBlock; i += kBlock) {
    Index all = 0;
    for (Index k = 0; k < kBlock; ++k) all |= opposite[i + k];
    if (all < 0) break;
  }
  while (i < range.end && opposite[i] >= 0) ++i;
  return i;
}

}  // namespace hedgerow::kernels
