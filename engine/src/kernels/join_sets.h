#pragma once

#include <atomic>

#include "hedgerow/topology.h"
#include "kernels/prefetch.h"

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
  const Index* first_corner = mesh.origin.data();
  for (Index i = faces.begin; i < faces.end; ++i) {
    const Index begin = mesh.first(FaceId(i)).value;
    const Index end = begin + mesh.degree(FaceId(i));
    const auto corner = [&](Index h) { return mesh.origin[HalfedgeId(h)].value; };
    prefetch_ahead(first_corner + begin);
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

/// The part of joining what `other` has joined, trees over the same numbers, that several ranges
/// may have done to them side by side: a root of `parent` hangs on what it hangs on in `other`.
/// Returns whether that leaves something for `join_trees`.
[[nodiscard]] inline bool hang_roots(IndexRange range, const Index* other, Index* parent) noexcept {
  Index left = 0;
  for (Index i = range.begin; i < range.end; ++i) {
    const Index above = other[i];
    const Index own = parent[i];
    const bool is_root = own == i;
    parent[i] = is_root ? above : own;
    left |= static_cast<Index>(!is_root & (above != i) & (above != own));
  }
  return left != 0;
}

/// Joins the rest of what `other` has joined in `range`.
inline void join_trees(IndexRange range, const Index* other, Index* parent) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    if (other[i] != i) join_sets(parent, i, other[i]);
  }
}

/// The root of each vertex of `range` in its place, or -1 if it is isolated; returns how many roots
/// there are among them. Ranges may be labelled side by side: what is met on the way up is a root
/// or leads to one, whether another range has replaced it already or not, and nothing leads to an
/// isolated vertex. (Hence the relaxed atomic accesses, which cost nothing.)
template <Topology Mesh>
[[nodiscard]] Index label_roots(IndexRange range, const Mesh& mesh, Index* parent) noexcept {
  constexpr Index kBlock = 16;
  const auto at = [parent](Index i) { return std::atomic_ref<Index>(parent[i]); };
  const Index* outgoing = mesh.outgoing.data();
  Index count = 0;
  for (Index begin = range.begin; begin < range.end; begin += kBlock) {
    const Index end = range.end - begin < kBlock ? range.end : begin + kBlock;
    prefetch_ahead(outgoing + begin);
    prefetch_ahead(parent + begin);
    for (Index i = begin; i < end; ++i) {
      const bool is_isolated = outgoing[i] < 0;
      Index root = at(i).load(std::memory_order_relaxed);
      for (Index above = at(root).load(std::memory_order_relaxed); above != root;) {
        root = above;
        above = at(root).load(std::memory_order_relaxed);
      }
      count += static_cast<Index>(root == i && !is_isolated);
      at(i).store(is_isolated ? kInvalidIndex : root, std::memory_order_relaxed);
    }
  }
  return count;
}

}  // namespace hedgerow::kernels
