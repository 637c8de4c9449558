#pragma once

#include <algorithm>
#include <cstddef>

#include "kernels/normals_source.h"

#if defined(__SSE2__)

#include <xmmintrin.h>

/// Positions as rows of four floats: one load where x, y and z would take three. Local to each
/// source, as those are compiled for different processors.
namespace hedgerow::kernels {
namespace {

/// `kFloats` is the stride of the positions, or 0 for "what they say", which takes a multiplication
/// a corner.
template <std::size_t kFloats>
class PointRows {
 public:
  explicit PointRows(const Points& points) noexcept
      : data_(points.positions.data),
        floats_(points.positions.stride_bytes / sizeof(float)),
        last_(static_cast<Index>(points.positions.count) - 1) {}

  /// Where the position of a vertex lies.
  [[nodiscard, gnu::always_inline]] const float* at(Index v) const noexcept {
    return data_ + static_cast<std::size_t>(v) * (kFloats == 0 ? floats_ : kFloats);
  }
  /// x, y, z, and what lies behind them. \pre v is not the last vertex: behind that is nothing
  [[nodiscard, gnu::always_inline]] __m128 operator[](Index v) const noexcept {
    return _mm_loadu_ps(at(v));
  }

  [[nodiscard]] Index last() const noexcept { return last_; }

  /// Asks for what groups of triangles further on will take, the last of which is `left` indices
  /// ahead: hardware prefetchers know neither which positions come next nor what lies beyond a
  /// page. A few corners of a group stand for all of it. (Inlined by force, since gcc 12 takes a
  /// function that only prefetches for one that does nothing.)
  template <Index kTriangles>
  [[gnu::always_inline]] void prefetch(const Index* corners, std::ptrdiff_t left) const noexcept {
    const Index* far = corners + std::min<std::ptrdiff_t>(left, 3 * kCornersAhead);
    for (Index i = 0; i < 3 * kTriangles; i += 16) {
      _mm_prefetch(reinterpret_cast<const char*>(far + i), _MM_HINT_T1);
    }
    const Index* near = corners + std::min<std::ptrdiff_t>(left, 3 * kPointsAhead);
    for (Index k = 0; k < 3 * kTriangles; k += kCornerStep) {
      _mm_prefetch(reinterpret_cast<const char*>(at(near[k])), _MM_HINT_T0);
    }
  }

 private:
  static constexpr std::ptrdiff_t kCornersAhead = 1024;  // triangles
  static constexpr std::ptrdiff_t kPointsAhead = 512;    // triangles
  static constexpr Index kCornerStep = 11;  // no multiple of 3: first, third, second corners

  const float* data_;
  std::size_t floats_;
  Index last_;
};

/// Calls `function(rows)` with those for the stride of the positions.
template <class Function>
inline decltype(auto) with_point_rows(const Points& points, const Function& function) noexcept {
  return points.positions.stride_bytes == sizeof(float[3]) ? function(PointRows<3>(points))
                                                           : function(PointRows<0>(points));
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
