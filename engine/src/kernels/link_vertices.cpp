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

// A closed fan: one rotation from the first corner meets all of them and comes back. Each step
// writes the opposite of the half-edge it leaves, so a vertex where the rotation fails has been
// scribbled on; it owns what was written and is linked again.
template <class Match>
bool link_closed(const Match& match, const Corner* corners, Index k, Index* opposite) noexcept {
  Index i = 0;
  for (Index step = 1; step <= k; ++step) {
    const unsigned mask = match.followers(corners[i].target);
    if (mask == 0 || (mask & (mask - 1)) != 0) return false;
    const auto j = static_cast<Index>(std::countr_zero(mask));
    opposite[corners[i].halfedge] = corners[j].incoming;
    i = j;
    if (i == 0) return step == k;
  }
  return false;
}

// An open fan: all targets but one are the source of exactly one corner, all sources but one are
// met, and the chain from the corner that follows none meets all of them.
template <class Match>
bool link_open(const Match& match, const Corner* corners, Index k, Index* opposite,
               Index& outgoing) noexcept {
  std::uint8_t follower[kSmallValence];
  unsigned followed = 0;
  Index end_count = 0;
  for (Index i = 0; i < k; ++i) {
    const unsigned mask = match.followers(corners[i].target);
    if ((mask & (mask - 1)) != 0) return false;
    end_count += mask == 0;
    followed |= mask;
    follower[i] = static_cast<std::uint8_t>(std::countr_zero(mask | 1U << kSmallValence));
  }
  const unsigned starts = ((1U << k) - 1) & ~followed;
  if (end_count != 1 || (starts & (starts - 1)) != 0) return false;
  const auto start = static_cast<Index>(std::countr_zero(starts));
  Index length = 0;
  for (Index i = start; i != kSmallValence; i = follower[i]) ++length;
  if (length != k) return false;

  for (Index i = 0; i < k; ++i) {
    opposite[corners[i].halfedge] =
        follower[i] == kSmallValence ? kInvalidIndex : corners[follower[i]].incoming;
  }
  outgoing = corners[start].halfedge;
  return true;
}

// One vertex. False: not one fan; `outgoing` was not written. A closed fan of two corners is a face
// on both sides of another: left to the general path, which looks for duplicate faces.
template <class Match>
bool link_vertex(const Corner* corners, Index k, Index* opposite, Index& outgoing,
                 LinkStats& stats) noexcept {
  const Match match(corners, k);
  if (k > 2 && link_closed(match, corners, k, opposite)) {
    outgoing = corners[0].halfedge;
    stats.paired_count += k;
    return true;
  }
  if (!link_open(match, corners, k, opposite, outgoing)) return false;
  stats.paired_count += k - 1;
  ++stats.boundary_count;
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
