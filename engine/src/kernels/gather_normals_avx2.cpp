// Eight vertices are eight lanes: they walk round their rings together, their lists of corners are
// sorted by one network of minimum and maximum, and the first corners of all are added, then the
// second ones, and so on. Several such groups walk at once, as each step waits for memory.

#include <type_traits>

#include "kernels/gather_normals.h"
#include "kernels/normals_avx2.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

constexpr int kLanes = 8;
constexpr int kGroups = kGroupSize / kLanes;
constexpr int kMostCorners = 8;

// Lane i of row r: a corner of vertex i; kNone behind the last.
struct Rings {
  __m256i row[kMostCorners];
  __m256i is_left;  // more corners than rows
};
const int kNone = 0x7fffffff;

__m256i gather(const Index* from, __m256i at, __m256i where) noexcept {
  return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), reinterpret_cast<const int*>(from), at,
                                     where, 4);
}

// -1 where 3 divides the number whose product with the inverse of 3 this is: Granlund, Montgomery,
// Division by Invariant Integers using Multiplication, 1994, section 9.
__m256i is_multiple(__m256i product) noexcept {
  const __m256i limit = _mm256_set1_epi32(0x55555555);
  return _mm256_cmpeq_epi32(_mm256_min_epu32(product, limit), product);
}
__m256i times_inverse(__m256i h) noexcept {
  return _mm256_mullo_epi32(h, _mm256_set1_epi32(static_cast<int>(0xaaaaaaab)));
}

__m256i next(__m256i h) noexcept {
  const __m256i one = _mm256_set1_epi32(1);
  const __m256i after = _mm256_add_epi32(h, one);
  const __m256i wraps = is_multiple(times_inverse(after));
  return _mm256_sub_epi32(after, _mm256_and_si256(wraps, _mm256_set1_epi32(3)));
}

// The vertices of a group: in a row, or listed.
struct InRow {
  Index first;

  [[nodiscard]] __m256i starts(const Index* outgoing, int g) const noexcept {
    return load_indices(outgoing + first + g * kLanes);
  }
  [[nodiscard]] Index vertex(int i) const noexcept { return first + i; }
  void write(int g, const Vec3<Float8>& units, const Writer8& writer8) const noexcept {
    writer8.write(first + g * kLanes, units);
  }
};
struct Listed {
  const Index* ids;

  [[nodiscard]] __m256i starts(const Index* outgoing, int g) const noexcept {
    return gather(outgoing, load_indices(ids + g * kLanes), _mm256_set1_epi32(-1));
  }
  [[nodiscard]] Index vertex(int i) const noexcept { return ids[i]; }
};

template <class Place>
void walk(const Place& place, const TriangleView& mesh, Rings (&rings)[kGroups]) noexcept {
  const __m256i none = _mm256_set1_epi32(kNone);
  __m256i start[kGroups];
  __m256i at[kGroups];
  __m256i walks[kGroups];
  for (int g = 0; g < kGroups; ++g) {
    start[g] = place.starts(mesh.outgoing.data(), g);
    at[g] = start[g];
    walks[g] = _mm256_cmpgt_epi32(start[g], _mm256_set1_epi32(-1));
  }
  __m256i any = none;
  int r = 0;
  for (; r < kMostCorners && _mm256_testz_si256(any, any) == 0; ++r) {
    any = _mm256_setzero_si256();
    for (int g = 0; g < kGroups; ++g) {
      rings[g].row[r] = _mm256_blendv_epi8(none, at[g], walks[g]);
      const __m256i opposite = gather(mesh.opposite.data(), at[g], walks[g]);
      at[g] = next(opposite);
      const __m256i has_opposite = _mm256_cmpgt_epi32(opposite, _mm256_set1_epi32(-1));
      const __m256i is_back = _mm256_cmpeq_epi32(at[g], start[g]);
      walks[g] = _mm256_and_si256(walks[g], _mm256_andnot_si256(is_back, has_opposite));
      any = _mm256_or_si256(any, walks[g]);
    }
  }
  for (; r < kMostCorners; ++r) {
    for (Rings& eight : rings) eight.row[r] = none;
  }
  for (int g = 0; g < kGroups; ++g) rings[g].is_left = walks[g];
}

