#include "kernels/radix.h"

namespace hedgerow::kernels {

void count_digits(IndexRange range, const KeyedItem* items, unsigned shift,
                  Index* counts) noexcept {
  for (Index i = range.begin; i < range.end; ++i) ++counts[digit_of(items[i].key, shift)];
}

void scatter_by_digit(IndexRange range, const KeyedItem* items, unsigned shift, Index* places,
                      KeyedItem* out) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    out[places[digit_of(items[i].key, shift)]++] = items[i];
  }
}

}  // namespace hedgerow::kernels
