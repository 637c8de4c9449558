#pragma once

#include <cstddef>

#include "kernels/index_lanes.h"
#include "kernels/normals_avx2.h"

#if defined(__AVX512F__)

/// Moving float3 values in and out of sixteen lanes; for sources compiled for AVX-512, and local to
/// each.
namespace hedgerow::kernels {
namespace {

[[nodiscard]] inline __m512 joined(__m256 low, __m256 high) noexcept {
  return _mm512_castpd_ps(
      _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(low)), _mm256_castps_pd(high), 1));
}
[[nodiscard]] inline Vec3<Float16> joined(const Vec3<Float8>& low,
                                          const Vec3<Float8>& high) noexcept {
  return {joined(low.x.bits, high.x.bits), joined(low.y.bits, high.y.bits),
          joined(low.z.bits, high.z.bits)};
}
[[nodiscard]] inline Vec3<Float8> low_half(const Vec3<Float16>& v) noexcept {
  return {_mm512_castps512_ps256(v.x.bits), _mm512_castps512_ps256(v.y.bits),
          _mm512_castps512_ps256(v.z.bits)};
}
[[nodiscard]] inline Vec3<Float8> high_half(const Vec3<Float16>& v) noexcept {
  const auto high = [](const Float16& a) {
    return _mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(a.bits), 1));
  };
  return {high(v.x), high(v.y), high(v.z)};
}

/// Row j has vectors x, y, z, w of lanes j, j + 4, j + 8 and j + 12.
[[nodiscard]] inline Vec3<Float16> to_lanes(__m512 row0, __m512 row1, __m512 row2,
                                            __m512 row3) noexcept {
  const __m512 xy_low = _mm512_unpacklo_ps(row0, row1);
  const __m512 z_low = _mm512_unpackhi_ps(row0, row1);
  const __m512 xy_high = _mm512_unpacklo_ps(row2, row3);
  const __m512 z_high = _mm512_unpackhi_ps(row2, row3);
  return {_mm512_shuffle_ps(xy_low, xy_high, 0x44), _mm512_shuffle_ps(xy_low, xy_high, 0xee),
          _mm512_shuffle_ps(z_low, z_high, 0x44)};
}

/// Sixteen vectors as rows x, y, z, w: row[j] has those of lanes j, j + 4, j + 8 and j + 12.
struct QuarteredRows {
  __m512 row[4];
};
[[nodiscard, gnu::always_inline]] inline QuarteredRows to_quartered_rows(const Vec3<Float16>& v,
                                                                         float w) noexcept {
  const __m512 last = _mm512_set1_ps(w);
  const __m512 xy_low = _mm512_unpacklo_ps(v.x.bits, v.y.bits);
  const __m512 xy_high = _mm512_unpackhi_ps(v.x.bits, v.y.bits);
  const __m512 zw_low = _mm512_unpacklo_ps(v.z.bits, last);
  const __m512 zw_high = _mm512_unpackhi_ps(v.z.bits, last);
  return {{_mm512_shuffle_ps(xy_low, zw_low, 0x44), _mm512_shuffle_ps(xy_low, zw_low, 0xee),
           _mm512_shuffle_ps(xy_high, zw_high, 0x44), _mm512_shuffle_ps(xy_high, zw_high, 0xee)}};
}

inline void write(const Writer8& writer8, Index first, const Vec3<Float16>& units) noexcept {
  writer8.write(first, low_half(units));
  writer8.write(first + 8, high_half(units));
}

/// Loads the positions of the corners of sixteen triangles into lanes, as `TriangleLoader` does of
/// eight. \pre `suits_avx2(points)`
template <std::size_t kFloats>
class TriangleLoader16 {
 public:
  using Float = Float16;
  static constexpr Index kLanes = 16;

  explicit TriangleLoader16(const Points& points) noexcept : eight_(points) {}

  [[gnu::always_inline]] void prefetch(const Index* corners, std::ptrdiff_t left) const noexcept {
    eight_.template prefetch<kLanes>(corners, left);
  }

