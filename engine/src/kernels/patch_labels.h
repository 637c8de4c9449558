#pragma once

#include "hedgerow/topology.h"
#include "kernels/join_sets.h"

namespace hedgerow::kernels {

/// Joins the faces of the edges whose cycle has two half-edges, the smaller of them in `range`. Two
/// calls may run side by side if they have trees of their own.
template <Topology Mesh>
void join_across_pairs(IndexRange range, const Mesh& mesh,
                       Column<HalfedgeId, HalfedgeId> radial_next, Index* parent) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    const HalfedgeId h(i);
    const HalfedgeId other = radial_next[h];
    if (other <= h || radial_next[other] != h) continue;
    join_sets(parent, mesh.face(h).value, mesh.face(other).value);
  }
}

/// Replaces each parent in `range` by its root; returns how many roots there are. In ascending
/// order each parent has been replaced before its children are: one call over all trees.
[[nodiscard]] inline Index flatten_trees(IndexRange range, Index* parent) noexcept {
  Index count = 0;
  for (Index i = range.begin; i < range.end; ++i) {
    parent[i] = parent[parent[i]];
    count += static_cast<Index>(parent[i] == i);
  }
  return count;
}

}  // namespace hedgerow::kernels
