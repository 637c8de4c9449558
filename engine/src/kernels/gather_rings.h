#pragma once

#include <cstdint>
#include <type_traits>

#include "kernels/gather_normals.h"
#include "kernels/index_lanes.h"
#include "kernels/normals_avx2.h"

#if defined(__AVX2__)

/// Vertices are lanes: they walk round their rings together, their lists of corners are sorted by
/// one network of minimum and maximum, and the first corners of all are added, then the second
/// ones, and so on. Several groups of lanes walk at once, as each step waits for memory.
///
/// `Lanes` says how wide a group is:
///
///   using Int, Float                                   of so many lanes; masks are `Int::Mask`
///   static Vec3<Float> from_rows(const __m128*)        rows x, y, z, w as lanes
///
/// Local to each source, as those are compiled for different processors.
namespace hedgerow::kernels {
namespace {

constexpr int kMostCorners = 8;
constexpr int kNone = 0x7fffffff;
constexpr int kInverseOfThree = static_cast<int>(0xaaaaaaab);

// Lane i of row r: a corner of vertex i; kNone behind the last.
template <class Int>
struct Rings {
  Int row[kMostCorners];
  typename Int::Mask is_left;  // more corners than rows
};

// Where 3 divides the number whose product with the inverse of 3 this is: Granlund, Montgomery,
// Division by Invariant Integers using Multiplication, 1994, section 9.
template <class Int>
typename Int::Mask is_multiple(Int product) noexcept {
  return smaller_unsigned(product, Int(0x55555555)) == product;
}

template <class Int>
Int next(Int h) noexcept {
  const Int after = h + Int(1);
  return select(is_multiple(after * Int(kInverseOfThree)), after - Int(3), after);
}

// The vertices of a group: in a row, or listed.
struct InRow {
  Index first;

  template <class Int>
  [[nodiscard]] Int starts(const Index* outgoing, int g) const noexcept {
    return Int::load(outgoing + first + g * Int::kLanes);
  }
  [[nodiscard]] Index vertex(int i) const noexcept { return first + i; }
};
struct Listed {
  const Index* ids;

