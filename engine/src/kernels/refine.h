#pragma once

#include <algorithm>

#include "hedgerow/topology.h"

/// Connectivity of subdivided meshes: each child half-edge is computed from its parent, and every
/// opposite from the children of the parent's neighbours.
///
/// All `fill_` functions write the children of the elements in their range and nothing else, so
/// ranges that partition the parents write disjoint memory.
namespace hedgerow::kernels {

/// The number that an edge goes by: `rank[h]` counts the edges whose smaller half-edge is before h.
template <Topology Mesh>
[[nodiscard]] inline HalfedgeId smaller_side(const Mesh& mesh, HalfedgeId h) noexcept {
  const HalfedgeId opposite = mesh.opposite[h];
  return opposite.valid() ? std::min(h, opposite) : h;
}

struct ChildColumns {
  Index* origin;
  Index* opposite;
};

/// Faces of four corners, half-edge 4f + k at corner k of face f.
struct QuadView {
  Column<HalfedgeId, VertexId> origin;
  Column<HalfedgeId, HalfedgeId> opposite;

  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept {
    return HalfedgeId(h.value % 4 == 3 ? h.value - 3 : h.value + 1);
  }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept {
    return HalfedgeId(h.value % 4 == 0 ? h.value + 3 : h.value - 1);
  }
};

/// Catmull-Clark. Corners of child h: origin of h, middle of h, middle of the face, middle of prev.
template <Topology Mesh>
void fill_quads(IndexRange halfedges, const Mesh& mesh, const Index* rank,
                ChildColumns out) noexcept {
  const Index face_point = mesh.vertex_count();
  const Index edge_point = face_point + mesh.face_count();
  for (Index i = halfedges.begin; i < halfedges.end; ++i) {
    const HalfedgeId h(i);
    const HalfedgeId prev = mesh.prev(h);
    const HalfedgeId across = mesh.opposite[h];
    const HalfedgeId across_prev = mesh.opposite[prev];
    Index* origin = out.origin + 4 * i;
    origin[0] = mesh.origin[h].value;
    origin[1] = edge_point + rank[smaller_side(mesh, h).value];
    origin[2] = face_point + mesh.face(h).value;
    origin[3] = edge_point + rank[smaller_side(mesh, prev).value];
    Index* opposite = out.opposite + 4 * i;
    opposite[0] = across.valid() ? 4 * mesh.next(across).value + 3 : kInvalidIndex;
    opposite[1] = 4 * mesh.next(h).value + 2;
    opposite[2] = 4 * prev.value + 1;
    opposite[3] = across_prev.valid() ? 4 * across_prev.value : kInvalidIndex;
  }
}

/// Where the builder starts the fan of the point of an edge, h being the smaller side of it. Two
/// half-edges leave it on each side; on the boundary, the first of them has none before it.
template <Topology Mesh>
[[nodiscard]] Index quad_edge_start(const Mesh& mesh, HalfedgeId h) noexcept {
  const auto smaller_of = [&](HalfedgeId side) {
    return std::min(4 * side.value + 1, 4 * mesh.next(side).value + 3);
  };
  const HalfedgeId across = mesh.opposite[h];
  return across.valid() ? std::min(smaller_of(h), smaller_of(across)) : 4 * h.value + 1;
}

/// The first half-edge of the child that Loop's scheme makes at the origin of h.
[[nodiscard]] inline Index corner_child(HalfedgeId h) noexcept {
  return 12 * (h.value / 3) + 3 * (h.value % 3);
}

/// Loop. Child k of a face: corner k, middle of h, middle of prev; the last: the three middles.
inline void fill_quarters(IndexRange halfedges, const TriangleView& mesh, const Index* rank,
                          ChildColumns out) noexcept {
  for (Index i = halfedges.begin; i < halfedges.end; ++i) {
    const HalfedgeId h(i);
    const HalfedgeId prev = mesh.prev(h);
    const HalfedgeId across = mesh.opposite[h];
    const HalfedgeId across_prev = mesh.opposite[prev];
    const Index child = corner_child(h);
    const Index middle = 12 * (i / 3) + 9;
    const Index edge_point = mesh.vertex_count() + rank[smaller_side(mesh, h).value];
    out.origin[child] = mesh.origin[h].value;
    out.origin[child + 1] = edge_point;
    out.origin[child + 2] = mesh.vertex_count() + rank[smaller_side(mesh, prev).value];
    out.opposite[child] = across.valid() ? corner_child(mesh.next(across)) + 2 : kInvalidIndex;
    out.opposite[child + 1] = middle + prev.value % 3;
    out.opposite[child + 2] = across_prev.valid() ? corner_child(across_prev) : kInvalidIndex;
    // Half-edge k in the middle runs from the middle of h to that of next(h).
    out.origin[middle + i % 3] = edge_point;
    out.opposite[middle + i % 3] = corner_child(mesh.next(h)) + 1;
  }
}

/// Where the builder starts the fan of the middle of an edge, h being the smaller side of it. Three
/// half-edges leave it on each side, those in the middle triangle behind the others; on the
/// boundary, the one in the corner of h has none before it.
[[nodiscard]] inline Index quarter_edge_start(const TriangleView& mesh, HalfedgeId h) noexcept {
  const auto smaller_of = [&](HalfedgeId side) {
    return std::min(corner_child(side) + 1, corner_child(mesh.next(side)) + 2);
  };
  const HalfedgeId across = mesh.opposite[h];
  return across.valid() ? std::min(smaller_of(h), smaller_of(across)) : corner_child(h) + 1;
}

[[nodiscard]] inline bool has_boundary_edge(const TriangleView& mesh, FaceId f) noexcept {
  const Index h = 3 * f.value;
  return !mesh.opposite[HalfedgeId(h)].valid() || !mesh.opposite[HalfedgeId(h + 1)].valid() ||
         !mesh.opposite[HalfedgeId(h + 2)].valid();
}

/// The sqrt(3) scheme: which vertex each old edge gets across it on the side of a half-edge.
///
/// A face gets its centre. Where boundary edges are cut in three (`rank` is then not null and
/// counts the faces with a boundary edge before each), such a face gets the two new vertices of
/// that edge instead, and either of its other two edges gets the nearer of them.
/// \pre with `rank`, no face has two boundary edges, as after one level of the scheme.
struct Apexes {
  const TriangleView& mesh;
  const Index* rank;

