#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include "hedgerow/assert.h"

namespace hedgerow {

namespace detail {
/// 64-byte aligned, uninitialised memory with `kReadableTailBytes` behind it; large blocks ask for
/// huge pages where the system has them, unless the environment variable HEDGEROW_HUGE_PAGES is
/// "off" at the first call. Throws std::bad_alloc. Null for 0 bytes.
[[nodiscard]] void* allocate_bytes(std::size_t bytes);
void free_bytes(void* memory) noexcept;
/// Asks for huge pages in memory of another origin that has not been written yet.
void prefer_huge_pages(void* memory, std::size_t bytes) noexcept;
}  // namespace detail

/// Bytes behind the last element of every `Buffer` that may be read (not written): a 16-byte load
/// of the last float3 stays inside the allocation, which is what Embree asks of a shared vertex
/// buffer.
inline constexpr std::size_t kReadableTailBytes = 64;

/// Owning array of trivial values, 64-byte aligned, *not* initialised on construction.
///
/// Zeroing 100 MB that the next pass overwrites costs as much as the pass, so `std::vector` is not
/// used for columns. Move-only; throws std::bad_alloc on construction.
///
/// Threads    Const members may be called concurrently; two buffers share nothing.
/// Lifetime   Pointers and spans are valid until the buffer is assigned to or destroyed; moving it
///            hands them over with the memory.
template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() noexcept = default;
  explicit Buffer(std::size_t size)
      : data_(static_cast<T*>(detail::allocate_bytes(size * sizeof(T)))), size_(size) {}
  Buffer(std::size_t size, const T& value) : Buffer(size) { std::fill_n(data_, size, value); }
  Buffer(Buffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer() { detail::free_bytes(data_); }

  /// A new buffer with the same contents.
  [[nodiscard]] static Buffer copy_of(std::span<const T> values) {
    Buffer copy(values.size());
    std::copy(values.begin(), values.end(), copy.data_);
    return copy;
  }

  T& operator[](std::size_t i) noexcept {
    HEDGEROW_ASSERT(i < size_);
    return data_[i];
  }
  const T& operator[](std::size_t i) const noexcept {
    HEDGEROW_ASSERT(i < size_);
    return data_[i];
  }
  [[nodiscard]] T* data() noexcept { return data_; }
  [[nodiscard]] const T* data() const noexcept { return data_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::size_t size_bytes() const noexcept { return size_ * sizeof(T); }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] T* begin() noexcept { return data_; }
  [[nodiscard]] T* end() noexcept { return data_ + size_; }
  [[nodiscard]] const T* begin() const noexcept { return data_; }
  [[nodiscard]] const T* end() const noexcept { return data_ + size_; }
  [[nodiscard]] std::span<const T> span() const noexcept { return {data_, size_}; }
  [[nodiscard]] std::span<T> span() noexcept { return {data_, size_}; }

  /// Forgets everything behind the first `size` elements; the memory stays.
  void truncate(std::size_t size) noexcept {
    HEDGEROW_ASSERT(size <= size_);
    size_ = size;
  }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace hedgerow