// Batcher's odd-even merge sort of eight, on all lanes; 19 exchanges.
void sort_rows(__m256i* row) noexcept {
  constexpr int kPairs[19][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6},
                                 {5, 7}, {1, 2}, {5, 6}, {0, 4}, {1, 5}, {2, 6}, {3, 7},
                                 {2, 4}, {3, 5}, {1, 2}, {3, 4}, {5, 6}};
#pragma GCC unroll 19
  for (const auto& [a, b] : kPairs) {
    const __m256i low = _mm256_min_epi32(row[a], row[b]);
    row[b] = _mm256_max_epi32(row[a], row[b]);
    row[a] = low;
  }
}

// The sums of eight vertices. Bit i of the result: lane i is unusual.
template <NormalWeight W, class Loader>
int add_rows(const Rings& rings, const GatherInput& input, const Loader& loader,
             Vec3<Float8>& sum) noexcept {
  const __m256i none = _mm256_set1_epi32(kNone);
  const __m256i last_face = _mm256_set1_epi32(static_cast<int>(input.halfedge_count - 3));
  int usual = 0xff;
  sum = {Float8(0.0f), Float8(0.0f), Float8(0.0f)};
  for (const __m256i& row : rings.row) {
    const __m256i is_none = _mm256_cmpeq_epi32(row, none);
    if (_mm256_movemask_epi8(is_none) == -1) break;
    // Lanes without a corner repeat half-edge 0, which exists if any does.
    const __m256i h = _mm256_andnot_si256(is_none, row);
    const __m256i product = times_inverse(h);
    const __m256i is_first = is_multiple(product);
    const __m256i is_third =
        is_multiple(_mm256_add_epi32(product, _mm256_set1_epi32(static_cast<int>(0xaaaaaaab))));
    const __m256i corner =
        _mm256_sub_epi32(_mm256_add_epi32(_mm256_set1_epi32(1), is_first), is_third);
    const __m256i face = _mm256_sub_epi32(h, corner);
    // One group at most has the last face, but for faces round vertices of many groups.
    const __m256i is_last = _mm256_cmpeq_epi32(face, last_face);
    if (_mm256_movemask_epi8(is_last) != 0) [[unlikely]]
      return 0xff;
    Vec3<Float8> p[3];
    loader.load(input.origin, face, p);
    TriangleTerms<Float8> terms;
    const Mask8 is_usual_here = triangle_terms<W>(p[0], p[1], p[2], terms);
    const Mask8 skip{_mm256_castsi256_ps(is_none)};
    usual &= is_usual_here.lanes() | skip.lanes();
    const Vec3<Float8> next_sum = sum + corner_term<W>(terms, Mask8{_mm256_castsi256_ps(is_first)},
                                                       Mask8{_mm256_castsi256_ps(is_third)});
    sum = skip.lanes() == 0 ? next_sum : select(skip, sum, next_sum);
  }
  return ~usual & 0xff;
}

// The face of each half-edge: of the three numbers it can be, by where in its face the half-edge
// is, the wrong ones are not below a third of all numbers.
__m256i face_of(__m256i h) noexcept {
  const __m256i inverse = times_inverse(_mm256_set1_epi32(1));
  const __m256i first = times_inverse(h);
  const __m256i second = _mm256_sub_epi32(first, inverse);
  const __m256i third = _mm256_sub_epi32(second, inverse);
  return _mm256_min_epu32(first, _mm256_min_epu32(second, third));
}

