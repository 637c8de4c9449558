#pragma once

#include <cstddef>
#include <vector>

#include "hedgerow/index.h"

/// Indices as the standard library has them: to count with, to compare and to print.
namespace hedgerow::test {

using Numbers = std::vector<Index>;

/// An index that is known to be valid, as the standard library counts.
[[nodiscard]] constexpr std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

/// A copy of a span or a buffer.
template <class Values>
[[nodiscard]] auto to_vector(const Values& values) {
  return std::vector(values.begin(), values.end());
}

/// The numbers of a range of ids.
template <class Range>
[[nodiscard]] Numbers numbers(const Range& range) {
  Numbers out;
  for (const auto id : range) out.push_back(id.value);
  return out;
}

}  // namespace hedgerow::test
