#pragma once

#include <type_traits>

#include "hedgerow/circulate.h"
#include "hedgerow/topology.h"
#include "kernels/prefetch.h"

/// Connectedness read off the numbers of the vertices: if all but one have a smaller neighbour,
/// each is led to that one by going from neighbour to smaller neighbour, so all are connected.
///
/// Linking few neighbours of a vertex and looking at the others only where that does not settle
/// the matter is from M. Sutton, T. Ben-Nun, A. Barak, "Optimizing parallel graph connectivity
/// computation via subgraph sampling", 2018.
namespace hedgerow::kernels {

/// The first vertex that is not isolated, or the number of vertices.
template <Topology Mesh>
[[nodiscard]] Index find_used_vertex(const Mesh& mesh) noexcept {
  Index i = 0;
  while (i < mesh.vertex_count() && !mesh.outgoing[VertexId(i)].valid()) ++i;
  return i;
}

/// Whether one of the neighbours of v that stand beside `h`, which leaves v, is smaller than v:
/// those of its triangle; otherwise the target, and the vertex before where `h - 1` leads to `h`.
template <Topology Mesh>
[[nodiscard]] inline bool is_smaller_beside(const Mesh& mesh, Index v, HalfedgeId h) noexcept {
  if constexpr (std::is_same_v<Mesh, TriangleView>) {
    const Index* corner = mesh.origin.data() + mesh.first(mesh.face(h)).value;
    return corner[0] < v || corner[1] < v || corner[2] < v;
  } else {
    if (mesh.target(h).value < v) return true;
    const HalfedgeId before(h.value - 1);
    return before.valid() && mesh.next(before) == h && mesh.origin[before].value < v;
  }
}

/// Whether some neighbour of `v` is smaller. O(valence).
template <Topology Mesh>
[[nodiscard]] bool has_smaller_neighbour(const Mesh& mesh, VertexId v) noexcept {
  for (const VertexId u : neighbours(mesh, v)) {
    if (u < v) return true;
  }
  return false;
}

/// Labels the vertices of `range` with `root`, isolated ones with -1. Returns whether all that are
/// neither isolated nor `root` have a smaller neighbour; if not, it has ended at the first that has
/// none. Ranges that partition the vertices write disjoint labels.
template <Topology Mesh>
[[nodiscard]] bool label_with_root(IndexRange range, Index root, const Mesh& mesh,
                                   Index* label) noexcept {
  constexpr Index kAhead = 192;  // vertices: in a local order, some four kilobytes of `origin`
  constexpr Index kStep = 4;     // vertices: in a local order, about a line of `origin`
  const Index* outgoing = mesh.outgoing.data();
  for (Index i = range.begin; i < range.end; ++i) {
    if (i % kStep == 0 && i < mesh.vertex_count() - kAhead) {
      prefetch_entry(mesh.origin.data(), outgoing[i + kAhead]);  // -1 where it is isolated
    }
    const HalfedgeId h(outgoing[i]);
    label[i] = h.valid() ? root : kInvalidIndex;
    if (!h.valid() || is_smaller_beside(mesh, i, h) || i == root) continue;
    if (!has_smaller_neighbour(mesh, VertexId(i))) return false;
  }
  return true;
}

}  // namespace hedgerow::kernels
