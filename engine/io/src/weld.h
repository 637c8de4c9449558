#pragma once

#include <cstddef>
#include <cstdint>

#include "grow_buffer.h"
#include "hedgerow/index.h"

namespace hedgerow::io {

/// Gives equal points one number, in the order in which points first occur. -0 equals 0, and is
/// stored as it first occurs; a NaN equals a NaN of the same bits.
///
/// Layout     An open hash table with linear probing, at most half full: a slot has 32 bits
///            of hash beside the number, so that a different point is nearly always told apart
///            without a look at its coordinates.
class Welder {
 public:
  /// `point_count`: how many will be added, for the size of the table. It may be wrong.
  explicit Welder(std::size_t point_count);

  /// The number of this point. \pre fewer than kMaxCount different points.
  [[nodiscard]] Index add(const float* xyz);

  [[nodiscard]] std::size_t size() const noexcept { return xyz_.size() / 3; }
  [[nodiscard]] Buffer<float> take_xyz() { return xyz_.take(); }

 private:
  struct Slot {
    std::uint32_t hash;
    Index vertex;  ///< kInvalidIndex: the slot is free
  };
  void grow();

  GrowBuffer<float> xyz_;
  Buffer<Slot> slots_;
  std::size_t mask_;
};

}  // namespace hedgerow::io
