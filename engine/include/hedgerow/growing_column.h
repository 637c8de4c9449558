#pragma once

#include <cstddef>
#include <utility>

#include "hedgerow/assert.h"
#include "hedgerow/buffer.h"
#include "hedgerow/index.h"

namespace hedgerow {

/// A column that grows, in the memory of a `Buffer`. Move-only.
///
/// Unlike a `std::vector` it takes over a buffer as it is, and need not fill what will be written.
/// Errors     Growing throws std::bad_alloc, and has then changed nothing.
class GrowingColumn {
 public:
  GrowingColumn() noexcept = default;
  explicit GrowingColumn(Buffer<Index>&& values) noexcept
      : storage_(std::move(values)), size_(storage_.size()) {}
  GrowingColumn(GrowingColumn&& other) noexcept
      : storage_(std::move(other.storage_)), size_(std::exchange(other.size_, 0)) {}
  GrowingColumn& operator=(GrowingColumn&& other) noexcept {
    storage_ = std::move(other.storage_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }
  GrowingColumn(const GrowingColumn&) = delete;
  GrowingColumn& operator=(const GrowingColumn&) = delete;
  ~GrowingColumn() = default;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::size_t capacity() const noexcept { return storage_.size(); }
  [[nodiscard]] Index* data() noexcept { return storage_.data(); }
  [[nodiscard]] const Index* data() const noexcept { return storage_.data(); }
  Index& operator[](std::size_t i) noexcept {
    HEDGEROW_ASSERT(i < size_);
    return storage_.data()[i];
  }
  const Index& operator[](std::size_t i) const noexcept {
    HEDGEROW_ASSERT(i < size_);
    return storage_.data()[i];
  }

  /// Room for so many in all, and no more.
  void reserve(std::size_t capacity) {
    if (capacity > storage_.size()) move_to(capacity);
  }
  /// Room for so many more; much more, so that few of many calls move it.
  void make_room(std::size_t more) {
    if (more > storage_.size() - size_) grow(more);
  }
  /// Longer by so many, which are to be written. \pre there is room
  void extend(std::size_t more) noexcept {
    HEDGEROW_ASSERT(more <= storage_.size() - size_);
    size_ += more;
  }
  void push_back(Index value) {
    make_room(1);
    storage_.data()[size_++] = value;
  }
  /// What is new gets this value.
  void resize(std::size_t size, Index value);

 private:
  void grow(std::size_t more);
  void move_to(std::size_t capacity);

  Buffer<Index> storage_;
  std::size_t size_ = 0;
};

}  // namespace hedgerow
