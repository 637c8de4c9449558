#pragma once

#include <cstddef>

#include "hedgerow/index.h"

namespace hedgerow::baselines {

/// An index that is known to be valid, as the standard library counts.
[[nodiscard]] constexpr std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace hedgerow::baselines
