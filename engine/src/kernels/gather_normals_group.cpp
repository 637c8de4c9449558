// The plain form of walking in groups: sixteen vertices take each step together, so that their
// loads are under way at the same time, and their lists of corners are sorted by one network.

#include <algorithm>
#include <limits>
#include <type_traits>

#include "kernels/gather_normals.h"

namespace hedgerow::kernels {

namespace {

constexpr int kLanes = 16;
constexpr int kMostCorners = 8;
using Lanes = Index[kLanes];

// corner[r][i]: a corner of vertex i; kNoCorner behind the last. Bit i of the result: vertex i has
// more.
unsigned walk(Index first, const TriangleView& mesh, Lanes (&corner)[kMostCorners]) noexcept {
  using Unsigned = std::make_unsigned_t<Index>;
  constexpr Unsigned kThird = std::numeric_limits<Unsigned>::max() / 3;
  constexpr Unsigned kInverse = 2 * kThird + 1;  // of 3
  const Index* outgoing = mesh.outgoing.data() + first;
  const Index* opposite = mesh.opposite.data();
  Lanes at;
  std::copy_n(outgoing, kLanes, at);
  Index any = 0;  // below 0: no vertex walks any more
  for (Lanes& row : corner) {
    if (any < 0) {
      std::fill_n(row, kLanes, kNoCorner);
      continue;
    }
    any = kInvalidIndex;
    for (int i = 0; i < kLanes; ++i) {
      const Index h = at[i];
      row[i] = h < 0 ? kNoCorner : h;
      const Index o = opposite[h < 0 ? 0 : h];
      // As in is_multiple of the wide form: the half-edge behind the third of a face is its first.
      const auto after = static_cast<Unsigned>(o) + 1;
      const auto next = static_cast<Index>(after * kInverse <= kThird ? after - 3 : after);
      const bool is_over = (h < 0) | (o < 0) | (next == outgoing[i]);
      at[i] = is_over ? kInvalidIndex : next;
      any &= at[i];
    }
  }
  unsigned more = 0;
  for (int i = 0; i < kLanes; ++i) more |= static_cast<unsigned>(at[i] >= 0) << i;
  return more;
}

// Puts the smaller of each pair into `a`. As vectors of the compiler: it unrolls a loop over the
// lanes before it would make vectors of them.
void exchange(Lanes& a, Lanes& b) noexcept {
  using Vector [[gnu::vector_size(16), gnu::may_alias]] = Index;
  constexpr int kVectors = kLanes / (16 / int{sizeof(Index)});
  auto* low = reinterpret_cast<Vector*>(a);
  auto* high = reinterpret_cast<Vector*>(b);
  for (int i = 0; i < kVectors; ++i) {
    const Vector x = low[i];
    const Vector y = high[i];
    low[i] = x < y ? x : y;
    high[i] = x < y ? y : x;
  }
}

// Batcher's odd-even merge sort of eight, on all lanes.
void sort_lanes(Lanes (&corner)[kMostCorners]) noexcept {
  constexpr int kPairs[19][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6},
                                 {5, 7}, {1, 2}, {5, 6}, {0, 4}, {1, 5}, {2, 6}, {3, 7},
                                 {2, 4}, {3, 5}, {1, 2}, {3, 4}, {5, 6}};
  for (const auto& [a, b] : kPairs) exchange(corner[a], corner[b]);
}

}  // namespace

template <NormalWeight W>
std::uint64_t gather_group_plain(Index first, Index size, std::uint64_t wanted,
                                 const TriangleView& mesh, const GatherInput& input,
                                 TermWindow& window, const NormalWriter& writer) noexcept {
  std::uint64_t left = 0;
  for (int begin = 0; begin < static_cast<int>(size); begin += kLanes) {
    alignas(64) Lanes corner[kMostCorners];
    const unsigned more = walk(first + begin, mesh, corner);
    sort_lanes(corner);
    for (int i = 0; i < kLanes; ++i) {
      const std::uint64_t bit = std::uint64_t{1} << (begin + i);
      if ((wanted & bit) == 0) continue;
      Index ids[kMostCorners + 3];  // three more, for the last group of four
      Index* end = ids;
      for (int r = 0; r < kMostCorners && corner[r][i] != kNoCorner; ++r) *end++ = corner[r][i];
      *end = kNoCorner;
      Float3 sum{0, 0, 0};
      if (!add_from_window<W>(ids, end, input, window, sum) && end != ids) {
        sum = add_triangle_corners_sse<W>(sum, ids, static_cast<Index>(end - ids), input);
      }
      Float3 unit;
      const bool is_done = (more >> i & 1) == 0 && normalise(sum, unit);
      if (is_done) {
        writer.write(first + begin + i, unit);
      } else {
        left |= bit;
      }
    }
  }
  return left;
}

template std::uint64_t gather_group_plain<NormalWeight::uniform>(Index, Index, std::uint64_t,
                                                                 const TriangleView&,
                                                                 const GatherInput&, TermWindow&,
                                                                 const NormalWriter&) noexcept;
template std::uint64_t gather_group_plain<NormalWeight::area>(Index, Index, std::uint64_t,
                                                              const TriangleView&,
                                                              const GatherInput&, TermWindow&,
                                                              const NormalWriter&) noexcept;
template std::uint64_t gather_group_plain<NormalWeight::angle>(Index, Index, std::uint64_t,
                                                               const TriangleView&,
                                                               const GatherInput&, TermWindow&,
                                                               const NormalWriter&) noexcept;
template std::uint64_t gather_group_plain<NormalWeight::max>(Index, Index, std::uint64_t,
                                                             const TriangleView&,
                                                             const GatherInput&, TermWindow&,
                                                             const NormalWriter&) noexcept;

}  // namespace hedgerow::kernels
