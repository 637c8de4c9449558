#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "hedgerow/index.h"

namespace hedgerow::kernels {

/// A set of numbers that gives back the smallest first: bits, with a bit above for each word that
/// is not zero, and so on up. Inserting and taking out cost O(log64 size) each. The alternative,
/// sorting, needs memory for all that are inserted, however often.
class IndexSet {
 public:
  /// Bytes for numbers below `size`; a multiple of 64.
  [[nodiscard]] static std::size_t bytes(Index size) noexcept {
    std::size_t words = 0;
    std::size_t level = static_cast<std::size_t>(size);
    do {
      level = (level + 63) / 64;
      words += level;
    } while (level > 1);
    return (words * sizeof(std::uint64_t) + 63) / 64 * 64;
  }
  /// `memory` is of bytes(size), and holds zeros while the set is empty. Whether it does to begin
  /// with, `is_zero` says; it is made so when the first number comes. Null: it does.
  IndexSet(void* memory, Index size, bool* is_zero = nullptr) noexcept
      : memory_(memory), bytes_(bytes(size)), is_zero_(is_zero) {
    auto* words = bits_ = static_cast<std::uint64_t*>(memory);
    std::size_t level = static_cast<std::size_t>(size);
    do {
      level = (level + 63) / 64;
      levels_[count_++] = words;
      words += level;
    } while (level > 1);
  }

  void insert(Index number) noexcept {
    if (is_zero_ != nullptr && !*is_zero_) [[unlikely]] {
      std::memset(memory_, 0, bytes_);
      *is_zero_ = true;
    }
    const auto i = static_cast<std::size_t>(number);
    std::uint64_t& word = bits_[i >> 6];
    const std::uint64_t before = word;
    word = before | std::uint64_t{1} << (i & 63);
    if (before == 0) [[unlikely]]
      insert_above(i >> 6);
  }
  /// \pre a number was inserted, or the memory holds zeros
  [[nodiscard]] bool empty() const noexcept { return levels_[count_ - 1][0] == 0; }
  /// \pre not empty
  [[nodiscard]] Index take_smallest() noexcept {
    std::size_t i = 0;
    for (int level = count_ - 1; level >= 0; --level) {
      i = i << 6 | static_cast<std::size_t>(std::countr_zero(levels_[level][i]));
    }
    const auto smallest = static_cast<Index>(i);
    for (int level = 0; level < count_; ++level, i >>= 6) {
      std::uint64_t& word = levels_[level][i >> 6];
      word &= ~(std::uint64_t{1} << (i & 63));
      if (word != 0) break;
    }
    return smallest;
  }
  /// Calls visit(number) for all of them in ascending order, word by word, and leaves none.
  template <class Visit>
  void drain(const Visit& visit) noexcept {
    while (!empty()) {
      std::size_t i = 0;
      for (int level = count_ - 1; level > 0; --level) {
        i = i << 6 | static_cast<std::size_t>(std::countr_zero(levels_[level][i]));
      }
      for (std::uint64_t word = levels_[0][i]; word != 0; word &= word - 1) {
        visit(static_cast<Index>(i << 6 | static_cast<std::size_t>(std::countr_zero(word))));
      }
      levels_[0][i] = 0;
      for (int level = 1; level < count_; ++level) {
        std::uint64_t& above = levels_[level][i >> 6];
        above &= ~(std::uint64_t{1} << (i & 63));
        if (above != 0) break;
        i >>= 6;
      }
    }
  }
  /// Writes all of them to `to` in ascending order, leaves none, and says how many there were.
  [[nodiscard]] std::size_t drain_into(Index* to) noexcept {
    Index* end = to;
    drain([&end](Index number) { *end++ = number; });
    return static_cast<std::size_t>(end - to);
  }

 private:
  // Word i of the lowest level is no longer zero. Rare, and inlined it costs the others their
  // registers.
  [[gnu::noinline]] void insert_above(std::size_t i) noexcept {
    for (int level = 1; level < count_; ++level, i >>= 6) {
      std::uint64_t& word = levels_[level][i >> 6];
      const bool was_known_above = word != 0;
      word |= std::uint64_t{1} << (i & 63);
      if (was_known_above) return;
    }
  }

  static constexpr int kMaxLevels = 11;  // 64-bit indices
  void* memory_;
  std::size_t bytes_;
  bool* is_zero_;
  std::uint64_t* bits_ = nullptr;  // levels_[0], once more where inserting finds it at once
  std::uint64_t* levels_[kMaxLevels] = {};
  int count_ = 0;
};

}  // namespace hedgerow::kernels