int smallest_lane(__m256i v) noexcept {
  __m128i half = _mm_min_epi32(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
  half = _mm_min_epi32(half, _mm_shuffle_epi32(half, 0x4e));
  return _mm_cvtsi128_si32(_mm_min_epi32(half, _mm_shuffle_epi32(half, 0xb1)));
}

// Adds `count` rows for each of eight vertices, which lie so many bytes behind `rows`, in the order
// of the places.
Vec3<Float8> add_places(const TermRow* rows, const int* places, int count) noexcept {
  const auto* base = reinterpret_cast<const char*>(rows);
  __m128 s0 = _mm_setzero_ps();
  __m128 s1 = s0, s2 = s0, s3 = s0, s4 = s0, s5 = s0, s6 = s0, s7 = s0;
  for (const int* p = places; p != places + count * kLanes; p += kLanes) {
    const auto add = [&](__m128& to, int i) {
      const auto* row = reinterpret_cast<const float*>(base + static_cast<unsigned>(p[i]));
      to = _mm_add_ps(to, _mm_load_ps(row));
    };
    add(s0, 0), add(s1, 1), add(s2, 2), add(s3, 3);
    add(s4, 4), add(s5, 5), add(s6, 6), add(s7, 7);
  }
  const auto pair = [](__m128 low, __m128 high) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1);
  };
  return to_lanes(pair(s0, s4), pair(s1, s5), pair(s2, s6), pair(s3, s7));
}

// The same from a window, if that reaches all faces of these rings. The corners of a vertex are
// added as rows, one vertex after the other; lanes without a corner add zeros.
template <NormalWeight W>
bool add_from_window(const Rings& rings, TermWindow& window, const GatherInput& input,
                     Vec3<Float8>& sum) noexcept {
  const __m256i none = _mm256_set1_epi32(kNone);
  __m256i largest = _mm256_setzero_si256();
  int count = 0;
  for (; count < kMostCorners; ++count) {
    const __m256i is_none = _mm256_cmpeq_epi32(rings.row[count], none);
    if (_mm256_movemask_epi8(is_none) == -1) break;
    largest = _mm256_max_epi32(largest, _mm256_andnot_si256(is_none, rings.row[count]));
  }
  if (count == 0) return false;
  const int high = ~smallest_lane(_mm256_xor_si256(largest, _mm256_set1_epi32(-1)));
  if (!window.reach(smallest_lane(rings.row[0]) / 3, high / 3, kLanes, input)) return false;

  alignas(32) int places[kMostCorners * kLanes];
  const __m256i mask = _mm256_set1_epi32(static_cast<int>(window.capacity() - 1));
  const __m256i zero_row = _mm256_set1_epi32(static_cast<int>(window.zero_row()));
  for (int r = 0; r < count; ++r) {
    const __m256i h = rings.row[r];
    const __m256i face = face_of(h);
    __m256i row = _mm256_and_si256(face, mask);
    if constexpr (rows_of(W) == 3) {
      const __m256i turns = _mm256_andnot_si256(mask, face);  // faces that wrap round as a whole
      row = _mm256_sub_epi32(h, _mm256_add_epi32(_mm256_add_epi32(turns, turns), turns));
    }
    row = _mm256_blendv_epi8(row, zero_row, _mm256_cmpeq_epi32(h, none));
    _mm256_store_si256(reinterpret_cast<__m256i*>(places + r * kLanes), _mm256_slli_epi32(row, 4));
  }
  sum = add_places(window.rows(), places, count);
  return true;
}

// Writes the lanes that are in `wanted` and have a direction; returns those that have none.
template <class Place>
unsigned write_units(const Place& place, int g, const Vec3<Float8>& sum, unsigned wanted,
                     const NormalWriter& writer, const Writer8& writer8) noexcept {
  const Float8 square = dot(sum, sum);
  const unsigned good = wanted & static_cast<unsigned>(is_usual(square).lanes());
  const Vec3<Float8> unit = sum * (Float8(1.0f) / square_root(square));
  if constexpr (std::is_same_v<Place, InRow>) {
    if (good == 0xff) [[likely]] {
      place.write(g, unit, writer8);
      return 0;
    }
  }
  const Rows8 rows = to_rows(unit, 0);
  for (int i = 0; i < kLanes; ++i) {
    alignas(16) float xyz[4];
    _mm_store_ps(xyz, rows.row[i]);
    if ((good >> i & 1) != 0) {
      writer.write(place.vertex(g * kLanes + i), {xyz[0], xyz[1], xyz[2]});
    }
  }
  return wanted & ~good;
}

