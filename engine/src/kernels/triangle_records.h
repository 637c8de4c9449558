#pragma once

#include "hedgerow/corner_table.h"
#include "hedgerow/directed_edge.h"
#include "hedgerow/topology.h"

/// Records of triangle meshes from the columns, and back. Ranges that partition the half-edges
/// write disjoint entries: those of their own half-edges, which have the numbers of the records.
namespace hedgerow::kernels {

inline void gather_corners(IndexRange range, const TriangleView& mesh, VertexId* vertex,
                           CornerId* opposite) noexcept {
  for (Index c = range.begin; c < range.end; ++c) {
    vertex[c] = mesh.origin[HalfedgeId(c)];
    // The edge that a corner faces leaves its next corner, and is faced from behind its own.
    const HalfedgeId across = mesh.opposite[mesh.next(HalfedgeId(c))];
    opposite[c] = CornerId(across.valid() ? mesh.prev(across).value : kInvalidIndex);
  }
}

inline void gather_opposites(IndexRange range, const CornerTableView& table,
                             Index* opposite) noexcept {
  for (Index h = range.begin; h < range.end; ++h) {
    opposite[h] = table.opposite[HalfedgeId(h)].value;
  }
}

inline void gather_directed_edges(IndexRange range, const TriangleView& mesh,
                                  DirectedEdge* edges) noexcept {
  for (Index h = range.begin; h < range.end; ++h) {
    edges[h] = {mesh.origin[HalfedgeId(h)], mesh.opposite[HalfedgeId(h)]};
  }
}

inline void gather_columns(IndexRange range, const DirectedEdge* edges, Index* origin,
                           Index* opposite) noexcept {
  for (Index h = range.begin; h < range.end; ++h) {
    origin[h] = edges[h].start.value;
    opposite[h] = edges[h].neighbour.value;
  }
}

}  // namespace hedgerow::kernels
