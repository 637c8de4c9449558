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

/// Makes one set of those of `a`, `b` and `c`. Mostly what they hang on are roots, and these are
/// joined without a branch; all end up hanging on the new root. In a local order they often hang on
/// one number already, and then nothing is done. In a scattered order that is rare, and where it is
/// not the case a root is a step higher up.
template <bool is_scattered>
void join_three(Index* parent, Index a, Index b, Index c) noexcept {
  Index p = parent[a];
  Index q = parent[b];
  Index r = parent[c];
  if constexpr (is_scattered) {
    p = parent[p];
    q = parent[q];
    r = parent[r];
  } else if (p == q && q == r) {
    return;
  }
  if (parent[p] != p || parent[q] != q || parent[r] != r) {
    p = find_root(parent, p);
    q = find_root(parent, q);
    r = find_root(parent, r);
  }
  const Index smaller = p < q ? p : q;
  const Index root = smaller < r ? smaller : r;
  parent[p] = parent[q] = parent[r] = root;
  parent[a] = parent[b] = parent[c] = root;
}

/// Joins the vertices of each face in `faces`. In a scattered order this waits for parents, and so
/// asks for them ahead.
template <bool is_scattered, Topology Mesh>
void join_faces(IndexRange faces, const Mesh& mesh, Index* parent) noexcept {
  constexpr Index kAhead = 48;  // half-edges: the latency of memory behind 16 triangles
  const Index* origin = mesh.origin.data();
  for (Index i = faces.begin; i < faces.end; ++i) {
    const Index begin = mesh.first(FaceId(i)).value;
    const Index last = begin + mesh.degree(FaceId(i)) - 1;
    prefetch_ahead(origin + begin);
    if (is_scattered && last < mesh.halfedge_count() - kAhead) {
      for (Index h = begin; h <= last; ++h) __builtin_prefetch(parent + origin[h + kAhead], 1);
    }
    for (Index h = begin + 1; h <= last; h += 2) {
      const Index third = h < last ? h + 1 : h;
      join_three<is_scattered>(parent, origin[begin], origin[h], origin[third]);
    }
  }
}

/// Whether most faces have no corner near one of the face before, by some 256 of them. Where there
/// are few vertices some of them are near in any order, and a cache holds all parents.
template <Topology Mesh>
[[nodiscard]] bool has_scattered_faces(const Mesh& mesh) noexcept {
  constexpr Index kSamples = 256;
  constexpr Index kNear = 1 << 11;  // vertices: their parents lie on two or three pages
  const Index step = mesh.face_count() / kSamples + 1;
  Index far_count = 0;
  Index count = 0;
  for (Index i = 1; i < mesh.face_count(); i += step) {
    const Index h = mesh.first(FaceId(i)).value;
    const Index before = mesh.first(FaceId(i - 1)).value;
    bool is_far = true;
    for (Index k = 0; k < 9; ++k) {
      const Index distance =
          mesh.origin[HalfedgeId(h + k / 3)].value - mesh.origin[HalfedgeId(before + k % 3)].value;
      is_far &= distance > kNear || distance < -kNear;
    }
    far_count += static_cast<Index>(is_far);
    ++count;
  }
  return 2 * far_count > count;
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
  constexpr Index kAhead = 32;  // numbers
  for (Index i = range.begin; i < range.end; ++i) {
    if (range.end - i > kAhead) __builtin_prefetch(parent + other[i + kAhead], 1);
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
