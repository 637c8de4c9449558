#pragma once

#include "hedgerow/adjacency.h"
#include "hedgerow/dcel.h"
#include "hedgerow/split_edge.h"
#include "hedgerow/topology.h"

/// Records of half-edges, from the columns. A backward link is written by the
/// half-edge that it leads to, so that none has to be searched for: each is written once, since
/// `next` is a permutation, and ranges that partition the half-edges write disjoint entries.
namespace hedgerow::kernels {

template <Topology Mesh>
void scatter_adjacency(IndexRange range, const Mesh& mesh, AdjacencyRecord* out) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    const HalfedgeId h(i);
    const HalfedgeId next = mesh.next(h);
    out[i].opposite = mesh.opposite[h];
    out[i].face = mesh.face(h);
    out[i].next = next;
    out[next.value].prev = h;
  }
}

/// \pre the closed form
inline void scatter_dcel(IndexRange range, const PolygonView& mesh, DcelHalfedge* out) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    const HalfedgeId h(i);
    const HalfedgeId next = mesh.next(h);
    out[i].origin = mesh.origin[h];
    out[i].opposite = mesh.opposite[h];
    out[i].face = mesh.face(h);
    out[i].next = next;
    out[next.value].prev = h;
  }
}

/// \pre the closed form
inline void scatter_split_edges(IndexRange range, const PolygonView& mesh,
                                SplitEdge* out) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    const HalfedgeId h(i);
    const HalfedgeId clockwise = mesh.next(mesh.opposite[h]);
    out[i].vertex = mesh.origin[h];
    out[i].face = mesh.face(h);
    out[i].clockwise = clockwise;
    out[i].opposite = mesh.opposite[h];
    out[clockwise.value].counter_clockwise = h;
  }
}

}  // namespace hedgerow::kernels