template <NormalWeight W, class Place, class Loader>
unsigned gather_group(const Place& place, unsigned wanted, const TriangleView& mesh,
                      const GatherInput& input, TermWindow& window, const Loader& loader,
                      const NormalWriter& writer) noexcept {
  Rings rings[kGroups];
  walk(place, mesh, rings);
  unsigned left = 0;
  const Writer8 writer8(writer, place.vertex(0));
  for (int g = 0; g < kGroups; ++g) {
    sort_rows(rings[g].row);
    Vec3<Float8> sum;
    const bool is_added = window.capacity() > 0 && add_from_window<W>(rings[g], window, input, sum);
    const int unusual = is_added ? 0 : add_rows<W>(rings[g], input, loader, sum);
    const auto large =
        static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(rings[g].is_left)));
    const unsigned here = wanted >> g * kLanes & 0xff;
    const unsigned simple = here & ~(static_cast<unsigned>(unusual) | large);
    const unsigned flat = write_units(place, g, sum, simple, writer, writer8);
    left |= ((here & ~simple) | flat) << g * kLanes;
  }
  return left;
}

}  // namespace

template <NormalWeight W>
unsigned gather_group_avx2(Index first, unsigned wanted, const TriangleView& mesh,
                           const GatherInput& input, TermWindow& window,
                           const NormalWriter& writer) noexcept {
  return with_loader(input.points, [&](const auto& loader) {
    return gather_group<W>(InRow{first}, wanted, mesh, input, window, loader, writer);
  });
}

template <NormalWeight W>
unsigned gather_listed_avx2(const Index* ids, unsigned wanted, const TriangleView& mesh,
                            const GatherInput& input, const NormalWriter& writer) noexcept {
  TermWindow none;
  return with_loader(input.points, [&](const auto& loader) {
    return gather_group<W>(Listed{ids}, wanted, mesh, input, none, loader, writer);
  });
}

#else

template <NormalWeight W>
unsigned gather_group_avx2(Index, unsigned wanted, const TriangleView&, const GatherInput&,
                           TermWindow&, const NormalWriter&) noexcept {
  return wanted;
}

template <NormalWeight W>
unsigned gather_listed_avx2(const Index*, unsigned wanted, const TriangleView&, const GatherInput&,
                            const NormalWriter&) noexcept {
  return wanted;
}

#endif

template unsigned gather_group_avx2<NormalWeight::uniform>(Index, unsigned, const TriangleView&,
                                                           const GatherInput&, TermWindow&,
                                                           const NormalWriter&) noexcept;
template unsigned gather_group_avx2<NormalWeight::area>(Index, unsigned, const TriangleView&,
                                                        const GatherInput&, TermWindow&,
                                                        const NormalWriter&) noexcept;
template unsigned gather_group_avx2<NormalWeight::angle>(Index, unsigned, const TriangleView&,
                                                         const GatherInput&, TermWindow&,
                                                         const NormalWriter&) noexcept;
template unsigned gather_group_avx2<NormalWeight::max>(Index, unsigned, const TriangleView&,
                                                       const GatherInput&, TermWindow&,
                                                       const NormalWriter&) noexcept;

template unsigned gather_listed_avx2<NormalWeight::uniform>(const Index*, unsigned,
                                                            const TriangleView&, const GatherInput&,
                                                            const NormalWriter&) noexcept;
template unsigned gather_listed_avx2<NormalWeight::area>(const Index*, unsigned,
                                                         const TriangleView&, const GatherInput&,
                                                         const NormalWriter&) noexcept;
template unsigned gather_listed_avx2<NormalWeight::angle>(const Index*, unsigned,
                                                          const TriangleView&, const GatherInput&,
                                                          const NormalWriter&) noexcept;
template unsigned gather_listed_avx2<NormalWeight::max>(const Index*, unsigned, const TriangleView&,
                                                        const GatherInput&,
                                                        const NormalWriter&) noexcept;

}  // namespace hedgerow::kernels
