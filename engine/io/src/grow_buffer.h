#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "hedgerow/buffer.h"

namespace hedgerow::io {

/// A `Buffer` that grows at its end, for elements whose number is known only at the end of the
/// file.
template <class T>
class GrowBuffer {
 public:
  GrowBuffer() noexcept = default;
  explicit GrowBuffer(std::size_t capacity) : buffer_(capacity) {}

  void push(const T& value) {
    if (size_ == buffer_.size()) grow(size_ + 1);
    buffer_.data()[size_++] = value;
  }
  /// Room for `count` more at the end, to be filled by the caller.
  [[nodiscard]] T* append(std::size_t count) {
    if (buffer_.size() - size_ < count) grow(size_ + count);
    size_ += count;
    return buffer_.data() + size_ - count;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] T* data() noexcept { return buffer_.data(); }
  [[nodiscard]] const T* data() const noexcept { return buffer_.data(); }
  void resize_down(std::size_t size) noexcept { size_ = size; }

  /// The elements in a buffer without spare room; this one is empty afterwards.
  [[nodiscard]] Buffer<T> take() {
    Buffer<T> result =
        size_ == buffer_.size() ? std::move(buffer_) : Buffer<T>::copy_of({buffer_.data(), size_});
    buffer_ = Buffer<T>();
    size_ = 0;
    return result;
  }

 private:
  void grow(std::size_t needed) {
    Buffer<T> larger(std::max(needed, std::max<std::size_t>(64, 2 * buffer_.size())));
    std::copy_n(buffer_.data(), size_, larger.data());
    buffer_ = std::move(larger);
  }

  Buffer<T> buffer_;
  std::size_t size_ = 0;
};

}  // namespace hedgerow::io
