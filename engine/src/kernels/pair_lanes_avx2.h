#pragma once

#include "kernels/normals_avx2.h"
#include "kernels/pair_windows.h"

#if defined(__AVX2__)

/// Eight pairs at a time; see pair_runs.h. Local to each source.
namespace hedgerow::kernels {
namespace {

class PairLanes8 {
 public:
  using Float = Float8;
  static constexpr Index kPairs = 8;

  struct Rows : PairedRows {
    [[nodiscard, gnu::always_inline]] static Rows load(const float* p) noexcept {
      return {{_mm256_loadu_ps(p), _mm256_loadu_ps(p + 8), _mm256_loadu_ps(p + 16),
               _mm256_loadu_ps(p + 24)}};
    }
    [[gnu::always_inline]] void store(float* p) const noexcept {
      for (int j = 0; j < 4; ++j) _mm256_storeu_ps(p + 8 * j, row[j]);
    }
    [[gnu::always_inline]] friend Rows operator+(const Rows& a, const Rows& b) noexcept {
      return {{_mm256_add_ps(a.row[0], b.row[0]), _mm256_add_ps(a.row[1], b.row[1]),
               _mm256_add_ps(a.row[2], b.row[2]), _mm256_add_ps(a.row[3], b.row[3])}};
    }
  };

  PairLanes8() noexcept {
    alignas(32) int numbers[3][8];
    for (int q = 0; q < 3; ++q) {
      for (int i = 0; i < 8; ++i) {
        numbers[0][i] = (8 * q + i) % kPairCorners;
        numbers[1][i] = (8 * q + i) / kPairCorners;
        numbers[2][i] = (3 * pair_of(i) + q) % 8;
      }
      const auto load = [](const int* p) {
        return _mm256_load_si256(reinterpret_cast<const __m256i*>(p));
      };
      corner_[q] = load(numbers[0]);
      pair_[q] = load(numbers[1]);
      place_[q] = load(numbers[2]);
    }
  }

  [[gnu::always_inline]] bool is_run(const Index* corners) const noexcept {
    const __m256i first = load_indices(corners);
    const auto wanted = [&](int q) {
      return _mm256_add_epi32(_mm256_permutevar8x32_epi32(first, corner_[q]), pair_[q]);
    };
    __m256i difference = _mm256_xor_si256(wanted(0), first);
    // Most triangles are in no run, which the first of the second pair tell.
    if (_mm256_testz_si256(difference, difference) == 0) return false;
    const auto compare = [&](__m256i a, int i) {
      difference = _mm256_or_si256(difference, _mm256_xor_si256(a, load_indices(corners + i)));
    };
    for (int q = 0; q < 3; ++q) {
      compare(wanted(q), 8 * q);
      compare(_mm256_add_epi32(wanted(q), _mm256_set1_epi32(4)), 8 * q + 24);
    }
    return _mm256_testz_si256(difference, difference) != 0;
  }

  // A coordinate of eight vertices has eight places in its vectors.
  [[nodiscard, gnu::always_inline]] Vec3<Float8> load(const float* p) const noexcept {
    const __m256 low = _mm256_loadu_ps(p);
    const __m256 middle = _mm256_loadu_ps(p + 8);
    const __m256 high = _mm256_loadu_ps(p + 16);
    const auto blend = [](__m256 a, __m256 b, __m256 c) {
      return _mm256_blend_ps(_mm256_blend_ps(a, b, 0x92), c, 0x24);
    };
    return {_mm256_permutevar8x32_ps(blend(low, middle, high), place_[0]),
            _mm256_permutevar8x32_ps(blend(high, low, middle), place_[1]),
            _mm256_permutevar8x32_ps(blend(middle, high, low), place_[2])};
  }

  [[nodiscard, gnu::always_inline]] static Rows to_rows(const Vec3<Float8>& v, float w) noexcept {
    return {to_paired_rows(v, w)};
  }
  [[nodiscard, gnu::always_inline]] static Rows scaled(const Rows& rows, Float8 by) noexcept {
    return {{_mm256_mul_ps(rows.row[0], _mm256_permute_ps(by.bits, 0x00)),
             _mm256_mul_ps(rows.row[1], _mm256_permute_ps(by.bits, 0x55)),
             _mm256_mul_ps(rows.row[2], _mm256_permute_ps(by.bits, 0xaa)),
             _mm256_mul_ps(rows.row[3], _mm256_permute_ps(by.bits, 0xff))}};
  }
  [[nodiscard, gnu::always_inline]] static Rows moved(const Rows& rows) noexcept {
    const auto behind = [](__m256 before, __m256 row) {
      return _mm256_permute2f128_ps(before, row, 0x21);
    };
    return {{behind(_mm256_set1_ps(-0.0f), rows.row[0]), behind(rows.row[0], rows.row[1]),
             behind(rows.row[1], rows.row[2]), behind(rows.row[2], rows.row[3])}};
  }
  [[nodiscard, gnu::always_inline]] static __m128 last(const Rows& rows) noexcept {
    return _mm256_extractf128_ps(rows.row[3], 1);
  }

  /// x, y, z and no matter what of two vertices in a row: the `part`-th of four such.
  [[nodiscard, gnu::always_inline]] static __m256 position_row(const float* p, int part) noexcept {
    const __m128 first = _mm_loadu_ps(p + 6 * part);
    if (part < 3)
      return _mm256_insertf128_ps(_mm256_castps128_ps256(first), _mm_loadu_ps(p + 6 * part + 3), 1);
    const __m128 second = _mm_loadu_ps(p + 20);
    return _mm256_insertf128_ps(_mm256_castps128_ps256(first), _mm_shuffle_ps(second, second, 0x39),
                                1);
  }
  [[nodiscard, gnu::always_inline]] static __m256 area_row(__m256 p0, __m256 p1,
                                                           __m256 p2) noexcept {
    const auto turned = [](__m256 v) { return _mm256_permute_ps(v, 0xc9); };
    const __m256 u = _mm256_sub_ps(p0, p1);
    const __m256 v = _mm256_sub_ps(p0, p2);
    const __m256 zxy = _mm256_sub_ps(_mm256_mul_ps(u, turned(v)), _mm256_mul_ps(turned(u), v));
    return _mm256_blend_ps(turned(zxy), _mm256_set1_ps(1), 0x88);
  }

 private:
  // As `TriangleLoader::load_turned` has triangles.
  static constexpr int pair_of(int lane) noexcept { return 2 * (lane % 4) + lane / 4; }

  // Index i of 24 is corner corner_ of pair pair_.
  __m256i corner_[3];
  __m256i pair_[3];
  __m256i place_[3];  // of each coordinate of each pair
};

}  // namespace
}  // namespace hedgerow::kernels

#endif
