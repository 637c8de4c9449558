#pragma once

#include <cmath>

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

/// One arithmetic for one float, four, eight and sixteen: the formulas of the normals are templates
/// over these, so that SIMD and scalar code perform the same operations in the same order on each
/// lane. Every operation used is rounded as IEEE 754 says, so the bits agree, too.
namespace hedgerow::kernels {

[[nodiscard]] inline float square_root(float a) noexcept { return std::sqrt(a); }
[[nodiscard]] inline float magnitude(float a) noexcept { return std::fabs(a); }
/// The second argument where one is not a number, as the SSE instruction.
[[nodiscard]] inline float smaller(float a, float b) noexcept { return a < b ? a : b; }
[[nodiscard]] inline float larger(float a, float b) noexcept { return a > b ? a : b; }
[[nodiscard]] inline float select(bool condition, float a, float b) noexcept {
  return condition ? a : b;
}

/// Cheaper than `select` on vectors: the value where the condition holds, else zero; and the value,
/// where the condition holds with the other sign.
[[nodiscard]] inline float kept(bool condition, float a) noexcept { return condition ? a : 0.0f; }
[[nodiscard]] inline float negated(bool condition, float a) noexcept { return condition ? -a : a; }

#if defined(__SSE2__)

/// Four comparisons; each lane all ones or all zeros.
struct Mask4 {
  __m128 bits;

  friend Mask4 operator&(Mask4 a, Mask4 b) noexcept { return {_mm_and_ps(a.bits, b.bits)}; }
  /// Bit i: lane i.
  [[nodiscard]] int lanes() const noexcept { return _mm_movemask_ps(bits); }
  [[nodiscard]] bool all() const noexcept { return lanes() == 0xf; }
};

struct Float4 {
  __m128 bits;

  Float4() = default;
  // NOLINTNEXTLINE(google-explicit-constructor)
  Float4(__m128 value) noexcept : bits(value) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  Float4(float value) noexcept : bits(_mm_set1_ps(value)) {}

  friend Float4 operator+(Float4 a, Float4 b) noexcept { return _mm_add_ps(a.bits, b.bits); }
  friend Float4 operator-(Float4 a, Float4 b) noexcept { return _mm_sub_ps(a.bits, b.bits); }
  friend Float4 operator*(Float4 a, Float4 b) noexcept { return _mm_mul_ps(a.bits, b.bits); }
  friend Float4 operator/(Float4 a, Float4 b) noexcept { return _mm_div_ps(a.bits, b.bits); }
  friend Mask4 operator<(Float4 a, Float4 b) noexcept { return {_mm_cmplt_ps(a.bits, b.bits)}; }
  friend Mask4 operator>(Float4 a, Float4 b) noexcept { return {_mm_cmpgt_ps(a.bits, b.bits)}; }
  friend Mask4 operator<=(Float4 a, Float4 b) noexcept { return {_mm_cmple_ps(a.bits, b.bits)}; }
  friend Mask4 operator>=(Float4 a, Float4 b) noexcept { return {_mm_cmpge_ps(a.bits, b.bits)}; }
};

[[nodiscard]] inline Float4 square_root(Float4 a) noexcept { return _mm_sqrt_ps(a.bits); }
[[nodiscard]] inline Float4 magnitude(Float4 a) noexcept {
  return _mm_andnot_ps(_mm_set1_ps(-0.0f), a.bits);
}
[[nodiscard]] inline Float4 smaller(Float4 a, Float4 b) noexcept {
  return _mm_min_ps(a.bits, b.bits);
}
[[nodiscard]] inline Float4 larger(Float4 a, Float4 b) noexcept {
  return _mm_max_ps(a.bits, b.bits);
}
[[nodiscard]] inline Float4 select(Mask4 condition, Float4 a, Float4 b) noexcept {
  return _mm_or_ps(_mm_and_ps(condition.bits, a.bits), _mm_andnot_ps(condition.bits, b.bits));
}
[[nodiscard]] inline Float4 kept(Mask4 condition, Float4 a) noexcept {
  return _mm_and_ps(condition.bits, a.bits);
}
[[nodiscard]] inline Float4 negated(Mask4 condition, Float4 a) noexcept {
  return _mm_xor_ps(_mm_and_ps(condition.bits, _mm_set1_ps(-0.0f)), a.bits);
}

#endif

// Only in sources that are compiled for AVX2.
#if defined(__AVX2__)

/// Eight comparisons.
struct Mask8 {
  __m256 bits;

