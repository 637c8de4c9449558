#pragma once

#include <cstddef>

#include "hedgerow/assert.h"
#include "hedgerow/index.h"

namespace hedgerow {

/// Read-only view of one column of a structure of arrays: plain `Index` storage, typed on access.
///
/// Layout    `size()` values of type `Index`, contiguous. `Key` and `Value` are id types, so
///           indexing with the wrong kind of id, or storing the result as the wrong kind, does not
///           compile.
/// Pre       Indexing: the id is valid and below `size()`; asserted in debug builds.
/// Threads   Any number of concurrent readers.
/// Lifetime  Owns nothing; valid as long as the storage it was made from.
template <class Key, class Value>
class Column {
 public:
  constexpr Column() noexcept = default;
  constexpr Column(const Index* data, Index size) noexcept : data_(data), size_(size) {}

  constexpr Value operator[](Key key) const noexcept {
    HEDGEROW_ASSERT(key.value >= 0 && key.value < size_);
    return Value(data_[key.value]);
  }
  [[nodiscard]] constexpr Index size() const noexcept { return size_; }
  [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
  /// The raw array, for C, Embree, GPU upload and NumPy.
  [[nodiscard]] constexpr const Index* data() const noexcept { return data_; }

 private:
  const Index* data_ = nullptr;
  Index size_ = 0;
};

}  // namespace hedgerow
