#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "decimate/cost_buckets.h"
#include "hedgerow/index.h"

namespace hedgerow::decimation {

/// `CostBuckets` that allocate nothing: what is in a bucket is a list through an array with an
/// entry for each half-edge, which other queues may use for other half-edges at the same time.
class BucketLists {
 public:
  BucketLists() noexcept {
    first_.fill(kInvalidIndex);
    last_.fill(kInvalidIndex);
  }
  /// Begins anew, from the lowest bucket on. \pre it is empty
  void begin() noexcept { current_ = 0; }
  [[nodiscard]] std::size_t current() const noexcept { return current_; }

  /// \pre the half-edge is not in a queue. What costs less than the current bucket comes in it.
  void push(std::size_t bucket, Index halfedge, std::span<Index> following) noexcept {
    if (bucket < current_) bucket = current_;
    following[static_cast<std::size_t>(halfedge)] = kInvalidIndex;
    if (first_[bucket] == kInvalidIndex) {
      first_[bucket] = halfedge;
    } else {
      following[static_cast<std::size_t>(last_[bucket])] = halfedge;
    }
    last_[bucket] = halfedge;
  }
  /// The next one of a bucket up to `highest`; kInvalidIndex: none is left there.
  [[nodiscard]] Index pop(std::size_t highest, std::span<const Index> following) noexcept {
    while (first_[current_] == kInvalidIndex) {
      if (current_ >= highest) return kInvalidIndex;
      ++current_;
    }
    const Index halfedge = first_[current_];
    first_[current_] = following[static_cast<std::size_t>(halfedge)];
    return halfedge;
  }
  void clear(std::size_t highest) noexcept {
    for (std::size_t i = 0; i <= highest; ++i) first_[i] = kInvalidIndex;
  }

 private:
  std::array<Index, CostBuckets::kCount> first_;
  std::array<Index, CostBuckets::kCount> last_;
  std::size_t current_ = 0;
};

}  // namespace hedgerow::decimation
