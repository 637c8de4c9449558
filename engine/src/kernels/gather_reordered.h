#pragma once

#include "hedgerow/circulate.h"
#include "hedgerow/index.h"
#include "hedgerow/topology.h"
#include "kernels/radix.h"

/// The columns of a mesh under new numbers. Each kernel reads anywhere and writes only the elements
/// of its own range (for faces: of their half-edges), so ranges that partition them are disjoint;
/// `scatter_inverse` writes elsewhere, but a permutation sends no two elements to one place.
namespace hedgerow::kernels {

/// items[f] = the smallest new number among the vertices of old face f.
template <Topology Mesh>
void gather_smallest_vertex(IndexRange faces, const Mesh& mesh, const Index* vertices_old_to_new,
                            KeyedItem* items) noexcept {
  for (Index f = faces.begin; f < faces.end; ++f) {
    const Index first = mesh.first(FaceId(f)).value;
    const Index degree = mesh.degree(FaceId(f));
    Index smallest = vertices_old_to_new[mesh.origin[HalfedgeId(first)].value];
    for (Index k = 1; k < degree; ++k) {
      const Index v = vertices_old_to_new[mesh.origin[HalfedgeId(first + k)].value];
      smallest = v < smallest ? v : smallest;
    }
    items[f] = {static_cast<std::uint64_t>(smallest), f};
  }
}

/// inverse[permutation[i]] = i
inline void scatter_inverse(IndexRange range, const Index* permutation, Index* inverse) noexcept {
  for (Index i = range.begin; i < range.end; ++i) inverse[permutation[i]] = i;
}

/// What the half-edges of the new faces were, and where they start.
///
/// \pre `first` holds the first half-edge of each new face (null: 3 f).
template <Topology Mesh>
void gather_halfedges(IndexRange faces, const Mesh& mesh, const Index* faces_new_to_old,
                      const Index* first, const Index* vertices_old_to_new,
                      Index* halfedges_new_to_old, Index* origin) noexcept {
  for (Index f = faces.begin; f < faces.end; ++f) {
    const FaceId f_old(faces_new_to_old[f]);
    const Index begin = first != nullptr ? first[f] : 3 * f;
    const Index begin_old = mesh.first(f_old).value;
    const Index degree = mesh.degree(f_old);
    for (Index k = 0; k < degree; ++k) {
      halfedges_new_to_old[begin + k] = begin_old + k;
      origin[begin + k] = vertices_old_to_new[mesh.origin[HalfedgeId(begin_old + k)].value];
    }
  }
}

template <Topology Mesh>
void gather_opposites(IndexRange halfedges, const Mesh& mesh, const Index* halfedges_new_to_old,
                      const Index* halfedges_old_to_new, Index* opposite) noexcept {
  for (Index h = halfedges.begin; h < halfedges.end; ++h) {
    const HalfedgeId old = mesh.opposite[HalfedgeId(halfedges_new_to_old[h])];
    opposite[h] = old.valid() ? halfedges_old_to_new[old.value] : kInvalidIndex;
  }
}

/// One fan as the builder would start it: at its end if it is open, else at its smallest half-edge.
struct Fan {
  HalfedgeId start;
  HalfedgeId smallest;
};

/// \pre `start` is a half-edge that starts a fan; any of them if the fan is closed.
template <Topology Mesh>
[[nodiscard]] Fan find_fan(const Mesh& mesh, HalfedgeId start) noexcept {
  Fan fan{start, start};
  HalfedgeId h = start;
  do {
    if (h < fan.smallest) fan.smallest = h;
    const HalfedgeId opposite = mesh.opposite[h];
    h = opposite.valid() ? mesh.next(opposite) : HalfedgeId();
  } while (h.valid() && h != start);
  if (h.valid()) fan.start = fan.smallest;
  return fan;
}

/// outgoing[v] = the smallest half-edge of `halfedges` that leaves v; other vertices are left as
/// they are. Two calls may run side by side if they write to arrays of their own.
inline void scatter_smallest_outgoing(IndexRange halfedges, const Index* origin,
                                      Index* outgoing) noexcept {
  // From the last to the first, so that the smallest is what remains.
  for (Index h = halfedges.end; h-- > halfedges.begin;) outgoing[origin[h]] = h;
}

/// Takes over what another array has for the vertices in `range` that have none.
inline void gather_missing_outgoing(IndexRange range, const Index* other,
                                    Index* outgoing) noexcept {
  for (Index v = range.begin; v < range.end; ++v) {
    if (outgoing[v] == kInvalidIndex) outgoing[v] = other[v];
  }
}

/// outgoing[v] = where the open fan starts that the old vertex started with; closed ones are left.
template <Topology OldMesh>
void gather_open_starts(IndexRange range, const OldMesh& old_mesh, const Index* vertices_new_to_old,
                        const Index* halfedges_old_to_new, Index* outgoing) noexcept {
  for (Index v = range.begin; v < range.end; ++v) {
    const HalfedgeId old = old_mesh.outgoing[VertexId(vertices_new_to_old[v])];
    if (old.valid() && is_open_start(old_mesh, old)) outgoing[v] = halfedges_old_to_new[old.value];
  }
}

}  // namespace hedgerow::kernels