  template <class Int>
  [[nodiscard]] Int starts(const Index* outgoing, int g) const noexcept {
    const Int all = Int::load(ids + g * Int::kLanes);
    return Int::gather(outgoing, all, all == all);
  }
  [[nodiscard]] Index vertex(int i) const noexcept { return ids[i]; }
};

template <class Int, int kGroups, class Place>
void walk(const Place& place, const TriangleView& mesh, Rings<Int> (&rings)[kGroups]) noexcept {
  using Mask = typename Int::Mask;
  Int start[kGroups];
  Int at[kGroups];
  Mask walks[kGroups];
  for (int g = 0; g < kGroups; ++g) {
    start[g] = place.template starts<Int>(mesh.outgoing.data(), g);
    at[g] = start[g];
    walks[g] = start[g] > Int(-1);
  }
  bool any = true;
  int r = 0;
  for (; r < kMostCorners && any; ++r) {
    any = false;
    for (int g = 0; g < kGroups; ++g) {
      rings[g].row[r] = select(walks[g], at[g], Int(kNone));
      const Int opposite = Int::gather(mesh.opposite.data(), at[g], walks[g]);
      at[g] = next(opposite);
      walks[g] = (walks[g] & (opposite > Int(-1))).without(at[g] == start[g]);
      any |= walks[g].any();
    }
  }
  for (; r < kMostCorners; ++r) {
    for (Rings<Int>& group : rings) group.row[r] = Int(kNone);
  }
  for (int g = 0; g < kGroups; ++g) rings[g].is_left = walks[g];
}

// Batcher's odd-even merge sort of eight, on all lanes; 19 exchanges.
template <class Int>
void sort_rows(Int* row) noexcept {
  constexpr int kPairs[19][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6},
                                 {5, 7}, {1, 2}, {5, 6}, {0, 4}, {1, 5}, {2, 6}, {3, 7},
                                 {2, 4}, {3, 5}, {1, 2}, {3, 4}, {5, 6}};
#pragma GCC unroll 19
  for (const auto& [a, b] : kPairs) {
    const Int low = smaller(row[a], row[b]);
    row[b] = larger(row[a], row[b]);
    row[a] = low;
  }
}

// The sums of a group of vertices, from the positions. Bit i of the result: lane i is unusual.
template <NormalWeight W, class Lanes, class Loader>
int add_rows(const Rings<typename Lanes::Int>& rings, const GatherInput& input,
             const Loader& loader, Vec3<typename Lanes::Float>& sum) noexcept {
  using Int = typename Lanes::Int;
  using Float = typename Lanes::Float;
  using Mask = typename Int::Mask;
  constexpr int kAll = (1 << Int::kLanes) - 1;
  int usual = kAll;
  sum = {Float(0.0f), Float(0.0f), Float(0.0f)};
  for (const Int& row : rings.row) {
    const Mask is_none = row == Int(kNone);
    if (is_none.all()) break;
    // Lanes without a corner repeat half-edge 0, which exists if any does.
    const Int h = select(is_none, Int(0), row);
    const Int product = h * Int(kInverseOfThree);
    const Mask is_first = is_multiple(product);
    const Mask is_third = is_multiple(product + Int(kInverseOfThree));
    const Int corner = select(is_first, Int(0), select(is_third, Int(2), Int(1)));
    const Int face = h - corner;
    // One group at most has the last face, but for faces round vertices of many groups.
    if ((face == Int(static_cast<int>(input.halfedge_count - 3))).any()) [[unlikely]]
      return kAll;
    Vec3<Float> p[3];
    loader.load(input.origin, face, p);
    TriangleTerms<Float> terms;
    const Mask is_usual_here = triangle_terms<W>(p[0], p[1], p[2], terms);
    usual &= is_usual_here.lanes() | is_none.lanes();
    const Vec3<Float> next_sum = sum + corner_term<W>(terms, is_first, is_third);
    sum = is_none.any() ? select(is_none, sum, next_sum) : next_sum;
  }
  return ~usual & kAll;
}

// The face of each half-edge: of the three numbers it can be, by where in its face the half-edge
// is, the wrong ones are not below a third of all numbers.
template <class Int>
Int face_of(Int h) noexcept {
  const Int inverse(kInverseOfThree);
  const Int first = h * inverse;
  const Int second = first - inverse;
  return smaller_unsigned(first, smaller_unsigned(second, second - inverse));
}

// Adds `count` rows for each vertex of a group, which lie so many bytes behind `rows`, in the order
// of the places.
template <class Lanes>
Vec3<typename Lanes::Float> add_places(const TermRow* rows, const int* places, int count) noexcept {
  constexpr int kLanes = Lanes::Int::kLanes;
  const auto* base = reinterpret_cast<const char*>(rows);
  __m128 sums[kLanes];
#pragma GCC unroll 16
  for (__m128& sum : sums) sum = _mm_setzero_ps();
  for (const int* p = places; p != places + count * kLanes; p += kLanes) {
#pragma GCC unroll 16
    for (int i = 0; i < kLanes; ++i) {
      const auto* row = reinterpret_cast<const float*>(base + static_cast<unsigned>(p[i]));
      sums[i] = _mm_add_ps(sums[i], _mm_load_ps(row));
    }
  }
  return Lanes::from_rows(sums);
}

// The same sums from a window, if that reaches all faces of these rings. The corners of a vertex
// are added as rows, one vertex after the other; lanes without a corner add zeros.
template <NormalWeight W, class Lanes>
bool add_from_window(const Rings<typename Lanes::Int>& rings, TermWindow& window,
                     const GatherInput& input, Vec3<typename Lanes::Float>& sum) noexcept {
  using Int = typename Lanes::Int;
  Int largest(0);
  int count = 0;
  for (; count < kMostCorners; ++count) {
    const auto is_none = rings.row[count] == Int(kNone);
    if (is_none.all()) break;
    largest = larger(largest, select(is_none, Int(0), rings.row[count]));
  }
  if (count == 0) return false;
  const int high = ~smallest_lane(Int(-1) - largest);
  if (!window.reach(smallest_lane(rings.row[0]) / 3, high / 3, Int::kLanes, input)) return false;

  alignas(64) int places[kMostCorners * Int::kLanes];
  const Int mask(static_cast<int>(window.capacity() - 1));
  const Int zero_row(static_cast<int>(window.zero_row()));
  for (int r = 0; r < count; ++r) {
    const Int h = rings.row[r];
    const Int face = face_of(h);
    Int row = face & mask;
    if constexpr (rows_of(W) == 3) {
      const Int turns = face - row;  // faces that wrap round as a whole
      row = h - (turns + turns + turns);
    }
    row = select(h == Int(kNone), zero_row, row);
    (row << 4).store(places + r * Int::kLanes);
  }
  sum = add_places<Lanes>(window.rows(), places, count);
  return true;
}

// Writes the lanes that are in `wanted` and have a direction; returns those that have none.
template <class Lanes, class Place>
unsigned write_units(const Place& place, int g, const Vec3<typename Lanes::Float>& sum,
                     unsigned wanted, const NormalWriter& writer, const Writer8& writer8) noexcept {
  using Float = typename Lanes::Float;
  constexpr int kLanes = Lanes::Int::kLanes;
  const Float square = dot(sum, sum);
  const unsigned good = wanted & static_cast<unsigned>(is_usual(square).lanes());
  const Vec3<Float> unit = sum * (Float(1.0f) / square_root(square));
  if constexpr (std::is_same_v<Place, InRow>) {
    if (good == (1U << kLanes) - 1) [[likely]] {
      write(writer8, place.vertex(g * kLanes), unit);
      return 0;
    }
  }
  alignas(64) float lanes[3][kLanes];
  unit.x.store(lanes[0]);
  unit.y.store(lanes[1]);
  unit.z.store(lanes[2]);
  for (int i = 0; i < kLanes; ++i) {
    if ((good >> i & 1) == 0) continue;
    writer.write(place.vertex(g * kLanes + i), {lanes[0][i], lanes[1][i], lanes[2][i]});
  }
  return wanted & ~good;
}

// `gather_group_avx2` for kGroups groups.
template <NormalWeight W, class Lanes, int kGroups, class Place, class Loader>
std::uint64_t gather_rings(const Place& place, std::uint64_t wanted, const TriangleView& mesh,
                           const GatherInput& input, TermWindow& window, const Loader& loader,
                           const NormalWriter& writer) noexcept {
  using Int = typename Lanes::Int;
  Rings<Int> rings[kGroups];
  walk(place, mesh, rings);
  std::uint64_t left = 0;
  const Writer8 writer8(writer, place.vertex(0));
  for (int g = 0; g < kGroups; ++g) {
    sort_rows(rings[g].row);
    Vec3<typename Lanes::Float> sum;
    const bool is_added =
        window.capacity() > 0 && add_from_window<W, Lanes>(rings[g], window, input, sum);
    const int unusual = is_added ? 0 : add_rows<W, Lanes>(rings[g], input, loader, sum);
    const auto hard = static_cast<unsigned>(unusual | rings[g].is_left.lanes());
    const auto here = static_cast<unsigned>(wanted >> g * Int::kLanes) & ((1U << Int::kLanes) - 1);
    const unsigned flat = write_units<Lanes>(place, g, sum, here & ~hard, writer, writer8);
    left |= std::uint64_t{(here & hard) | flat} << g * Int::kLanes;
  }
  return left;
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
