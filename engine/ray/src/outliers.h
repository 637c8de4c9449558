#pragma once

#include <cstdint>
#include <span>

#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/positions.h"

/// Vertices that Embree cannot have in a tree: a coordinate that is not a number, or not smaller
/// than 1.844e18 in absolute value. A build leaves their faces out; a refit does not look, and a
/// box round such a vertex hides what else is in it, or ends the program by an assertion.
namespace hedgerow::ray {

/// Whether any of the first `count` vertices is one. O(V), 12 bytes a vertex.
[[nodiscard]] bool has_outlier(const Positions& positions, Index count, const Execution& execution);
/// Whether any of those named is one.
[[nodiscard]] bool has_outlier(const Positions& positions, std::span<const Index> ids,
                               const Execution& execution);
/// Whether any of the vertices of faces is one.
[[nodiscard]] bool has_outlier(const Positions& positions,
                               std::span<const std::uint32_t> corners) noexcept;

}  // namespace hedgerow::ray
