#pragma once

#include <cstddef>

#include "kernels/normals_avx2.h"

#if defined(__AVX512F__)

/// Moving float3 values in and out of sixteen lanes; for sources compiled for AVX-512, and local to
/// each.
namespace hedgerow::kernels {
namespace {

/// Loads the positions of the corners of sixteen triangles into lanes, as `TriangleLoader` does of
/// eight. \pre `suits_avx2(points)`
template <std::size_t kFloats>
class TriangleLoader16 {
 public:
  using Float = Float16;
  static constexpr Index kLanes = 16;

  explicit TriangleLoader16(const Points& points) noexcept : eight_(points) {}

  [[gnu::always_inline]] void prefetch(const Index* corners, std::ptrdiff_t left) const noexcept {
    eight_.prefetch(corners, left);
    eight_.prefetch(corners + 24, left);
  }

  /// Lane i has triangle 4 (i mod 4) + i / 4, so that the four parts of a row are triangles in a
  /// row.
  [[gnu::always_inline]] void load_turned(const Index* corners,
                                          Vec3<Float16> (&p)[3]) const noexcept {
    if (eight_.has_last(corners) || eight_.has_last(corners + 24)) [[unlikely]] {
      p[0] = one_by_one(corners);
      p[1] = one_by_one(corners + 1);
      p[2] = one_by_one(corners + 2);
    } else {
      p[0] = as_rows(corners);
      p[1] = as_rows(corners + 1);
      p[2] = as_rows(corners + 2);
    }
  }
  /// Such lanes and `w` as rows, in the order of the triangles.
  [[gnu::always_inline]] static void store_turned(const Vec3<Float16>& v, float w,
                                                  __m128* rows) noexcept {
    const __m512 last = _mm512_set1_ps(w);
    const __m512 xy_low = _mm512_unpacklo_ps(v.x.bits, v.y.bits);
    const __m512 xy_high = _mm512_unpackhi_ps(v.x.bits, v.y.bits);
    const __m512 zw_low = _mm512_unpacklo_ps(v.z.bits, last);
    const __m512 zw_high = _mm512_unpackhi_ps(v.z.bits, last);
    auto* to = reinterpret_cast<float*>(rows);
    _mm512_store_ps(to, _mm512_shuffle_ps(xy_low, zw_low, 0x44));
    _mm512_store_ps(to + 16, _mm512_shuffle_ps(xy_low, zw_low, 0xee));
    _mm512_store_ps(to + 32, _mm512_shuffle_ps(xy_high, zw_high, 0x44));
    _mm512_store_ps(to + 48, _mm512_shuffle_ps(xy_high, zw_high, 0xee));
  }

 private:
  // Every third of twelve corners.
  [[nodiscard, gnu::always_inline]] __m512 load_four(const Index* corners) const noexcept {
    const __m512 low = _mm512_castps256_ps512(eight_.load_two(corners[0], corners[3]));
    return _mm512_castpd_ps(_mm512_insertf64x4(
        _mm512_castps_pd(low), _mm256_castps_pd(eight_.load_two(corners[6], corners[9])), 1));
  }
  [[nodiscard, gnu::always_inline]] Vec3<Float16> as_rows(const Index* corners) const noexcept {
    const __m512 row0 = load_four(corners);
    const __m512 row1 = load_four(corners + 12);
    const __m512 row2 = load_four(corners + 24);
    const __m512 row3 = load_four(corners + 36);
    const __m512 xy_low = _mm512_unpacklo_ps(row0, row1);
    const __m512 z_low = _mm512_unpackhi_ps(row0, row1);
    const __m512 xy_high = _mm512_unpacklo_ps(row2, row3);
    const __m512 z_high = _mm512_unpackhi_ps(row2, row3);
    return {_mm512_shuffle_ps(xy_low, xy_high, 0x44), _mm512_shuffle_ps(xy_low, xy_high, 0xee),
            _mm512_shuffle_ps(z_low, z_high, 0x44)};
  }
  [[nodiscard, gnu::noinline]] Vec3<Float16> one_by_one(const Index* corners) const noexcept {
    alignas(64) float xyz[3][16];
    for (int i = 0; i < 16; ++i) {
      const float* p = eight_.at(corners[3 * (4 * (i % 4) + i / 4)]);
      for (int c = 0; c < 3; ++c) xyz[c][i] = p[c];
    }
    return {_mm512_load_ps(xyz[0]), _mm512_load_ps(xyz[1]), _mm512_load_ps(xyz[2])};
  }

  TriangleLoader<kFloats> eight_;
};

/// Calls `function(loader)` with the one for the stride of the positions.
template <class Function>
inline void with_loader16(const Points& points, const Function& function) noexcept {
  points.positions.stride_bytes == sizeof(float[3]) ? function(TriangleLoader16<3>(points))
                                                    : function(TriangleLoader16<0>(points));
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
