#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "hedgerow/positions.h"
#include "hedgerow/topology.h"
#include "kernels/radial_angle.h"
#include "kernels/radix.h"

/// The cycles of half-edges round edges, in phases. "Loose" is a half-edge of a face with no face
/// across; the loose ones are sorted by the two vertices of their edges, and then by id, so that
/// those of one edge are a run. A run belongs to the range that it starts in, and is followed past
/// its end: ranges that partition the runs write the entries of different half-edges.
namespace hedgerow::kernels {

/// The smaller and the larger vertex of the edge of `h`.
template <Topology Mesh>
[[nodiscard]] std::pair<Index, Index> edge_ends(const Mesh& mesh, HalfedgeId h) noexcept {
  const Index a = mesh.origin[h].value;
  const Index b = mesh.target(h).value;
  return {std::min(a, b), std::max(a, b)};
}

/// Default form: `opposite`, or the half-edge itself where it has none; returns how many those are.
/// Each element is written from its own. Reads 4 bytes a half-edge and writes 4.
[[nodiscard]] inline Index gather_pairs(IndexRange range, const Index* opposite,
                                        Index* radial) noexcept {
  Index loose_count = 0;
  for (Index h = range.begin; h < range.end; ++h) {
    const bool is_loose = opposite[h] < 0;
    radial[h] = is_loose ? h : opposite[h];
    loose_count += static_cast<Index>(is_loose);
  }
  return loose_count;
}

/// Closed form: the same for the half-edges of faces; invalid for those without a face.
template <Topology Mesh>
[[nodiscard]] Index gather_closed_pairs(IndexRange range, const Mesh& mesh,
                                        Index* radial) noexcept {
  Index loose_count = 0;
  for (Index i = range.begin; i < range.end; ++i) {
    const HalfedgeId h(i);
    const HalfedgeId opposite = mesh.opposite[h];
    const bool is_loose = !opposite.valid() || !mesh.face(opposite).valid();
    radial[i] = !mesh.face(h).valid() ? kInvalidIndex : is_loose ? i : opposite.value;
    loose_count += static_cast<Index>(is_loose && mesh.face(h).valid());
  }
  return loose_count;
}

/// The loose half-edges of `range` in ascending order, to consecutive places from `out` on.
inline void collect_loose(IndexRange range, const Index* radial, Index* out) noexcept {
  for (Index h = range.begin; h < range.end; ++h) {
    if (radial[h] == h) *out++ = h;
  }
}

/// Sort keys of the half-edges at `range`: the larger vertex of the edge, or the smaller.
template <Topology Mesh>
void fill_end_keys(IndexRange range, const Mesh& mesh, const Index* halfedges, bool is_larger,
                   KeyedItem* out) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    const auto [smaller, larger] = edge_ends(mesh, HalfedgeId(halfedges[i]));
    out[i] = {static_cast<std::uint64_t>(is_larger ? larger : smaller), halfedges[i]};
  }
}

/// Calls visit(begin, end) for each run of places with the same `key` that starts in `range`.
template <class Key, class Visit>
void for_each_run(IndexRange range, Index count, const Key& key, const Visit& visit) noexcept {
  Index begin = range.begin;
  while (begin > 0 && begin < range.end && key(begin) == key(begin - 1)) ++begin;
  while (begin < range.end) {
    Index end = begin + 1;
    while (end < count && key(end) == key(begin)) ++end;
    visit(begin, end);
    begin = end;
  }
}

/// Sorted half-edges, and what their runs are told apart by.
template <Topology Mesh>
struct SortedSides {
  const Mesh& mesh;
  const Index* halfedges = nullptr;
  Index count = 0;

  template <class Visit>
  void for_each_edge(IndexRange range, const Visit& visit) const noexcept {
    for_each_run(
        range, count, [&](Index i) { return edge_ends(mesh, HalfedgeId(halfedges[i])); }, visit);
  }
};

