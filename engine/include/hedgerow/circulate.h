#pragma once

#include <type_traits>

#include "hedgerow/circulation.h"
#include "hedgerow/index.h"
#include "hedgerow/topology.h"

/// Ranges round a vertex, a face and a hole, for range-for and for the algorithms of std::ranges.
///
/// All of them work on both views and in both forms, follow `opposite` and `next` alone, visit
/// every fan of a vertex, and are empty at an isolated one. At a boundary vertex the default form
/// and the closed form give the same neighbours and faces in the same order; the closed form has
/// boundary half-edges to visit besides.
///
/// Pre        The mesh is sound, as `validate` says, and the element is one of its own.
/// Cost       A few registers, nothing allocated; O(1) for each element but where said otherwise,
///            and O(log fans) once at a vertex of a mesh with several fans anywhere. A step round a
///            vertex reads `opposite` and a stored `next`; a neighbour reads `origin` besides.
/// Threads    Any number of ranges over one mesh at a time; no writer beside them.
/// Lifetime   A range refers to the view it was made from: a named one, which must outlive it.
namespace hedgerow {

/// The half-edges that leave `v`, fan by fan. In counter-clockwise rotation an open fan is walked
/// once more to find where it begins, and each boundary half-edge of the closed form costs a
/// rotation where `PolygonView::prev` has to look for its predecessor.
template <Rotation rotation = Rotation::clockwise, Topology Mesh>
[[nodiscard]] inline auto outgoing_halfedges(const Mesh& mesh, VertexId v) noexcept {
  return Circulation(detail::OutgoingState<Mesh, rotation>(mesh, v));
}

/// The vertices that share an edge with `v`, clockwise in each fan, from the one behind the open
/// end of the fan where there is one. A neighbour across an edge that is cut comes once for each
/// side.
template <Topology Mesh>
[[nodiscard]] inline auto neighbours(const Mesh& mesh, VertexId v) noexcept {
  return Circulation(detail::NeighbourState<Mesh>(mesh, v));
}

/// The faces at `v`, clockwise in each fan, each once.
template <Topology Mesh>
[[nodiscard]] inline auto incident_faces(const Mesh& mesh, VertexId v) noexcept {
  return Circulation(detail::IncidentFaceState<Mesh>(mesh, v));
}

/// The half-edges of the face of `h`, counter-clockwise from `h`; for a half-edge without a face,
/// those of its hole.
template <FaceTopology Mesh>
[[nodiscard]] inline auto halfedges_from(const Mesh& mesh, HalfedgeId h) noexcept {
  return Circulation(detail::LoopState<Mesh, false>(mesh, h));
}

/// The half-edges of `f`, counter-clockwise from `first(f)`.
template <FaceTopology Mesh>
[[nodiscard]] inline auto halfedges(const Mesh& mesh, FaceId f) noexcept {
  if constexpr (std::is_same_v<Mesh, TriangleView>) {
    return Circulation(detail::TriangleState<false>(mesh, f));
  } else {
    return halfedges_from(mesh, mesh.first(f));
  }
}

/// The vertices of `f`, counter-clockwise from the origin of `first(f)`.
template <Topology Mesh>
[[nodiscard]] inline auto vertices(const Mesh& mesh, FaceId f) noexcept {
  if constexpr (std::is_same_v<Mesh, TriangleView>) {
    return Circulation(detail::TriangleState<true>(mesh, f));
  } else {
    return Circulation(detail::FaceVertexState<Mesh>(mesh, mesh.first(f)));
  }
}

/// The faces across the edges of `f`, where there is one: a face once for each edge shared with it.
template <FaceTopology Mesh>
[[nodiscard]] inline auto adjacent_faces(const Mesh& mesh, FaceId f) noexcept {
  return Circulation(detail::AdjacentFaceState<Mesh>(mesh, mesh.first(f)));
}

/// The boundary loop through the boundary half-edge `h`. In the default form these are half-edges
/// of faces and run their way; in the closed form those of the hole, the other way round, passing
/// along both sides of a dangling edge. Linear over a whole loop.
///
/// \pre opposite[h] is invalid (default form), or face(h) is (closed form).
template <FaceTopology Mesh>
[[nodiscard]] inline auto boundary_loop(const Mesh& mesh, HalfedgeId h) noexcept {
  return Circulation(detail::LoopState<Mesh, true>(mesh, h));
}

/// Calls `visit(v, u)` for the vertices v of a mesh and the neighbours u of each, as often as
/// `neighbours` names them, by one pass over `halfedges`: those of v in ascending half-edge id, not
/// in rotation. Where all rings are wanted and their order is not, this reads memory from end to
/// end instead of hopping through it.
///
/// Complexity O(halfedges); reads `origin` and `opposite`, and a stored `next`.
/// Threads    Ranges that partition the half-edges meet the same vertices: give each thread an
///            array of its own to add to, and add these up afterwards.
template <Topology Mesh, class Visit>
void for_each_neighbour(const Mesh& mesh, IndexRange halfedges, Visit&& visit) {
  const auto visit_edge = [&](HalfedgeId h, VertexId from, VertexId to) {
    visit(from, to);
    if (!mesh.opposite[h].valid()) visit(to, from);
  };
  Index i = halfedges.begin;
  if constexpr (std::is_same_v<Mesh, TriangleView>) {
    // Face by face there is no remainder to find.
    for (; i < halfedges.end && i % 3 != 0; ++i) {
      visit_edge(HalfedgeId(i), mesh.origin[HalfedgeId(i)], mesh.target(HalfedgeId(i)));
    }
    for (; i + 3 <= halfedges.end; i += 3) {
      const VertexId a = mesh.origin[HalfedgeId(i)];
      const VertexId b = mesh.origin[HalfedgeId(i + 1)];
      const VertexId c = mesh.origin[HalfedgeId(i + 2)];
      visit_edge(HalfedgeId(i), a, b);
      visit_edge(HalfedgeId(i + 1), b, c);
      visit_edge(HalfedgeId(i + 2), c, a);
    }
  }
  for (; i < halfedges.end; ++i) {
    visit_edge(HalfedgeId(i), mesh.origin[HalfedgeId(i)], mesh.target(HalfedgeId(i)));
  }
}

// A view that is not named would be gone before the range is used.
template <Rotation rotation = Rotation::clockwise, Topology Mesh>
void outgoing_halfedges(const Mesh&& mesh, VertexId v) = delete;
template <Topology Mesh>
void neighbours(const Mesh&& mesh, VertexId v) = delete;
template <Topology Mesh>
void incident_faces(const Mesh&& mesh, VertexId v) = delete;
template <FaceTopology Mesh>
void halfedges_from(const Mesh&& mesh, HalfedgeId h) = delete;
template <FaceTopology Mesh>
void halfedges(const Mesh&& mesh, FaceId f) = delete;
template <Topology Mesh>
void vertices(const Mesh&& mesh, FaceId f) = delete;
template <FaceTopology Mesh>
void adjacent_faces(const Mesh&& mesh, FaceId f) = delete;
template <FaceTopology Mesh>
void boundary_loop(const Mesh&& mesh, HalfedgeId h) = delete;

}  // namespace hedgerow
