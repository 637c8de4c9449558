#pragma once

#include <cstddef>
#include <cstdint>

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

/// Asks for the line of `column[i]`; with an i below 0, that of no element, nothing happens. The
/// address is a number, as no pointer may lead to before a column, or away from a null one.
[[gnu::always_inline]] inline void prefetch_entry(const Index* column, Index i) noexcept {
  const std::uintptr_t address =
      reinterpret_cast<std::uintptr_t>(column) + static_cast<std::uintptr_t>(i) * sizeof(Index);
  __builtin_prefetch(reinterpret_cast<const void*>(address));  // NOLINT(performance-no-int-to-ptr)
}

}  // namespace hedgerow::kernels