  friend Mask8 operator&(Mask8 a, Mask8 b) noexcept { return {_mm256_and_ps(a.bits, b.bits)}; }
  /// Bit i: lane i.
  [[nodiscard]] int lanes() const noexcept { return _mm256_movemask_ps(bits); }
  [[nodiscard]] bool all() const noexcept { return lanes() == 0xff; }
  [[nodiscard]] bool any() const noexcept { return _mm256_testz_ps(bits, bits) == 0; }
  [[nodiscard]] Mask8 without(Mask8 other) const noexcept {
    return {_mm256_andnot_ps(other.bits, bits)};
  }
};

struct Float8 {
  __m256 bits;

  Float8() = default;
  // NOLINTNEXTLINE(google-explicit-constructor)
  Float8(__m256 value) noexcept : bits(value) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  Float8(float value) noexcept : bits(_mm256_set1_ps(value)) {}

  /// \pre `p` is aligned
  void store(float* p) const noexcept { _mm256_store_ps(p, bits); }

  friend Float8 operator+(Float8 a, Float8 b) noexcept { return _mm256_add_ps(a.bits, b.bits); }
  friend Float8 operator-(Float8 a, Float8 b) noexcept { return _mm256_sub_ps(a.bits, b.bits); }
  friend Float8 operator*(Float8 a, Float8 b) noexcept { return _mm256_mul_ps(a.bits, b.bits); }
  friend Float8 operator/(Float8 a, Float8 b) noexcept { return _mm256_div_ps(a.bits, b.bits); }
  friend Mask8 operator<(Float8 a, Float8 b) noexcept {
    return {_mm256_cmp_ps(a.bits, b.bits, _CMP_LT_OS)};
  }
  friend Mask8 operator>(Float8 a, Float8 b) noexcept {
    return {_mm256_cmp_ps(a.bits, b.bits, _CMP_GT_OS)};
  }
  friend Mask8 operator<=(Float8 a, Float8 b) noexcept {
    return {_mm256_cmp_ps(a.bits, b.bits, _CMP_LE_OS)};
  }
  friend Mask8 operator>=(Float8 a, Float8 b) noexcept {
    return {_mm256_cmp_ps(a.bits, b.bits, _CMP_GE_OS)};
  }
};

[[nodiscard]] inline Float8 square_root(Float8 a) noexcept { return _mm256_sqrt_ps(a.bits); }
[[nodiscard]] inline Float8 magnitude(Float8 a) noexcept {
  return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.bits);
}
[[nodiscard]] inline Float8 smaller(Float8 a, Float8 b) noexcept {
  return _mm256_min_ps(a.bits, b.bits);
}
[[nodiscard]] inline Float8 larger(Float8 a, Float8 b) noexcept {
  return _mm256_max_ps(a.bits, b.bits);
}
[[nodiscard]] inline Float8 select(Mask8 condition, Float8 a, Float8 b) noexcept {
  return _mm256_blendv_ps(b.bits, a.bits, condition.bits);
}
[[nodiscard]] inline Float8 kept(Mask8 condition, Float8 a) noexcept {
  return _mm256_and_ps(condition.bits, a.bits);
}
[[nodiscard]] inline Float8 negated(Mask8 condition, Float8 a) noexcept {
  return _mm256_xor_ps(_mm256_and_ps(condition.bits, _mm256_set1_ps(-0.0f)), a.bits);
}