  /// Lane i of p[k] is at corners[3 i + k].
  [[gnu::always_inline]] void load(const Index* corners, Vec3<Float16> (&p)[3]) const noexcept {
    const auto corner = [corners](int i, int k) -> Index { return corners[3 * i + k]; };
    load(corner, has_last(corners), p);
  }
  /// Lane i has triangle 4 (i mod 4) + i / 4, so that the four parts of a row are triangles in a
  /// row.
  [[gnu::always_inline]] void load_turned(const Index* corners,
                                          Vec3<Float16> (&p)[3]) const noexcept {
    const auto corner = [corners](int i, int k) -> Index {
      return corners[3 * (4 * (i % 4) + i / 4) + k];
    };
    load(corner, has_last(corners), p);
  }
  /// Lane i of p[k] is at corners[first + k], where `first` is lane i of `firsts`; as above.
  [[gnu::always_inline]] void load(const Index* corners, Int16 firsts,
                                   Vec3<Float16> (&p)[3]) const noexcept {
    Vec3<Float8> low[3];
    Vec3<Float8> high[3];
    eight_.load(corners, Int8(_mm512_castsi512_si256(firsts.bits)), low);
    eight_.load(corners, Int8(_mm512_extracti64x4_epi64(firsts.bits, 1)), high);
    for (int k = 0; k < 3; ++k) p[k] = joined(low[k], high[k]);
  }
  /// Such lanes and `w` as rows, in the order of the triangles.
  [[gnu::always_inline]] static void store_turned(const Vec3<Float16>& v, float w,
                                                  __m128* rows) noexcept {
    const QuarteredRows quarters = to_quartered_rows(v, w);
    auto* to = reinterpret_cast<float*>(rows);
    for (int j = 0; j < 4; ++j) _mm512_store_ps(to + 16 * j, quarters.row[j]);
  }

 private:
  [[nodiscard]] bool has_last(const Index* corners) const noexcept {
    return eight_.has_last(corners) || eight_.has_last(corners + 24);
  }

  // As in `TriangleLoader`.
  template <class Corner>
  [[gnu::always_inline]] void load(const Corner& corner, bool has_last,
                                   Vec3<Float16> (&p)[3]) const noexcept {
    if (has_last) [[unlikely]] {
      p[0] = one_by_one(corner, 0);
      p[1] = one_by_one(corner, 1);
      p[2] = one_by_one(corner, 2);
    } else {
      p[0] = as_rows(corner, 0);
      p[1] = as_rows(corner, 1);
      p[2] = as_rows(corner, 2);
    }
  }
  template <class Corner>
  [[nodiscard, gnu::always_inline]] Vec3<Float16> as_rows(const Corner& corner,
                                                          int k) const noexcept {
    const auto four = [&](int i) {
      return joined(eight_.load_two(corner(i, k), corner(i + 4, k)),
                    eight_.load_two(corner(i + 8, k), corner(i + 12, k)));
    };
    return to_lanes(four(0), four(1), four(2), four(3));
  }
  template <class Corner>
  [[nodiscard, gnu::noinline]] Vec3<Float16> one_by_one(const Corner& corner,
                                                        int k) const noexcept {
    alignas(64) float xyz[3][16];
    for (int i = 0; i < 16; ++i) {
      const float* p = eight_.at(corner(i, k));
      for (int c = 0; c < 3; ++c) xyz[c][i] = p[c];
    }
    return {_mm512_load_ps(xyz[0]), _mm512_load_ps(xyz[1]), _mm512_load_ps(xyz[2])};
  }

  TriangleLoader<kFloats> eight_;
};

/// Calls `function(loader)` with the one for the stride of the positions.
template <class Function>
inline decltype(auto) with_loader16(const Points& points, const Function& function) noexcept {
  return points.positions.stride_bytes == sizeof(float[3]) ? function(TriangleLoader16<3>(points))
                                                           : function(TriangleLoader16<0>(points));
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
