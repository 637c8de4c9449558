#pragma once

#include "kernels/normals_sse.h"
#include "kernels/pair_windows.h"

#if defined(__SSE2__)

/// Four pairs at a time; see pair_runs.h. Local to each source.
namespace hedgerow::kernels {
namespace {

class PairLanes4 {
 public:
  using Float = Float4;
  static constexpr Index kPairs = 4;

  struct Rows {
    __m128 row[4];

    [[nodiscard, gnu::always_inline]] static Rows load(const float* p) noexcept {
      return {{_mm_load_ps(p), _mm_load_ps(p + 4), _mm_load_ps(p + 8), _mm_load_ps(p + 12)}};
    }
    [[gnu::always_inline]] void store(float* p) const noexcept {
      for (int j = 0; j < 4; ++j) _mm_store_ps(p + 4 * j, row[j]);
    }
    [[gnu::always_inline]] friend Rows operator+(const Rows& a, const Rows& b) noexcept {
      return {{_mm_add_ps(a.row[0], b.row[0]), _mm_add_ps(a.row[1], b.row[1]),
               _mm_add_ps(a.row[2], b.row[2]), _mm_add_ps(a.row[3], b.row[3])}};
    }
  };

  static bool is_run(const Index* corners) noexcept {
    if (corners[6] != corners[0] + 1 || corners[7] != corners[1] + 1) return false;
    Index difference = 0;
    for (Index c = 0; c + kPairCorners < kPairCorners * kPairs; ++c) {
      difference |= corners[c + kPairCorners] ^ (corners[c] + 1);
    }
    return difference == 0;
  }

  // x, y, z of four vertices are three vectors exactly.
  [[nodiscard, gnu::always_inline]] static Vec3<Float4> load(const float* p) noexcept {
    const __m128 low = _mm_loadu_ps(p);
    const __m128 middle = _mm_loadu_ps(p + 4);
    const __m128 high = _mm_loadu_ps(p + 8);
    const __m128 x23 = _mm_shuffle_ps(middle, high, _MM_SHUFFLE(1, 1, 2, 2));
    const __m128 y01 = _mm_shuffle_ps(low, middle, _MM_SHUFFLE(0, 0, 1, 1));
    const __m128 y23 = _mm_shuffle_ps(middle, high, _MM_SHUFFLE(2, 2, 3, 3));
    const __m128 z01 = _mm_shuffle_ps(low, middle, _MM_SHUFFLE(1, 1, 2, 2));
    return {_mm_shuffle_ps(low, x23, _MM_SHUFFLE(2, 0, 3, 0)),
            _mm_shuffle_ps(y01, y23, _MM_SHUFFLE(2, 0, 2, 0)),
            _mm_shuffle_ps(z01, high, _MM_SHUFFLE(3, 0, 2, 0))};
  }

  [[nodiscard, gnu::always_inline]] static Rows to_rows(const Vec3<Float4>& v, float w) noexcept {
    const kernels::Rows rows = kernels::to_rows(v, w);
    return {{rows.row[0], rows.row[1], rows.row[2], rows.row[3]}};
  }
  [[nodiscard, gnu::always_inline]] static Rows scaled(const Rows& rows, Float4 by) noexcept {
    return {{_mm_mul_ps(rows.row[0], _mm_shuffle_ps(by.bits, by.bits, 0x00)),
             _mm_mul_ps(rows.row[1], _mm_shuffle_ps(by.bits, by.bits, 0x55)),
             _mm_mul_ps(rows.row[2], _mm_shuffle_ps(by.bits, by.bits, 0xaa)),
             _mm_mul_ps(rows.row[3], _mm_shuffle_ps(by.bits, by.bits, 0xff))}};
  }
  [[nodiscard, gnu::always_inline]] static Rows moved(const Rows& rows) noexcept {
    return {{_mm_set1_ps(-0.0f), rows.row[0], rows.row[1], rows.row[2]}};
  }
  [[nodiscard, gnu::always_inline]] static __m128 last(const Rows& rows) noexcept {
    return rows.row[3];
  }
};

}  // namespace
}  // namespace hedgerow::kernels

#endif