#endif

// Only in sources that are compiled for AVX-512.
#if defined(__AVX512F__)

/// Sixteen comparisons.
struct Mask16 {
  __mmask16 bits;

  friend Mask16 operator&(Mask16 a, Mask16 b) noexcept { return {_kand_mask16(a.bits, b.bits)}; }
  [[nodiscard]] int lanes() const noexcept { return bits; }
  [[nodiscard]] bool all() const noexcept { return bits == 0xffff; }
  [[nodiscard]] bool any() const noexcept { return bits != 0; }
  [[nodiscard]] Mask16 without(Mask16 other) const noexcept {
    return {_kandn_mask16(other.bits, bits)};
  }
};

struct Float16 {
  __m512 bits;

  Float16() = default;
  // NOLINTNEXTLINE(google-explicit-constructor)
  Float16(__m512 value) noexcept : bits(value) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  Float16(float value) noexcept : bits(_mm512_set1_ps(value)) {}

  void store(float* p) const noexcept { _mm512_store_ps(p, bits); }

  friend Float16 operator+(Float16 a, Float16 b) noexcept { return _mm512_add_ps(a.bits, b.bits); }
  friend Float16 operator-(Float16 a, Float16 b) noexcept { return _mm512_sub_ps(a.bits, b.bits); }
  friend Float16 operator*(Float16 a, Float16 b) noexcept { return _mm512_mul_ps(a.bits, b.bits); }
  friend Float16 operator/(Float16 a, Float16 b) noexcept { return _mm512_div_ps(a.bits, b.bits); }
  friend Mask16 operator<(Float16 a, Float16 b) noexcept {
    return {_mm512_cmp_ps_mask(a.bits, b.bits, _CMP_LT_OS)};
  }
  friend Mask16 operator>(Float16 a, Float16 b) noexcept {
    return {_mm512_cmp_ps_mask(a.bits, b.bits, _CMP_GT_OS)};
  }
  friend Mask16 operator<=(Float16 a, Float16 b) noexcept {
    return {_mm512_cmp_ps_mask(a.bits, b.bits, _CMP_LE_OS)};
  }
  friend Mask16 operator>=(Float16 a, Float16 b) noexcept {
    return {_mm512_cmp_ps_mask(a.bits, b.bits, _CMP_GE_OS)};
  }
};

[[nodiscard]] inline Float16 square_root(Float16 a) noexcept { return _mm512_sqrt_ps(a.bits); }
[[nodiscard]] inline Float16 magnitude(Float16 a) noexcept { return _mm512_abs_ps(a.bits); }
[[nodiscard]] inline Float16 smaller(Float16 a, Float16 b) noexcept {
  return _mm512_min_ps(a.bits, b.bits);
}
[[nodiscard]] inline Float16 larger(Float16 a, Float16 b) noexcept {
  return _mm512_max_ps(a.bits, b.bits);
}
[[nodiscard]] inline Float16 select(Mask16 condition, Float16 a, Float16 b) noexcept {
  return _mm512_mask_blend_ps(condition.bits, b.bits, a.bits);
}
/// Masks of this width add and subtract by themselves; see `more_where` and the two after it.
[[nodiscard]] inline Float16 more_where(Mask16 condition, Float16 a, Float16 b) noexcept {
  return _mm512_mask_add_ps(a.bits, condition.bits, a.bits, b.bits);
}
[[nodiscard]] inline Float16 less_where(Mask16 condition, Float16 a, Float16 b) noexcept {
  return _mm512_mask_sub_ps(a.bits, condition.bits, a.bits, b.bits);
}
[[nodiscard]] inline Float16 rest_where(Mask16 condition, Float16 a, Float16 whole) noexcept {
  return _mm512_mask_sub_ps(a.bits, condition.bits, whole.bits, a.bits);
}

#endif

}  // namespace hedgerow::kernels
