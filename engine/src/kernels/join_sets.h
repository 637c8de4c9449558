#pragma once

#include "hedgerow/topology.h"

/// Disjoint sets of numbers as trees in one array: a root is its own parent, every other number has
/// a smaller one. So the root of a set is its smallest number, in whatever order sets were joined.
///
/// Linking roots by number and halving paths: R. Tarjan and J. van Leeuwen, "Worst-case analysis of
/// set union algorithms", 1984; O(log n) a join at the worst, on average over all of them.
/// Two calls may run side by side if they have trees of their own.
namespace hedgerow::kernels {

/// Every number of `range` as a set of its own.
inline void fill_singletons(IndexRange range, Index* parent) noexcept {
  for (Index i = range.begin; i < range.end; ++i) parent[i] = i;
}

[[nodiscard]] inline Index find_root(Index* parent, Index i) noexcept {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Makes one set of those of `a` and `b`.
inline void join_sets(Index* parent, Index a, Index b) noexcept {
  if (parent[a] == parent[b]) return;
  a = find_root(parent, a);
  b = find_root(parent, b);
  (a < b ? parent[b] : parent[a]) = a < b ? a : b;
}

/// Joins the vertices of each face in `faces`. In a local order most corners hang on the same
/// number as the first one already, or are met for the first time and can be hung there as they
/// are: a store, without a branch. What is left is joined by its roots, and hung on them, so that
/// later walks are short.
template <Topology Mesh>
void join_faces(IndexRange faces, const Mesh& mesh, Index* parent) noexcept {
  for (Index i = faces.begin; i < faces.end; ++i) {
    const Index begin = mesh.first(FaceId(i)).value;
    const Index end = begin + mesh.degree(FaceId(i));
    const auto corner = [&](Index h) { return mesh.origin[HalfedgeId(h)].value; };
    const Index shared = parent[corner(begin)];
    bool is_joined = true;
    for (Index h = begin + 1; h < end; ++h) {
      const Index v = corner(h);
      const Index above = parent[v];
      const bool is_new = (above == v) & (shared < v);
      const Index now = is_new ? shared : above;
      parent[v] = now;
      is_joined &= now == shared;
    }
    if (is_joined) continue;
    Index smallest = find_root(parent, shared);
    for (Index h = begin + 1; h < end; ++h) {
      const Index root = find_root(parent, parent[corner(h)]);
      const Index larger = root < smallest ? smallest : root;
      smallest = root < smallest ? root : smallest;
      parent[larger] = smallest;
    }
    for (Index h = begin; h < end; ++h) parent[corner(h)] = smallest;
  }
}

/// Joins the ends of each half-edge in `halfedges`.
template <Topology Mesh>
void join_halfedges(IndexRange halfedges, const Mesh& mesh, Index* parent) noexcept {
  for (Index i = halfedges.begin; i < halfedges.end; ++i) {
    const HalfedgeId h(i);
    join_sets(parent, mesh.origin[h].value, mesh.target(h).value);
  }
}

/// Joins what `other`, trees over the same numbers, has joined in `range`.
inline void join_trees(IndexRange range, const Index* other, Index* parent) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    if (other[i] == i) continue;
    // A root may hang on any smaller number of its new set, and most are alone.
    if (parent[i] == i) {
      parent[i] = other[i];
    } else {
      join_sets(parent, i, other[i]);
    }
  }
}

/// The root of each vertex in its place, or -1 if it is isolated; returns how many sets there are.
/// In ascending order each parent has been replaced by its root before its children are.
template <Topology Mesh>
[[nodiscard]] Index label_roots(const Mesh& mesh, Index* parent) noexcept {
  Index count = 0;
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    const bool is_isolated = !mesh.outgoing[VertexId(i)].valid();
    const Index root = parent[parent[i]];
    count += static_cast<Index>(root == i && !is_isolated);
    parent[i] = is_isolated ? kInvalidIndex : root;
  }
  return count;
}

}  // namespace hedgerow::kernels
