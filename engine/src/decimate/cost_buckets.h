#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hedgerow/index.h"

namespace hedgerow::decimation {

/// A priority queue of edges that is exact to a sixteenth of their cost: a bucket for each such
/// step of a float, and in each bucket first come, first served. Where a heap touches as many
/// cache lines as it has levels, and hides what comes next, this appends; and what comes next can
/// be fetched meanwhile.
class CostBuckets {
  static constexpr int kMantissaBits = 23;
  static constexpr int kStepBits = 4;  // sixteen steps from one power of two to the next

 public:
  /// Buckets of all finite floats.
  static constexpr std::size_t kCount = std::size_t{255} << kStepBits;

  CostBuckets() : buckets_(kCount) {}

  /// \pre cost is finite and not negative
  [[nodiscard]] static std::size_t bucket_of(float cost) noexcept {
    return std::bit_cast<std::uint32_t>(cost) >> (kMantissaBits - kStepBits);
  }

  /// The bucket that is being emptied.
  [[nodiscard]] std::size_t current() const noexcept { return current_; }
  /// What costs less than the current bucket is served in it.
  void push(float cost, Index halfedge) {
    const std::size_t bucket = bucket_of(cost);
    buckets_[bucket < current_ ? current_ : bucket].push_back(halfedge);
  }
  /// The next edge; kInvalidIndex: none is left.
  [[nodiscard]] Index pop() noexcept {
    while (position_ == buckets_[current_].size()) {
      if (current_ + 1 == kCount) return kInvalidIndex;
      std::vector<Index>().swap(buckets_[current_]);
      ++current_;
      position_ = 0;
    }
    return buckets_[current_][position_++];
  }
  /// What `pop` will give after so many others, if it is known: else kInvalidIndex.
  [[nodiscard]] Index ahead(std::size_t count) const noexcept {
    const std::vector<Index>& bucket = buckets_[current_];
    return position_ + count < bucket.size() ? bucket[position_ + count] : kInvalidIndex;
  }

 private:
  std::vector<std::vector<Index>> buckets_;
  std::size_t current_ = 0;
  std::size_t position_ = 0;
};

}  // namespace hedgerow::decimation
