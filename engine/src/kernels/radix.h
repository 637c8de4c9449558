#pragma once

#include <cstdint>
#include <type_traits>

#include "hedgerow/index.h"

/// One pass of a stable radix sort, in two phases between which the driver turns counts into
/// places. Ranges that partition the items have counters of their own and, once those are places,
/// write disjoint elements: the places of a range's items of a digit are consecutive and begin
/// where those of the range before it end.
namespace hedgerow::kernels {

inline constexpr unsigned kDigitBits = 11;
inline constexpr Index kDigitCount = Index{1} << kDigitBits;

template <class Key>
struct Keyed {
  Key key;
  Index item;
};

using KeyedItem = Keyed<std::uint64_t>;
using IndexedItem = Keyed<std::make_unsigned_t<Index>>;  // half the size: the key is an index

template <class Key>
[[nodiscard]] Index digit_of(Key key, unsigned shift) noexcept {
  return static_cast<Index>(key >> shift & static_cast<Key>(kDigitCount - 1));
}

/// Adds the items of `range` to counts[0 .. kDigitCount - 1] by their digit at `shift`.
template <class Key>
void count_digits(IndexRange range, const Keyed<Key>* items, unsigned shift,
                  Index* counts) noexcept {
  for (Index i = range.begin; i < range.end; ++i) ++counts[digit_of(items[i].key, shift)];
}

/// Copies the items of `range` in order to out[places[digit]], each of which then moves on by one.
template <class Key>
void scatter_by_digit(IndexRange range, const Keyed<Key>* items, unsigned shift, Index* places,
                      Keyed<Key>* out) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    out[places[digit_of(items[i].key, shift)]++] = items[i];
  }
}

}  // namespace hedgerow::kernels
