#pragma once

#include "hedgerow/circulate.h"

namespace hedgerow::kernels {

/// Adds to valence[v] how often `for_each_neighbour` visits v on its way over `halfedges`. Two
/// calls may run side by side if they add to arrays of their own.
template <Topology Mesh>
void scatter_valences(IndexRange halfedges, const Mesh& mesh, Index* valence) noexcept {
  for_each_neighbour(mesh, halfedges, [&](VertexId v, VertexId) { ++valence[v.value]; });
}

/// Adds another array's counts for the vertices in `range`.
inline void gather_valences(IndexRange range, const Index* other, Index* valence) noexcept {
  for (Index v = range.begin; v < range.end; ++v) valence[v] += other[v];
}

}  // namespace hedgerow::kernels
