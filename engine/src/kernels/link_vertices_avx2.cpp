// The up to eight corners of a vertex are eight lanes. Nothing below depends on how many they are,
// so vertices of mixed valence cost no mispredicted branch: empty lanes have a source that equals
// no target, and store what the first lane stores once more.

#include "kernels/link_vertices.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

constexpr int kLanes = 8;

inline __m256i load(const Index* p) noexcept {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(p));
}

// Lane i: 16 + j if source j alone equals target i; below 16 if none does, 32 and above if several.
inline __m256i followers(const CornerSlot& slot) noexcept {
  const __m256i target = load(slot.target);
  __m256i sum = _mm256_setzero_si256();
  for (int j = 0; j < kLanes; ++j) {
    const __m256i source = _mm256_set1_epi32(static_cast<int>(slot.source[j]));
    const __m256i equal = _mm256_cmpeq_epi32(target, source);
    sum = _mm256_add_epi32(sum, _mm256_and_si256(equal, _mm256_set1_epi32(16 + j)));
  }
  return sum;
}

// Bit i: i + 1 steps of the rotation from lane 0 lead back to it. `follower` holds 16 + lane;
// a permutation reads only the lane. Steps are composed: 1, then 2, then 4 at a time.
inline unsigned returns(__m256i follower) noexcept {
  const __m256i two = _mm256_permutevar8x32_epi32(follower, follower);
  const __m256i four = _mm256_permutevar8x32_epi32(two, two);
  __m256i at = _mm256_broadcastd_epi32(_mm256_castsi256_si128(follower));
  at = _mm256_blend_epi32(at, _mm256_permutevar8x32_epi32(follower, at), 0xaa);
  at = _mm256_blend_epi32(at, _mm256_permutevar8x32_epi32(two, at), 0xcc);
  at = _mm256_blend_epi32(at, _mm256_permutevar8x32_epi32(four, at), 0xf0);
  const __m256i home = _mm256_cmpeq_epi32(at, _mm256_set1_epi32(16));
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(home)));
}

inline bool link_closed(const CornerSlot& slot, Index k, Index* opposite) noexcept {
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i used = _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(k)), lane);
  const __m256i follower = followers(slot);
  const __m256i single = _mm256_cmpeq_epi32(_mm256_srli_epi32(follower, 4), _mm256_set1_epi32(1));
  if (_mm256_testc_si256(single, used) == 0) return false;
  const unsigned last = 1U << (k - 1);
  if ((returns(follower) & (2 * last - 1)) != last) return false;

  const __m256i first = _mm256_setzero_si256();
  const __m256i from = _mm256_and_si256(used, lane);
  const __m256i halfedge = _mm256_permutevar8x32_epi32(load(slot.halfedge), from);
  const __m256i incoming = _mm256_permutevar8x32_epi32(load(slot.incoming), follower);
  const __m256i across =
      _mm256_blendv_epi8(_mm256_permutevar8x32_epi32(incoming, first), incoming, used);
  alignas(32) int to[kLanes];
  alignas(32) int value[kLanes];
  _mm256_store_si256(reinterpret_cast<__m256i*>(to), halfedge);
  _mm256_store_si256(reinterpret_cast<__m256i*>(value), across);
  for (int i = 0; i < kLanes; ++i) opposite[to[i]] = value[i];
  return true;
}

}  // namespace

LinkStats link_vertices_avx2(const CornerSlots& slots, Index* opposite, Index* outgoing,
                             Index* irregular) noexcept {
  LinkStats stats;
  for (Index i = 0; i < slots.block.size; ++i) {
    const Index k = slots.count[i];
    stats.step_count += k;
    if (k > 2 && k <= CornerSlot::kCapacity && link_closed(slots.slot[i], k, opposite)) {
      outgoing[slots.block.begin + i] = slots.slot[i].halfedge[0];
      stats.paired_count += k;
      stats.step_count += k * k;
    } else {
      irregular[stats.irregular_count++] = slots.block.begin + i;
    }
  }
  return stats;
}

#else

LinkStats link_vertices_avx2(const CornerSlots& slots, Index* opposite, Index* outgoing,
                             Index* irregular) noexcept {
  return link_vertices_scalar(slots, opposite, outgoing, irregular);
}

#endif

}  // namespace hedgerow::kernels
