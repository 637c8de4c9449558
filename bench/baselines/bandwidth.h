#pragma once

#include <cstddef>
#include <cstdint>

#include "hedgerow/buffer.h"

namespace hedgerow::baselines {

/// What a bandwidth measurement does with arrays a, b, c of doubles. A `streaming` kernel writes
/// past the caches with non-temporal stores, so no line is read before it is overwritten.
enum class StreamKernel : std::uint8_t {
  read,             ///< sum of a
  copy,             ///< a = b
  copy_streaming,   ///< the same with non-temporal stores
  triad,            ///< a = b + s c
  triad_streaming,  ///< the same with non-temporal stores
};

/// "read", "copy", "copy-streaming", "triad", "triad-streaming".
[[nodiscard]] const char* name(StreamKernel kernel) noexcept;

/// Bytes that the program asks to move per byte of one array: 1, 2 or 3. What the machine moves
/// beside that (lines read before a plain store) is not counted.
[[nodiscard]] int arrays_touched(StreamKernel kernel) noexcept;

/// Three arrays and the kernels over them.
///
/// Threads    `run` uses `threads` threads of an arena of its own; one `run` at a time.
class StreamArrays {
 public:
  /// Allocates and writes three arrays of `array_bytes`, rounded down to whole 4 KiB.
  explicit StreamArrays(std::size_t array_bytes);

  /// One pass of `kernel`; returns its seconds of wall time.
  double run(StreamKernel kernel, int threads);
  /// True if the last pass left the values that it should have.
  [[nodiscard]] bool is_correct() const noexcept;
  [[nodiscard]] std::size_t array_bytes() const noexcept { return a_.size_bytes(); }

 private:
  Buffer<double> a_;
  Buffer<double> b_;
  Buffer<double> c_;
  StreamKernel last_ = StreamKernel::read;
  double sum_ = 0;
};

/// Best rates of some passes, in 10^9 bytes per second; `copy` and `triad` are the faster of the
/// plain and the streaming form.
struct Bandwidth {
  double read_gb_s = 0;
  double copy_gb_s = 0;
  double triad_gb_s = 0;
  std::size_t array_bytes = 0;
  int threads = 1;
};

/// Three arrays that together are four times the last-level cache, but not more than `limit_bytes`
/// (a virtual machine may report the cache of its whole host): the bytes of one array.
[[nodiscard]] std::size_t stream_array_bytes(std::size_t limit_bytes);

/// Measures all kernels, `passes` times each, and takes the best. \pre threads >= 1, passes >= 1
[[nodiscard]] Bandwidth measure_bandwidth(std::size_t array_bytes, int threads, int passes);

}  // namespace hedgerow::baselines
