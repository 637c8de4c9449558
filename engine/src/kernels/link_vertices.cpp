#include "kernels/link_vertices.h"

#include <bit>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace hedgerow::kernels {

namespace {

// The corners whose source is `target`, as a bit set over the k corners of one vertex.
struct ScalarMatch {
  const Corner* corners;
  Index k;

  ScalarMatch(const Corner* c, Index count) noexcept : corners(c), k(count) {}
  [[nodiscard]] unsigned followers(Index target) const noexcept {
    unsigned mask = 0;
    for (Index j = 0; j < k; ++j) {
      mask |= static_cast<unsigned>(corners[j].source == target) << j;
    }
    return mask;
  }
};

#if defined(__SSE2__)
// The same with the sources of sixteen corners in four registers; the lanes behind the last corner
// hold whatever follows it and are masked out.
struct SseMatch {
  __m128i source[4];
  unsigned valid;
  bool small;

  static __m128i sources_of(const Corner* c) noexcept {
    const auto* r = reinterpret_cast<const __m128i*>(c);
    const __m128i s01 = _mm_unpackhi_epi32(_mm_loadu_si128(r), _mm_loadu_si128(r + 1));
    const __m128i s23 = _mm_unpackhi_epi32(_mm_loadu_si128(r + 2), _mm_loadu_si128(r + 3));
    return _mm_unpacklo_epi64(s01, s23);
  }
  SseMatch(const Corner* c, Index k) noexcept : valid((1U << k) - 1), small(k <= 8) {
    source[0] = sources_of(c);
    source[1] = sources_of(c + 4);
    source[2] = small ? source[0] : sources_of(c + 8);
    source[3] = small ? source[0] : sources_of(c + 12);
  }
  [[nodiscard]] unsigned followers(Index target) const noexcept {
    const __m128i t = _mm_set1_epi32(static_cast<int>(target));
    const __m128i low =
        _mm_packs_epi32(_mm_cmpeq_epi32(t, source[0]), _mm_cmpeq_epi32(t, source[1]));
    if (small) {
      const __m128i bytes = _mm_packs_epi16(low, low);
      return static_cast<unsigned>(_mm_movemask_epi8(bytes)) & valid;
    }
    const __m128i high =
        _mm_packs_epi32(_mm_cmpeq_epi32(t, source[2]), _mm_cmpeq_epi32(t, source[3]));
    return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(low, high))) & valid;
  }
};
#endif

// One vertex. False: not one fan; nothing was written.
template <class Match>
bool link_vertex(const Corner* corners, Index k, Index* opposite, Index& outgoing,
                 LinkStats& stats) noexcept {
  const Match match(corners, k);
  std::uint8_t follower[kSmallValence];
  unsigned followed = 0;
  Index open_count = 0;
  bool several = false;
  for (Index i = 0; i < k; ++i) {
    const unsigned mask = match.followers(corners[i].target);
    several |= (mask & (mask - 1)) != 0;
    open_count += mask == 0;
    followed |= mask;
    follower[i] = static_cast<std::uint8_t>(std::countr_zero(mask | 1U << kSmallValence));
  }
  if (several || open_count > 1 || std::popcount(followed) != k - open_count) return false;

  // A closed fan of two corners is a face on both sides of another: left to the general path, which
  // looks for duplicate faces.
  if (open_count == 0 && k == 2) return false;
  const Index start = open_count == 0 ? 0 : static_cast<Index>(std::countr_one(followed));
  Index length = 1;
  for (Index i = follower[start]; i != start && i != kSmallValence; i = follower[i]) ++length;
  if (length != k) return false;

  for (Index i = 0; i < k; ++i) {
    opposite[corners[i].halfedge] =
        follower[i] == kSmallValence ? kInvalidIndex : corners[follower[i]].incoming;
  }
  outgoing = corners[start].halfedge;
  stats.paired_count += k - open_count;
  stats.boundary_count += open_count;
  return true;
}

template <class Match>
LinkStats link_all(VertexBlock block, const Index* ends, const Corner* corners, Index* opposite,
                   Index* outgoing, Index* irregular) noexcept {
  LinkStats stats;
  Index begin = 0;
  for (Index i = 0; i < block.size; ++i) {
    const Index k = ends[i] - begin;
    const bool linked =
        k > 0 && k <= kSmallValence &&
        link_vertex<Match>(corners + begin, k, opposite, outgoing[block.begin + i], stats);
    if (!linked) irregular[stats.irregular_count++] = block.begin + i;
    stats.step_count += k <= kSmallValence ? k + k * k : k;
    begin = ends[i];
  }
  return stats;
}

}  // namespace

LinkStats link_vertices_scalar(VertexBlock block, const Index* ends, const Corner* corners,
                               Index* opposite, Index* outgoing, Index* irregular) noexcept {
  return link_all<ScalarMatch>(block, ends, corners, opposite, outgoing, irregular);
}

LinkStats link_vertices(VertexBlock block, const Index* ends, const Corner* corners,
                        Index* opposite, Index* outgoing, Index* irregular) noexcept {
#if defined(__SSE2__)
  if constexpr (sizeof(Index) == 4) {
    return link_all<SseMatch>(block, ends, corners, opposite, outgoing, irregular);
  }
#endif
  return link_vertices_scalar(block, ends, corners, opposite, outgoing, irregular);
}

}  // namespace hedgerow::kernels
