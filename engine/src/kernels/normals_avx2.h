#pragma once

#include "kernels/normals_source.h"

#if defined(__AVX2__)

/// Moving float3 values in and out of eight lanes; for sources compiled for AVX2.
namespace hedgerow::kernels {

[[nodiscard]] inline __m256i load_indices(const Index* p) noexcept {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
}

/// Floats from one position to the next, in each lane.
[[nodiscard]] inline __m256i stride_of(const Points& points) noexcept {
  return _mm256_set1_epi32(static_cast<int>(points.positions.stride_bytes / sizeof(float)));
}

/// The positions of eight vertices. Reads nothing but the three floats of each.
/// \pre `suits_avx2(points)`
[[nodiscard]] inline Vec3<Float8> load_points(const Points& points, __m256i v,
                                              __m256i stride) noexcept {
  const float* p = points.positions.data;
  const __m256i at = _mm256_mullo_epi32(v, stride);
  return {_mm256_i32gather_ps(p, at, 4), _mm256_i32gather_ps(p + 1, at, 4),
          _mm256_i32gather_ps(p + 2, at, 4)};
}

/// Corner k of eight triangles, in lanes.
struct Corners8 {
  __m256i corner[3];
};
/// Lane i of corner k is corners[3 i + k].
[[nodiscard]] inline Corners8 load_triangles(const Index* corners) noexcept {
  // Three loads hold the 24 indices; each result takes lanes from all three, then puts them in
  // order: lane l of load j is index 8 j + l, corner (8 j + l) % 3 of triangle (8 j + l) / 3.
  const __m256i a = load_indices(corners);
  const __m256i b = load_indices(corners + 8);
  const __m256i c = load_indices(corners + 16);
  const auto blend = [](__m256i p, __m256i q, __m256i r) {
    return _mm256_blend_epi32(_mm256_blend_epi32(p, q, 0x92), r, 0x24);
  };
  // 0, 9, 18, 3, 12, 21, 6, 15
  const __m256i first = blend(a, b, c);
  const __m256i second = blend(c, a, b);
  const __m256i third = blend(b, c, a);
  return {{_mm256_permutevar8x32_epi32(first, _mm256_setr_epi32(0, 3, 6, 1, 4, 7, 2, 5)),
           _mm256_permutevar8x32_epi32(second, _mm256_setr_epi32(1, 4, 7, 2, 5, 0, 3, 6)),
           _mm256_permutevar8x32_epi32(third, _mm256_setr_epi32(2, 5, 0, 3, 6, 1, 4, 7))}};
}

/// Eight vectors as rows x, y, z, w.
struct Rows8 {
  __m128 row[8];
};
[[nodiscard]] inline Rows8 to_rows(const Vec3<Float8>& v, float w) noexcept {
  const __m256 last = _mm256_set1_ps(w);
  const __m256 xy_low = _mm256_unpacklo_ps(v.x.bits, v.y.bits);
  const __m256 xy_high = _mm256_unpackhi_ps(v.x.bits, v.y.bits);
  const __m256 zw_low = _mm256_unpacklo_ps(v.z.bits, last);
  const __m256 zw_high = _mm256_unpackhi_ps(v.z.bits, last);
  const __m256 pair[4] = {
      _mm256_shuffle_ps(xy_low, zw_low, 0x44), _mm256_shuffle_ps(xy_low, zw_low, 0xee),
      _mm256_shuffle_ps(xy_high, zw_high, 0x44), _mm256_shuffle_ps(xy_high, zw_high, 0xee)};
  Rows8 rows;
  for (int i = 0; i < 4; ++i) {
    rows.row[i] = _mm256_castps256_ps128(pair[i]);
    rows.row[i + 4] = _mm256_extractf128_ps(pair[i], 1);
  }
  return rows;
}

/// Eight float3 in a row are three vectors exactly: `load_triangles` the other way round.
inline void store_packed(float* out, const Vec3<Float8>& v) noexcept {
  const __m256 x = _mm256_permutevar8x32_ps(v.x.bits, _mm256_setr_epi32(0, 3, 6, 1, 4, 7, 2, 5));
  const __m256 y = _mm256_permutevar8x32_ps(v.y.bits, _mm256_setr_epi32(5, 0, 3, 6, 1, 4, 7, 2));
  const __m256 z = _mm256_permutevar8x32_ps(v.z.bits, _mm256_setr_epi32(2, 5, 0, 3, 6, 1, 4, 7));
  const auto blend = [](__m256 p, __m256 q, __m256 r) {
    return _mm256_blend_ps(_mm256_blend_ps(p, q, 0x92), r, 0x24);
  };
  _mm256_storeu_ps(out, blend(x, y, z));
  _mm256_storeu_ps(out + 8, blend(z, x, y));
  _mm256_storeu_ps(out + 16, blend(y, z, x));
}

/// Writes the unit vectors of elements first .. first + 7.
inline void write_units(const NormalWriter& writer, Index first, const Vec3<Float8>& v) noexcept {
  if (writer.out.stride_bytes == sizeof(float[3])) {
    store_packed(writer.out[first], v);
    return;
  }
  const Rows8 rows = to_rows(v, 0);
  for (Index i = 0; i < 8; ++i) {
    alignas(16) float xyz[4];
    _mm_store_ps(xyz, rows.row[i]);
    float* p = writer.out[first + i];
    for (int k = 0; k < 3; ++k) p[k] = xyz[k];
  }
}

}  // namespace hedgerow::kernels

#endif
