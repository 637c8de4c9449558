// Most faces of a run that straddles blocks have no corner in the block at hand: eight triangles
// are asked at once.

#include "kernels/corner_slots.h"

#if defined(__AVX2__)
#include <bit>
#include <cstdint>
#include <immintrin.h>
#endif

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

constexpr Index kGroup = 8;  // triangles
constexpr unsigned kAllCorners = (1U << 3 * kGroup) - 1;

// From a corner of the group to the next and the previous one of its triangle.
constexpr std::int8_t kToNext[] = {1, 1, -2, 1, 1, -2, 1, 1, -2, 1, 1, -2,
                                   1, 1, -2, 1, 1, -2, 1, 1, -2, 1, 1, -2};
constexpr std::int8_t kToPrevious[] = {2, -1, -1, 2, -1, -1, 2, -1, -1, 2, -1, -1,
                                       2, -1, -1, 2, -1, -1, 2, -1, -1, 2, -1, -1};

// Bit i: index i of the 24 lies in the block.
unsigned corners_in(const Index* c, __m256i begin, __m256i last) noexcept {
  unsigned mask = 0;
  for (int j = 0; j < 3; ++j) {
    const __m256i v = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(c + 8 * j));
    const __m256i local = _mm256_sub_epi32(v, begin);
    const __m256i inside = _mm256_cmpeq_epi32(_mm256_min_epu32(local, last), local);
    mask |= static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(inside))) << 8 * j;
  }
  return mask;
}

}  // namespace

void place_triangles_avx2(IndexRange range, const FaceColumns& faces, CornerSlots& slots) noexcept {
  CornerSlots to = slots;
  const __m256i begin = _mm256_set1_epi32(static_cast<int>(to.block.begin));
  const __m256i last = _mm256_set1_epi32(static_cast<int>(to.block.size - 1));
  Index f = range.begin;
  for (; f + kGroup <= range.end; f += kGroup) {
    const Index first = 3 * f;
    const Index* c = faces.corners + first;
    unsigned mask = corners_in(c, begin, last);
    if (mask == kAllCorners) {
      for_each_corner({f, f + kGroup}, faces,
                      [&](Index v, const Corner& corner) { add_corner(v, corner, to); });
      continue;
    }
    for (; mask != 0; mask &= mask - 1) {
      const auto i = static_cast<Index>(std::countr_zero(mask));
      const Index next = i + kToNext[i];
      const Index previous = i + kToPrevious[i];
      add_corner(c[i], {first + i, c[next], c[previous], first + previous}, to);
    }
  }
  slots.overflow_count = to.overflow_count;
  place_corners_scalar({f, range.end}, faces, slots);
}

#else

void place_triangles_avx2(IndexRange range, const FaceColumns& faces, CornerSlots& slots) noexcept {
  place_corners_scalar(range, faces, slots);
}

#endif

}  // namespace hedgerow::kernels
