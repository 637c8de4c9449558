#pragma once

#include <cstdint>

#include "kernels/normals_avx2.h"
#include "kernels/term_rows.h"

#if defined(__AVX2__)

/// Looks at the corners of a group of triangles, eight at a time; see area_terms.h. Local to each
/// source, as those are compiled for different processors.
namespace hedgerow::kernels {
namespace {

template <Index kTriangles>
struct Corners {
  static constexpr Index kSize = kTriangles;
  static constexpr Index kVectors = 3 * kSize / 8;

  static std::uint64_t inside(const Index* corners, const SumBlock& block) noexcept {
    const __m256i begin = _mm256_set1_epi32(static_cast<int>(block.begin));
    const __m256i last = _mm256_set1_epi32(static_cast<int>(block.size - 1));
    unsigned bits = 0;
    for (Index j = 0; j < kVectors; ++j) {
      const __m256i local = _mm256_sub_epi32(load_indices(corners + 8 * j), begin);
      const __m256i is_in = _mm256_cmpeq_epi32(_mm256_min_epu32(local, last), local);
      bits |= static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(is_in))) << 8 * j;
    }
    return bits;
  }
  [[gnu::always_inline]] static bool is_among(const Index* corners, Index v) noexcept {
    const __m256i wanted = _mm256_set1_epi32(static_cast<int>(v));
    __m256i any = _mm256_setzero_si256();
    for (Index j = 0; j < kVectors; ++j) {
      any = _mm256_or_si256(any, _mm256_cmpeq_epi32(load_indices(corners + 8 * j), wanted));
    }
    return _mm256_testz_si256(any, any) == 0;
  }
};

}  // namespace
}  // namespace hedgerow::kernels

#endif
