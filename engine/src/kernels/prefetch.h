#pragma once

#include <cstddef>

#include "hedgerow/index.h"

namespace hedgerow::kernels {

/// How far ahead a pass over a column asks for what it will read: two kilobytes hide the latency of
/// memory behind a nanosecond a line, and half a page is seldom left over at the end.
inline constexpr std::size_t kAheadBytes = 2048;

/// Asks for the line that lies `kAheadBytes` behind `p`. Hardware prefetchers stop at the end of a
/// page and hardly start on a virtual machine; past the end of a column nothing happens.
[[gnu::always_inline]] inline void prefetch_ahead(const Index* p) noexcept {
  __builtin_prefetch(p + kAheadBytes / sizeof(Index));
}

}  // namespace hedgerow::kernels
