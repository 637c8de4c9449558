#pragma once

#include <cstdint>

#include "hedgerow/index.h"

/// One pass of a stable radix sort, in two phases between which the driver turns counts into
/// places. Ranges that partition the items have counters of their own and, once those are places,
/// write disjoint elements: the places of a range's items of a digit are consecutive and begin
/// where those of the range before it end.
namespace hedgerow::kernels {

inline constexpr unsigned kDigitBits = 11;
inline constexpr Index kDigitCount = Index{1} << kDigitBits;

struct KeyedItem {
  std::uint64_t key;
  Index item;
};

[[nodiscard]] inline Index digit_of(std::uint64_t key, unsigned shift) noexcept {
  return static_cast<Index>(key >> shift & static_cast<std::uint64_t>(kDigitCount - 1));
}

/// Adds the items of `range` to counts[0 .. kDigitCount - 1] by their digit at `shift`.
void count_digits(IndexRange range, const KeyedItem* items, unsigned shift, Index* counts) noexcept;

/// Copies the items of `range` in order to out[places[digit]], each of which then moves on by one.
void scatter_by_digit(IndexRange range, const KeyedItem* items, unsigned shift, Index* places,
                      KeyedItem* out) noexcept;

}  // namespace hedgerow::kernels
