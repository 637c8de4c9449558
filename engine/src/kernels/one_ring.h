#pragma once

#include <type_traits>

#include "hedgerow/topology.h"
#include "kernels/index_set.h"

/// The corners of a vertex in ascending order, whatever their number, without allocating.
namespace hedgerow::kernels {

/// Calls visit(h) for each half-edge with a face that leaves v, in the order of rotation, fan by
/// fan. O(valence).
template <Topology View, class Visit>
inline void for_each_corner(const View& mesh, VertexId v, const Visit& visit) noexcept {
  const auto rotate = [&](HalfedgeId start) {
    HalfedgeId h = start;
    do {
      if constexpr (std::is_same_v<View, TriangleView>) {
        visit(h.value);
      } else {
        if (mesh.face(h).valid()) visit(h.value);
      }
      const HalfedgeId opposite = mesh.opposite[h];
      if (!opposite.valid()) return;
      h = mesh.next(opposite);
    } while (h != start);
  };
  const HalfedgeId start = mesh.outgoing[v];
  if (!start.valid()) return;
  rotate(start);
  for (const FanStart& fan : extra_fans(mesh.fans, v)) rotate(fan.start);
}

/// Calls visit(f) for the face of each of them.
template <Topology View, class Visit>
inline void for_each_face(const View& mesh, VertexId v, const Visit& visit) noexcept {
  if constexpr (std::is_same_v<View, TriangleView>) {
    using Unsigned = std::make_unsigned_t<Index>;
    // One division a step: it tells the face, and where in it the next half-edge is.
    const auto rotate = [&](HalfedgeId start) {
      Index h = start.value;
      auto face = static_cast<Unsigned>(h) / 3;
      do {
        visit(static_cast<Index>(face));
        const Index opposite = mesh.opposite[HalfedgeId(h)].value;
        if (opposite < 0) return;
        face = static_cast<Unsigned>(opposite) / 3;
        const auto first = static_cast<Index>(3 * face);
        h = opposite == first + 2 ? first : opposite + 1;
      } while (h != start.value);
    };
    const HalfedgeId start = mesh.outgoing[v];
    if (!start.valid()) return;
    rotate(start);
    for (const FanStart& fan : extra_fans(mesh.fans, v)) rotate(fan.start);
  } else {
    for_each_corner(mesh, v, [&](Index h) { visit(mesh.face(HalfedgeId(h)).value); });
  }
}

/// Corners handed over at a time; more than almost every vertex has.
inline constexpr Index kChunk = 64;

/// Sorts a few numbers. Rings are short and nearly in rotation order.
inline void sort_few(Index* values, Index count) noexcept {
  for (Index i = 1; i < count; ++i) {
    const Index value = values[i];
    Index j = i;
    for (; j > 0 && values[j - 1] > value; --j) values[j] = values[j - 1];
    values[j] = value;
  }
}

/// Calls visit(ids, count) with the corners of v in ascending order, at most kChunk at a time.
/// \pre `spill` is empty; it is again afterwards.
template <Topology View, class Visit>
inline void for_each_chunk(const View& mesh, VertexId v, IndexSet& spill,
                           const Visit& visit) noexcept {
  Index ids[kChunk + 3];  // three more, for the last group of four
  Index count = 0;
  bool has_spilled = false;
  for_each_corner(mesh, v, [&](Index h) {
    if (count == kChunk) {
      has_spilled = true;
      for (Index i = 0; i < kChunk; ++i) spill.insert(ids[i]);
      count = 0;
    }
    ids[count++] = h;
  });
  if (!has_spilled) {
    sort_few(ids, count);
    if (count > 0) visit(ids, count);
    return;
  }
  for (Index i = 0; i < count; ++i) spill.insert(ids[i]);
  while (!spill.empty()) {
    for (count = 0; count < kChunk && !spill.empty(); ++count) ids[count] = spill.take_smallest();
    visit(ids, count);
  }
}

}  // namespace hedgerow::kernels