/// Finds pairs that share their edge with loose half-edges, which a face that was cut from all
/// others leaves. One walk round the smaller vertex of the edges of a run of loose ones; a vertex
/// belongs to the range that its first edge is in. Writes both half-edges of each pair to
/// consecutive places from `out` on, if that is not null, and returns how many.
/// O(valence log loose) for each vertex.
template <Topology Mesh, class Outgoing>
[[nodiscard]] Index find_pairs_on_loose(IndexRange range, const SortedSides<Mesh>& loose,
                                        const Outgoing& outgoing, Index* out) noexcept {
  const Mesh& mesh = loose.mesh;
  const auto ends = [&](Index h) { return edge_ends(mesh, HalfedgeId(h)); };
  Index found = 0;
  for_each_run(
      range, loose.count, [&](Index i) { return ends(loose.halfedges[i]).first; },
      [&](Index begin, Index end) {
        const VertexId v(ends(loose.halfedges[begin]).first);
        for (const HalfedgeId h : outgoing(v)) {
          const HalfedgeId opposite = mesh.opposite[h];
          if (!opposite.valid() || !mesh.face(opposite).valid() || !mesh.face(h).valid()) continue;
          const auto edge = ends(h.value);
          const Index* last = loose.halfedges + end;
          const Index* at = std::lower_bound(loose.halfedges + begin, last, edge,
                                             [&](Index g, const auto& e) { return ends(g) < e; });
          if (at == last || ends(*at) != edge) continue;
          if (out != nullptr) {
            out[found] = h.value;
            out[found + 1] = opposite.value;
          }
          found += 2;
        }
      });
  return found;
}

/// Links each run in its order; returns how many half-edges are in runs of three or more.
template <Topology Mesh>
[[nodiscard]] Index link_runs(IndexRange range, const SortedSides<Mesh>& sides,
                              Index* radial) noexcept {
  Index crowded = 0;
  sides.for_each_edge(range, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      radial[sides.halfedges[i]] = sides.halfedges[i + 1 < end ? i + 1 : begin];
    }
    if (end - begin > 2) crowded += end - begin;
  });
  return crowded;
}

/// The runs of three or more, to consecutive places from `out` on.
template <Topology Mesh>
void gather_crowded(IndexRange range, const SortedSides<Mesh>& sides, Positions positions,
                    RadialSide* out) noexcept {
  sides.for_each_edge(range, [&](Index begin, Index end) {
    if (end - begin <= 2) return;
    for (Index i = begin; i < end; ++i) {
      *out++ = radial_side(sides.mesh, positions, HalfedgeId(sides.halfedges[i]), begin);
    }
  });
}

/// Sorts one run: those without direction, then counter-clockwise from the direction of the one
/// with the smallest id that has one; ties by id. O(n log n) signs.
template <Topology Mesh>
void order_sides(const Mesh& mesh, Positions positions, RadialSide* begin,
                 RadialSide* end) noexcept {
  const RadialSigns<Mesh> signs(mesh, positions, HalfedgeId(begin->halfedge));
  // Sectors: 0 no direction, 1 that of the start, 2 less than half a turn from it, 3 half a turn, 4
  // more. The sides come in the order of their ids.
  const RadialSide* start = nullptr;
  for (RadialSide* side = begin; side != end; ++side) {
    if (!signs.has_direction(*side)) continue;
    if (start == nullptr) start = side;
    const int turn = signs.turn(*start, *side);
    if (turn != 0) {
      side->sector = turn > 0 ? 2 : 4;
    } else {
      side->sector = signs.nearness(*start, *side) > 0 ? 1 : 3;
    }
  }
  std::sort(begin, end, [&](const RadialSide& a, const RadialSide& b) {
    if (a.sector != b.sector) return a.sector < b.sector;
    const int turn = a.sector == 2 || a.sector == 4 ? signs.turn(a, b) : 0;
    return turn != 0 ? turn > 0 : a.halfedge < b.halfedge;
  });
}

/// Orders and links the runs of `sides` that start in `range`.
/// \pre the ends of the range are ends of runs, or nothing else works on `sides` meanwhile
template <Topology Mesh>
void link_by_angle(IndexRange range, const Mesh& mesh, Positions positions, RadialSide* sides,
                   Index* radial) noexcept {
  for (Index begin = range.begin; begin < range.end;) {
    Index end = begin + 1;
    while (end < range.end && sides[end].run == sides[begin].run) ++end;
    order_sides(mesh, positions, sides + begin, sides + end);
    for (Index i = begin; i < end; ++i) {
      radial[sides[i].halfedge] = sides[i + 1 < end ? i + 1 : begin].halfedge;
    }
    begin = end;
  }
}

}  // namespace hedgerow::kernels
