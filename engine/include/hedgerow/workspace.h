#pragma once

#include <cstddef>
#include <span>

#include "hedgerow/buffer.h"

namespace hedgerow {

/// Scratch memory for one operation at a time, kept between calls so that a second run of the same
/// size allocates nothing.
///
/// Growing    A default-constructed workspace grows when an operation asks for more than it holds.
/// Fixed      One made over the caller's span never allocates: an operation that needs more returns
///            `ErrorCode::scratch_too_small` with the bytes it needs, and has changed nothing.
///            Any alignment of the span will do; up to 63 bytes of it are lost to aligning.
/// Threads    One operation at a time; parallel operations cut their own pieces from it.
/// Lifetime   A fixed one refers to the caller's memory, which must outlive it.
class Workspace {
 public:
  Workspace() = default;
  explicit Workspace(std::span<std::byte> memory) noexcept;

  /// Makes sure that at least `bytes` are there; what was there is lost where it grows. False: a
  /// fixed workspace is too small. Throws std::bad_alloc.
  [[nodiscard]] bool reserve(std::size_t bytes);
  /// 64-byte aligned; valid until the next `reserve`.
  [[nodiscard]] std::byte* data() noexcept;
  [[nodiscard]] std::size_t size_bytes() const noexcept;

 private:
  Buffer<std::byte> owned_;
  std::span<std::byte> fixed_;
  bool is_fixed_ = false;
};

}  // namespace hedgerow
