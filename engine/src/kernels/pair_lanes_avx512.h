#pragma once

#include "kernels/normals_avx512.h"
#include "kernels/pair_windows.h"

#if defined(__AVX512F__)

/// Sixteen pairs at a time; see pair_runs.h. Local to each source.
namespace hedgerow::kernels {
namespace {

class PairLanes16 {
 public:
  using Float = Float16;
  static constexpr Index kPairs = 16;

  struct Rows : QuarteredRows {
    [[nodiscard, gnu::always_inline]] static Rows load(const float* p) noexcept {
      return {{_mm512_loadu_ps(p), _mm512_loadu_ps(p + 16), _mm512_loadu_ps(p + 32),
               _mm512_loadu_ps(p + 48)}};
    }
    [[gnu::always_inline]] void store(float* p) const noexcept {
      for (int j = 0; j < 4; ++j) _mm512_storeu_ps(p + 16 * j, row[j]);
    }
    [[gnu::always_inline]] friend Rows operator+(const Rows& a, const Rows& b) noexcept {
      return {{_mm512_add_ps(a.row[0], b.row[0]), _mm512_add_ps(a.row[1], b.row[1]),
               _mm512_add_ps(a.row[2], b.row[2]), _mm512_add_ps(a.row[3], b.row[3])}};
    }
  };

  PairLanes16() noexcept {
    alignas(64) int numbers[4][16];
    for (int q = 0; q < 3; ++q) {
      for (int i = 0; i < 16; ++i) {
        numbers[0][i] = (16 * q + i) % kPairCorners;
        numbers[1][i] = (16 * q + i) / kPairCorners;
        const int from = 3 * pair_of(i) + q;
        numbers[2][i] = from % 32;
        numbers[3][i] = from < 32 ? i : from - 16;
      }
      corner_[q] = _mm512_load_si512(numbers[0]);
      pair_[q] = _mm512_load_si512(numbers[1]);
      of_two_[q] = _mm512_load_si512(numbers[2]);
      of_three_[q] = _mm512_load_si512(numbers[3]);
    }
    for (int i = 0; i < 16; ++i) numbers[0][i] = 3 * (i / 4) + i % 4 % 3;
    of_row_ = _mm512_load_si512(numbers[0]);
    of_last_row_ = _mm512_add_epi32(of_row_, _mm512_set1_epi32(4));
  }

  [[gnu::always_inline]] bool is_run(const Index* corners) const noexcept {
    const auto load = [&](int i) { return _mm512_loadu_si512(corners + i); };
    const __m512i first = load(0);
    // Most triangles are in no run, which two pairs tell.
    const __m512i expected =
        _mm512_add_epi32(_mm512_permutexvar_epi32(corner_[0], first), pair_[0]);
    if (_mm512_mask_cmpneq_epi32_mask(0xfff, expected, first) != 0) return false;
    __m512i difference = _mm512_setzero_si512();
    const auto compare = [&](__m512i a, __m512i b) {
      difference = _mm512_ternarylogic_epi32(difference, a, b, 0xf6);  // or what a and b differ in
    };
    for (int q = 0; q < 3; ++q) {
      const __m512i wanted =
          _mm512_add_epi32(_mm512_permutexvar_epi32(corner_[q], first), pair_[q]);
      compare(wanted, load(16 * q));
      compare(_mm512_add_epi32(wanted, _mm512_set1_epi32(8)), load(16 * q + 48));
    }
    return _mm512_test_epi32_mask(difference, difference) == 0;
  }

  [[nodiscard, gnu::always_inline]] Vec3<Float16> load(const float* p) const noexcept {
    const __m512 low = _mm512_loadu_ps(p);
    const __m512 middle = _mm512_loadu_ps(p + 16);
    const __m512 high = _mm512_loadu_ps(p + 32);
    const auto coordinate = [&](int k) {
      const __m512 of_two = _mm512_permutex2var_ps(low, of_two_[k], middle);
      return Float16(_mm512_permutex2var_ps(of_two, of_three_[k], high));
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
  }

  [[nodiscard, gnu::always_inline]] static Rows to_rows(const Vec3<Float16>& v, float w) noexcept {
    return {to_quartered_rows(v, w)};
  }
  [[nodiscard, gnu::always_inline]] static Rows scaled(const Rows& rows, Float16 by) noexcept {
    return {{_mm512_mul_ps(rows.row[0], _mm512_permute_ps(by.bits, 0x00)),
             _mm512_mul_ps(rows.row[1], _mm512_permute_ps(by.bits, 0x55)),
             _mm512_mul_ps(rows.row[2], _mm512_permute_ps(by.bits, 0xaa)),
             _mm512_mul_ps(rows.row[3], _mm512_permute_ps(by.bits, 0xff))}};
  }
  [[nodiscard, gnu::always_inline]] static Rows moved(const Rows& rows) noexcept {
    const auto behind = [](__m512 before, __m512 row) {
      return _mm512_castsi512_ps(
          _mm512_alignr_epi32(_mm512_castps_si512(row), _mm512_castps_si512(before), 12));
    };
    return {{behind(_mm512_set1_ps(-0.0f), rows.row[0]), behind(rows.row[0], rows.row[1]),
             behind(rows.row[1], rows.row[2]), behind(rows.row[2], rows.row[3])}};
  }
  [[nodiscard, gnu::always_inline]] static __m128 last(const Rows& rows) noexcept {
    return _mm512_extractf32x4_ps(rows.row[3], 3);
  }

  /// x, y, z and no matter what of four vertices in a row: the `part`-th of four such.
  [[nodiscard, gnu::always_inline]] __m512 position_row(const float* p, int part) const noexcept {
    return part < 3 ? _mm512_permutexvar_ps(of_row_, _mm512_loadu_ps(p + 12 * part))
                    : _mm512_permutexvar_ps(of_last_row_, _mm512_loadu_ps(p + 32));
  }
  [[nodiscard, gnu::always_inline]] static __m512 area_row(__m512 p0, __m512 p1,
                                                           __m512 p2) noexcept {
    const auto turned = [](__m512 v) { return _mm512_permute_ps(v, 0xc9); };
    const __m512 u = _mm512_sub_ps(p0, p1);
    const __m512 v = _mm512_sub_ps(p0, p2);
    const __m512 zxy = _mm512_sub_ps(_mm512_mul_ps(u, turned(v)), _mm512_mul_ps(turned(u), v));
    return _mm512_mask_permute_ps(_mm512_set1_ps(1), 0x7777, zxy, 0xc9);
  }

 private:
  // As `TriangleLoader16::load_turned` has triangles.
  static constexpr int pair_of(int lane) noexcept { return 4 * (lane % 4) + lane / 4; }

  // Index i of 48 is corner corner_ of pair pair_.
  __m512i corner_[3];
  __m512i pair_[3];
  // Where in three vectors of positions a coordinate of each pair is: first of two, then of three.
  __m512i of_two_[3];
  __m512i of_three_[3];
  // Where in a vector x, y and z of four vertices are; and of the last four, in the last vector.
  __m512i of_row_;
  __m512i of_last_row_;
};

}  // namespace
}  // namespace hedgerow::kernels

#endif
