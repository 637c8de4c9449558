#pragma once

#include "hedgerow/index.h"
#include "hedgerow/topology.h"

/// The columns of one boundary form from those of the other. Ranges that partition the elements
/// write disjoint entries: those of their own elements.
namespace hedgerow::kernels {

/// Where the fan that starts at `start` in the default form starts in the closed form: at the
/// boundary half-edge that `closed_opposite` names, if the fan is open.
template <Topology Mesh>
[[nodiscard]] HalfedgeId closed_start(const Mesh& mesh, HalfedgeId start,
                                      const Index* closed_opposite) noexcept {
  const HalfedgeId before = mesh.prev(start);
  return mesh.opposite[before].valid() ? start : HalfedgeId(closed_opposite[before.value]);
}

/// closed[v] for the vertices in `range`.
template <Topology Mesh>
void gather_closed_outgoing(IndexRange range, const Mesh& mesh, const Index* closed_opposite,
                            Index* closed) noexcept {
  for (Index v = range.begin; v < range.end; ++v) {
    const HalfedgeId start = mesh.outgoing[VertexId(v)];
    closed[v] = start.valid() ? closed_start(mesh, start, closed_opposite).value : kInvalidIndex;
  }
}

/// The smallest half-edge in `range` that the default form has no place for, or -1: one of a face
/// that is not stored in one run, or a boundary half-edge that lies before those of the faces or
/// runs along a dangling edge.
[[nodiscard]] inline Index find_not_openable(IndexRange range, const PolygonView& mesh) noexcept {
  const Index side_count = mesh.first_of[FaceId(mesh.face_count())].value;
  for (Index i = range.begin; i < range.end; ++i) {
    const HalfedgeId h(i);
    const FaceId f = mesh.face(h);
    if (!f.valid()) {
      if (i < side_count || mesh.opposite[h].value >= side_count) return i;
      continue;
    }
    const Index begin = mesh.first_of[f].value;
    const Index end = mesh.first_of[FaceId(f.value + 1)].value;
    if (i < begin || i >= end) return i;
    if (mesh.next(h).value != (i + 1 < end ? i + 1 : begin)) return i;
  }
  return kInvalidIndex;
}

/// opened[h] for the half-edges of faces in `range`, of which there are `side_count`.
inline void gather_open_opposites(IndexRange range, const PolygonView& mesh, Index side_count,
                                  Index* opened) noexcept {
  for (Index h = range.begin; h < range.end; ++h) {
    const Index opposite = mesh.opposite[HalfedgeId(h)].value;
    opened[h] = opposite < side_count ? opposite : kInvalidIndex;
  }
}

}  // namespace hedgerow::kernels
