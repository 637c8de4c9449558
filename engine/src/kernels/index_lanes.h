#pragma once

#include "hedgerow/index.h"
#include "kernels/normals_lanes.h"

/// Eight or sixteen indices at a time, under the same names, for what walks half-edges in lanes.
/// For sources compiled for AVX2 or AVX-512, and only where indices are 32 bits wide.
namespace hedgerow::kernels {

#if defined(__AVX2__)

struct Int8 {
  using Mask = Mask8;
  static constexpr int kLanes = 8;

  __m256i bits;

  Int8() = default;
  // NOLINTNEXTLINE(google-explicit-constructor)
  Int8(__m256i value) noexcept : bits(value) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  Int8(int value) noexcept : bits(_mm256_set1_epi32(value)) {}

  [[nodiscard]] static Int8 load(const Index* p) noexcept {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  }
  /// from[at] in the lanes of `where`, else 0.
  [[nodiscard]] static Int8 gather(const Index* from, Int8 at, Mask8 where) noexcept {
    return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), reinterpret_cast<const int*>(from),
                                       at.bits, _mm256_castps_si256(where.bits), 4);
  }
  /// \pre `p` is aligned
  void store(int* p) const noexcept { _mm256_store_si256(reinterpret_cast<__m256i*>(p), bits); }

  friend Int8 operator+(Int8 a, Int8 b) noexcept { return _mm256_add_epi32(a.bits, b.bits); }
  friend Int8 operator-(Int8 a, Int8 b) noexcept { return _mm256_sub_epi32(a.bits, b.bits); }
  friend Int8 operator*(Int8 a, Int8 b) noexcept { return _mm256_mullo_epi32(a.bits, b.bits); }
  friend Int8 operator&(Int8 a, Int8 b) noexcept { return _mm256_and_si256(a.bits, b.bits); }
  friend Int8 operator<<(Int8 a, int n) noexcept { return _mm256_slli_epi32(a.bits, n); }
  friend Mask8 operator==(Int8 a, Int8 b) noexcept {
    return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.bits, b.bits))};
  }
  friend Mask8 operator>(Int8 a, Int8 b) noexcept {
    return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(a.bits, b.bits))};
  }
};

[[nodiscard]] inline Int8 smaller(Int8 a, Int8 b) noexcept {
  return _mm256_min_epi32(a.bits, b.bits);
}
[[nodiscard]] inline Int8 larger(Int8 a, Int8 b) noexcept {
  return _mm256_max_epi32(a.bits, b.bits);
}
[[nodiscard]] inline Int8 smaller_unsigned(Int8 a, Int8 b) noexcept {
  return _mm256_min_epu32(a.bits, b.bits);
}
[[nodiscard]] inline Int8 select(Mask8 condition, Int8 a, Int8 b) noexcept {
  return _mm256_blendv_epi8(b.bits, a.bits, _mm256_castps_si256(condition.bits));
}
[[nodiscard]] inline int smallest_lane(Int8 a) noexcept {
  __m128i half = _mm_min_epi32(_mm256_castsi256_si128(a.bits), _mm256_extracti128_si256(a.bits, 1));
  half = _mm_min_epi32(half, _mm_shuffle_epi32(half, 0x4e));
  return _mm_cvtsi128_si32(_mm_min_epi32(half, _mm_shuffle_epi32(half, 0xb1)));
}

#endif

#if defined(__AVX512F__)

struct Int16 {
  using Mask = Mask16;
  static constexpr int kLanes = 16;

  __m512i bits;

  Int16() = default;
  // NOLINTNEXTLINE(google-explicit-constructor)
  Int16(__m512i value) noexcept : bits(value) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  Int16(int value) noexcept : bits(_mm512_set1_epi32(value)) {}

  [[nodiscard]] static Int16 load(const Index* p) noexcept { return _mm512_loadu_si512(p); }
  [[nodiscard]] static Int16 gather(const Index* from, Int16 at, Mask16 where) noexcept {
    return _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), where.bits, at.bits, from, 4);
  }
  void store(int* p) const noexcept { _mm512_store_si512(p, bits); }

  friend Int16 operator+(Int16 a, Int16 b) noexcept { return _mm512_add_epi32(a.bits, b.bits); }
  friend Int16 operator-(Int16 a, Int16 b) noexcept { return _mm512_sub_epi32(a.bits, b.bits); }
  friend Int16 operator*(Int16 a, Int16 b) noexcept { return _mm512_mullo_epi32(a.bits, b.bits); }
  friend Int16 operator&(Int16 a, Int16 b) noexcept { return _mm512_and_si512(a.bits, b.bits); }
  friend Int16 operator<<(Int16 a, unsigned n) noexcept { return _mm512_slli_epi32(a.bits, n); }
  friend Mask16 operator==(Int16 a, Int16 b) noexcept {
    return {_mm512_cmpeq_epi32_mask(a.bits, b.bits)};
  }
  friend Mask16 operator>(Int16 a, Int16 b) noexcept {
    return {_mm512_cmpgt_epi32_mask(a.bits, b.bits)};
  }
};

[[nodiscard]] inline Int16 smaller(Int16 a, Int16 b) noexcept {
  return _mm512_min_epi32(a.bits, b.bits);
}
[[nodiscard]] inline Int16 larger(Int16 a, Int16 b) noexcept {
  return _mm512_max_epi32(a.bits, b.bits);
}
[[nodiscard]] inline Int16 smaller_unsigned(Int16 a, Int16 b) noexcept {
  return _mm512_min_epu32(a.bits, b.bits);
}
[[nodiscard]] inline Int16 select(Mask16 condition, Int16 a, Int16 b) noexcept {
  return _mm512_mask_blend_epi32(condition.bits, b.bits, a.bits);
}
[[nodiscard]] inline int smallest_lane(Int16 a) noexcept {
  return smallest_lane(
      Int8(_mm256_min_epi32(_mm512_castsi512_si256(a.bits), _mm512_extracti64x4_epi64(a.bits, 1))));
}

#endif

}  // namespace hedgerow::kernels
