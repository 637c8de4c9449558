#pragma once

#include "kernels/normals_source.h"

#if defined(__SSE2__)

/// Moving float3 values in and out of four lanes.
namespace hedgerow::kernels {

/// A position as one vector; the last lane holds anything. A 16-byte load would read four bytes
/// behind the last z, so the last position is put together from two parts.
[[nodiscard]] inline __m128 load_point(const Points& points, Index v) noexcept {
  const float* p = points.positions[v];
  if (v + 1 < points.positions.count) [[likely]]
    return _mm_loadu_ps(p);
  const __m128 xy = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
  return _mm_movelh_ps(xy, _mm_load_ss(p + 2));
}

/// Whether v is among `kCorners` corners.
template <Index kCorners>
[[nodiscard, gnu::always_inline]] inline bool is_among(const Index* corners, Index v) noexcept {
  Index any = 0;  // as wide as the indices, so that it becomes a vector
  for (Index c = 0; c < kCorners; ++c) any |= corners[c] == v ? Index{1} : Index{0};
  return any != 0;
}

/// Four vectors x, y, z and what lies behind them, as lanes.
[[nodiscard, gnu::always_inline]] inline Vec3<Float4> to_lanes(__m128 a, __m128 b, __m128 c,
                                                               __m128 d) noexcept {
  _MM_TRANSPOSE4_PS(a, b, c, d);
  return {a, b, c};
}

/// The positions of four vertices that lie `step` apart in `v`.
[[nodiscard]] inline Vec3<Float4> load_points(const Points& points, const Index* v,
                                              int step) noexcept {
  return to_lanes(load_point(points, v[0]), load_point(points, v[step]),
                  load_point(points, v[2 * step]), load_point(points, v[3 * step]));
}

/// Four vectors, each with `w` behind it.
struct Rows {
  __m128 row[4];
};
[[nodiscard]] inline Rows to_rows(const Vec3<Float4>& v, float w) noexcept {
  Rows rows{{v.x.bits, v.y.bits, v.z.bits, _mm_set1_ps(w)}};
  _MM_TRANSPOSE4_PS(rows.row[0], rows.row[1], rows.row[2], rows.row[3]);
  return rows;
}

/// Four float3 in a row are three vectors exactly.
inline void store_packed(float* out, const Rows& r) noexcept {
  const __m128 z0x1 = _mm_shuffle_ps(r.row[0], r.row[1], _MM_SHUFFLE(0, 0, 2, 2));
  const __m128 z2x3 = _mm_shuffle_ps(r.row[2], r.row[3], _MM_SHUFFLE(0, 0, 2, 2));
  _mm_storeu_ps(out, _mm_shuffle_ps(r.row[0], z0x1, _MM_SHUFFLE(2, 0, 1, 0)));
  _mm_storeu_ps(out + 4, _mm_shuffle_ps(r.row[1], r.row[2], _MM_SHUFFLE(1, 0, 2, 1)));
  _mm_storeu_ps(out + 8, _mm_shuffle_ps(z2x3, r.row[3], _MM_SHUFFLE(2, 1, 2, 0)));
}

[[nodiscard]] inline Float3 to_float3(__m128 row) noexcept {
  float v[4];
  _mm_storeu_ps(v, row);
  return {v[0], v[1], v[2]};
}

}  // namespace hedgerow::kernels

#endif
