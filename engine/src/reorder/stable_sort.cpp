#include "reorder/stable_sort.h"

#include <algorithm>
#include <utility>

#include "parallel/parallel.h"

namespace hedgerow::detail {

namespace {

// Items a task: as many counters as that cost little beside them.
constexpr Index kSortGrain = 1 << 16;

template <class Key>
class RadixSort {
 public:
  RadixSort(Buffer<kernels::Keyed<Key>>&& items, const Execution& execution)
      : execution_(execution),
        items_(std::move(items)),
        sorted_(items_.size()),
        count_(static_cast<Index>(items_.size())),
        block_count_(count_ == 0 ? 0 : (count_ - 1) / kSortGrain + 1),
        places_(static_cast<std::size_t>(block_count_ * kernels::kDigitCount)) {}

  void run() {
    constexpr unsigned kKeyBits = 8 * sizeof(Key);
    const Key differing = differing_bits();
    for (unsigned shift = 0; shift < kKeyBits && differing >> shift != 0;
         shift += kernels::kDigitBits) {
      // A digit that all keys share would move nothing.
      if (kernels::digit_of(differing, shift) != 0) sort_by_digit(shift);
    }
  }

  [[nodiscard]] Buffer<Index> take_items() const {
    Buffer<Index> out(items_.size());
    par::for_each_range(execution_, count_, kSortGrain, [&](IndexRange range) {
      for (Index i = range.begin; i < range.end; ++i) {
        out.data()[i] = items_.data()[i].item;
      }
    });
    return out;
  }

 private:
  [[nodiscard]] Key differing_bits() const {
    return par::reduce<Key>(
        execution_, count_, kSortGrain,
        [&](IndexRange range) {
          Key bits = 0;
          for (Index i = range.begin; i < range.end; ++i) {
            bits |= items_.data()[i].key ^ items_.data()[0].key;
          }
          return bits;
        },
        [](Key a, Key b) { return a | b; });
  }

  // Calls kernel(range, counters of its own) for each block.
  template <class Kernel>
  void for_each_block(const Kernel& kernel) {
    par::for_each_task(execution_, block_count_, [&](Index b, Index) {
      const Index begin = b * kSortGrain;
      kernel(IndexRange{begin, begin + std::min(kSortGrain, count_ - begin)},
             places_.data() + b * kernels::kDigitCount);
    });
  }

  void sort_by_digit(unsigned shift) {
    for_each_block([&](IndexRange range, Index* counts) {
      std::fill_n(counts, kernels::kDigitCount, Index{0});
      kernels::count_digits(range, items_.data(), shift, counts);
    });
    turn_counts_into_places();
    for_each_block([&](IndexRange range, Index* places) {
      kernels::scatter_by_digit(range, items_.data(), shift, places, sorted_.data());
    });
    std::swap(items_, sorted_);
  }

  // Digit by digit, and within a digit block by block: the order in which the items came.
  void turn_counts_into_places() noexcept {
    Index place = 0;
    for (Index digit = 0; digit < kernels::kDigitCount; ++digit) {
      for (Index b = 0; b < block_count_; ++b) {
        Index& counter = places_.data()[b * kernels::kDigitCount + digit];
        place += std::exchange(counter, place);
      }
    }
  }

  const Execution& execution_;
  Buffer<kernels::Keyed<Key>> items_;
  Buffer<kernels::Keyed<Key>> sorted_;
  Index count_;
  Index block_count_;
  Buffer<Index> places_;
};

}  // namespace

template <class Key>
Buffer<Index> sorted_items(Buffer<kernels::Keyed<Key>>&& items, const Execution& execution) {
  RadixSort<Key> sort(std::move(items), execution);
  sort.run();
  return sort.take_items();
}

template Buffer<Index> sorted_items(Buffer<kernels::Keyed<std::uint32_t>>&&, const Execution&);
template Buffer<Index> sorted_items(Buffer<kernels::Keyed<std::uint64_t>>&&, const Execution&);

}  // namespace hedgerow::detail