  [[nodiscard]] bool cuts(HalfedgeId h) const noexcept {
    return rank != nullptr && !mesh.opposite[h].valid();
  }
  [[nodiscard]] Index first(FaceId f) const noexcept {
    return mesh.vertex_count() + f.value + (rank != nullptr ? rank[f.value] : 0);
  }
  [[nodiscard]] Index of(HalfedgeId h) const noexcept {
    return first(mesh.face(h)) + (cuts(mesh.prev(h)) ? 1 : 0);
  }
};

/// Child h of an inner edge: its origin, the apex across, its apex. Of a boundary edge: origin,
/// target and apex, or where it is cut: the two new vertices and the corner opposite to it.
inline void fill_thirds(IndexRange halfedges, const Apexes& apexes, ChildColumns out) noexcept {
  const TriangleView& mesh = apexes.mesh;
  for (Index i = halfedges.begin; i < halfedges.end; ++i) {
    const HalfedgeId h(i);
    const HalfedgeId next = mesh.next(h);
    const HalfedgeId prev = mesh.prev(h);
    const HalfedgeId across = mesh.opposite[h];
    Index* origin = out.origin + 3 * i;
    Index* opposite = out.opposite + 3 * i;
    if (apexes.cuts(h)) {
      const Index first = apexes.first(mesh.face(h));
      origin[0] = first;
      origin[1] = first + 1;
      origin[2] = mesh.origin[prev].value;
      opposite[0] = kInvalidIndex;
      opposite[1] = 3 * mesh.opposite[next].value;
      opposite[2] = 3 * prev.value + 2;
      continue;
    }
    origin[0] = mesh.origin[h].value;
    origin[2] = apexes.of(h);
    if (across.valid()) {
      const HalfedgeId beyond = mesh.next(across);
      const HalfedgeId before = mesh.prev(across);
      origin[1] = apexes.of(across);
      opposite[0] = apexes.cuts(beyond)   ? kInvalidIndex
                    : apexes.cuts(before) ? 3 * before.value + 1
                                          : 3 * beyond.value + 2;
      opposite[1] = 3 * across.value + 1;
    } else {
      origin[1] = mesh.origin[next].value;
      opposite[0] = kInvalidIndex;
      opposite[1] = 3 * next.value + 2;
    }
    const HalfedgeId across_prev = mesh.opposite[prev];
    opposite[2] = apexes.cuts(prev)     ? kInvalidIndex
                  : apexes.cuts(next)   ? 3 * next.value + 2
                  : across_prev.valid() ? 3 * across_prev.value
                                        : 3 * prev.value + 1;
  }
}

struct ChildFan {
  Index smallest;
  Index start;
};

/// The fan of half-edges round the origin of `seed`, and where the builder would start it.
/// O(valence)
template <class Mesh>
[[nodiscard]] inline ChildFan child_fan(const Mesh& mesh, HalfedgeId seed) noexcept {
  Index smallest = seed.value;
  for (HalfedgeId h = seed;;) {
    const HalfedgeId across = mesh.opposite[h];
    if (!across.valid()) break;
    h = mesh.next(across);
    if (h == seed) return {smallest, smallest};
    smallest = std::min(smallest, h.value);
  }
  HalfedgeId start = seed;
  for (;;) {
    const HalfedgeId incoming = mesh.opposite[mesh.prev(start)];
    if (!incoming.valid()) return {smallest, start.value};
    start = incoming;
    smallest = std::min(smallest, start.value);
  }
}

}  // namespace hedgerow::kernels
