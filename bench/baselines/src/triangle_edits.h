#pragma once

#include "baselines/src/ring_algorithms.h"

/// Edits of both baseline meshes, as a textbook has them, written once over handles. `Mesh` also
/// writes: `link(h, g)` makes g the next of h, `pair(h, g)` makes them opposite (either may be
/// invalid), `set_vertex`, `set_face`, `set_first` and `set_outgoing` one field each, `add_...` and
/// `remove_...` elements.
///
/// All of them keep what the meshes promise: a vertex on the boundary knows the half-edge that
/// begins its open fan.
namespace hedgerow::baselines::detail {

/// Joins a new vertex at `position` to all corners of f. The first triangle stays f. O(degree).
template <class Mesh>
typename Mesh::Vertex split_face(Mesh& mesh, typename Mesh::Face f, const float* position) {
  using Handle = typename Mesh::Handle;
  const typename Mesh::Vertex center = mesh.add_vertex(position);
  const Handle start = mesh.first(f);
  Handle h = start;
  Handle first_out{};
  Handle before{};
  do {
    const Handle after = mesh.next(h);
    const auto face = h == start ? f : mesh.add_face();
    const Handle in = mesh.add_halfedge(mesh.vertex(after), face);
    const Handle out = mesh.add_halfedge(center, face);
    mesh.link(h, in);
    mesh.link(in, out);
    mesh.link(out, h);
    mesh.set_face(h, face);
    mesh.set_first(face, h);
    // What follows a half-edge on the boundary begins the fan where that ends.
    if (!mesh.is_valid(mesh.opposite(h))) mesh.set_outgoing(mesh.vertex(after), in);
    if (h == start) {
      first_out = out;
    } else {
      mesh.pair(before, out);
    }
    before = in;
    h = after;
  } while (h != start);
  mesh.pair(before, first_out);
  mesh.set_outgoing(center, first_out);
  return center;
}

/// Whether an edge runs between the origins of `from` and `to`: looks round that of `from`.
template <class Mesh>
bool has_edge(const Mesh& mesh, typename Mesh::Handle from, typename Mesh::Handle to) {
  bool is_found = false;
  const auto start = mesh.outgoing(mesh.vertex(from));
  for_each_outgoing(mesh, start, [&](typename Mesh::Handle h) {
    is_found |= mesh.vertex(mesh.next(h)) == mesh.vertex(to);
  });
  const auto last = mesh.prev(start);
  return is_found || (!mesh.is_valid(mesh.opposite(last)) && mesh.vertex(last) == mesh.vertex(to));
}

/// Whether the edge of h has a triangle on both sides, and its other diagonal is no edge yet.
template <class Mesh>
bool can_flip(const Mesh& mesh, typename Mesh::Handle h) {
  const auto o = mesh.opposite(h);
  return mesh.is_valid(o) && !has_edge(mesh, mesh.prev(h), mesh.prev(o));
}

/// Turns the edge of h to the other diagonal of its two triangles. \pre can_flip(mesh, h).
template <class Mesh>
void flip(Mesh& mesh, typename Mesh::Handle h) {
  const auto o = mesh.opposite(h);
  const auto h_next = mesh.next(h);
  const auto h_prev = mesh.next(h_next);
  const auto o_next = mesh.next(o);
  const auto o_prev = mesh.next(o_next);
  const auto a = mesh.vertex(h);
  const auto b = mesh.vertex(o);
  if (mesh.outgoing(a) == h) mesh.set_outgoing(a, o_next);
  if (mesh.outgoing(b) == o) mesh.set_outgoing(b, h_next);
  const auto left = mesh.vertex(h_prev);
  const auto right = mesh.vertex(o_prev);
  // What follows a half-edge on the boundary begins the fan where that ends.
  if (!mesh.is_valid(mesh.opposite(h_next))) mesh.set_outgoing(left, o);
  if (!mesh.is_valid(mesh.opposite(o_next))) mesh.set_outgoing(right, h);
  mesh.set_vertex(h, right);
  mesh.set_vertex(o, left);
  mesh.link(h, h_prev);
  mesh.link(h_prev, o_next);
  mesh.link(o_next, h);
  mesh.link(o, o_prev);
  mesh.link(o_prev, h_next);
  mesh.link(h_next, o);
  mesh.set_face(o_next, mesh.face_of(h));
  mesh.set_face(h_next, mesh.face_of(o));
  mesh.set_first(mesh.face_of(h), h);
  mesh.set_first(mesh.face_of(o), o);
}

/// Moves the origin of h into its target: the edge and the triangles on it are gone.
/// \pre All faces at the origin of h are triangles and none of its edges is on the boundary; the
///      link condition holds.
template <class Mesh>
void collapse(Mesh& mesh, typename Mesh::Handle h) {
  const auto o = mesh.opposite(h);
  const auto h_next = mesh.next(h);
  const auto h_prev = mesh.next(h_next);
  const auto o_next = mesh.next(o);
  const auto o_prev = mesh.next(o_next);
  const auto gone = mesh.vertex(h);
  const auto kept = mesh.vertex(o);
  for_each_outgoing(mesh, h, [&](typename Mesh::Handle side) { mesh.set_vertex(side, kept); });
  // Across the two triangles, what is left of them becomes one edge each.
  const auto beyond_left = mesh.opposite(h_prev);
  const auto beyond_right = mesh.opposite(o_next);
  mesh.pair(beyond_left, mesh.opposite(h_next));
  mesh.pair(beyond_right, mesh.opposite(o_prev));
  const auto left = mesh.vertex(h_prev);
  const auto right = mesh.vertex(o_prev);
  if (mesh.outgoing(left) == h_prev) mesh.set_outgoing(left, mesh.next(beyond_left));
  if (mesh.outgoing(right) == o_prev) mesh.set_outgoing(right, beyond_right);
  if (mesh.outgoing(kept) == o) mesh.set_outgoing(kept, mesh.next(beyond_right));
  if (mesh.outgoing(kept) == h_next) mesh.set_outgoing(kept, beyond_left);
  mesh.remove_face(mesh.face_of(h));
  mesh.remove_face(mesh.face_of(o));
  for (const auto side : {h, h_next, h_prev, o, o_next, o_prev}) mesh.remove_halfedge(side);
  mesh.remove_vertex(gone);
}

}  // namespace hedgerow::baselines::detail
