#pragma once

#include "hedgerow/index.h"

/// What edits do to the mesh, written once for those that keep a record (`Edit`) and those that do
/// not (`PlainEdit`).
namespace hedgerow::kernels {

/// The vertex starts its rotation at `h`, or on the boundary if it has one (I6).
template <class Edit>
void settle(Edit& edit, VertexId v, HalfedgeId h) {
  HalfedgeId g = h;
  do {
    if (!edit.face(g).valid()) {
      edit.set_outgoing(v, g);
      return;
    }
    g = edit.clockwise(g);
  } while (g != h);
  edit.set_outgoing(v, h);
}

/// The same if it starts on the boundary no longer, or at a half-edge that is gone.
template <class Edit>
void settle_if_needed(Edit& edit, VertexId v, HalfedgeId h) {
  const HalfedgeId start = edit.outgoing(v);
  const bool leaves = start.valid() && edit.next(start).valid() && edit.origin(start) == v;
  if (leaves && !edit.face(start).valid()) return;
  settle(edit, v, leaves ? start : h);
}

/// A half-edge whose origin moves into its target, and what depends on entries that collapses
/// beside it may write.
struct Collapse {
  struct Side {
    bool is_triangle;  ///< which goes
    bool starts;       ///< its half-edge that ends at this one is the `outgoing` of its origin
  };
  HalfedgeId halfedge;
  Side left;
  Side right;
};
template <class Edit>
[[nodiscard]] bool is_triangle(const Edit& edit, HalfedgeId h) noexcept {
  return edit.face(h).valid() && edit.next(edit.next(edit.next(h))) == h;
}
template <class Edit>
[[nodiscard]] Collapse collapse_of(const Edit& edit, HalfedgeId h) noexcept {
  const auto side = [&](HalfedgeId g) -> Collapse::Side {
    const HalfedgeId p = edit.prev(g);
    return {is_triangle(edit, g), edit.outgoing(edit.origin(p)) == p};
  };
  return {h, side(h), side(edit.opposite(h))};
}

// Sews the two sides of what is left of a triangle after its edge went: n and its next.
template <class Edit>
void close_side(Edit& edit, HalfedgeId n, bool starts_across) {
  const HalfedgeId p = edit.next(n);
  const HalfedgeId beyond_n = edit.opposite(n);
  const HalfedgeId beyond_p = edit.opposite(p);
  const VertexId across = edit.origin(p);
  const VertexId b = edit.origin(n);
  const FaceId f = edit.face(n);
  edit.pair(beyond_n, beyond_p);
  edit.remove(n);
  edit.remove(p);
  edit.remove(f);
  // What goes had a face, so that where it stood there is no boundary half-edge to stand.
  if (starts_across) edit.set_outgoing(across, beyond_n);
  if (edit.outgoing(b) == n) edit.set_outgoing(b, beyond_p);
}

/// Moves the origin of a half-edge into its target. \pre EditMesh::can_collapse
template <class Edit>
void collapse_edge(Edit& edit, const Collapse& collapse) {
  const HalfedgeId h = collapse.halfedge;
  const HalfedgeId o = edit.opposite(h);
  const HalfedgeId n = edit.next(h);
  const HalfedgeId m = edit.next(o);
  const VertexId a = edit.origin(h);
  const VertexId b = edit.origin(o);
  const FaceId f = edit.face(h);
  const FaceId g = edit.face(o);
  HalfedgeId k = h;
  do {
    const HalfedgeId after = edit.clockwise(k);
    edit.set_origin(k, b);
    k = after;
  } while (k != h);
  edit.link(edit.prev(h), n);
  edit.link(edit.prev(o), m);
  if (f.valid() && edit.first(f) == h) edit.set_first(f, n);
  if (g.valid() && edit.first(g) == o) edit.set_first(g, m);
  // The boundary of either end is that of both, and no more than one half-edge of it leaves each.
  const HalfedgeId start = edit.outgoing(a);
  if (start != h && !edit.face(start).valid()) {
    edit.set_outgoing(b, start);
  } else if (edit.outgoing(b) == o) {
    edit.set_outgoing(b, n);
  }
  edit.remove(h);
  edit.remove(o);
  edit.remove(a);
  if (collapse.left.is_triangle) close_side(edit, n, collapse.left.starts);
  if (collapse.right.is_triangle) close_side(edit, m, collapse.right.starts);
}

/// A vertex on the edge of h, which ends there. Returns the half-edge that goes on from it.
template <class Edit>
HalfedgeId insert_vertex(Edit& edit, HalfedgeId h) {
  const HalfedgeId o = edit.opposite(h);
  const VertexId v = edit.add_vertex(edit.origin(h), edit.origin(o));
  const HalfedgeId on = edit.add_halfedge(v, edit.face(h), h);
  const HalfedgeId back = edit.add_halfedge(v, edit.face(o), o);
  const HalfedgeId n = edit.next(h);
  const HalfedgeId m = edit.next(o);
  edit.link(on, n);
  edit.link(back, m);
  edit.link(h, on);
  edit.link(o, back);
  edit.pair(h, back);
  edit.pair(on, o);
  edit.set_outgoing(v, edit.face(on).valid() && !edit.face(back).valid() ? back : on);
  return on;
}

/// An edge between the origins of h and g, which are in one face: that keeps what follows h.
template <class Edit>
void cut_face(Edit& edit, HalfedgeId h, HalfedgeId g) {
  const FaceId f = edit.face(h);
  const HalfedgeId before_h = edit.prev(h);
  const HalfedgeId before_g = edit.prev(g);
  const HalfedgeId there = edit.add_halfedge(edit.origin(h), f);
  const HalfedgeId back = edit.add_halfedge(edit.origin(g), f);
  edit.pair(there, back);
  edit.link(before_g, back);
  edit.link(back, h);
  edit.link(before_h, there);
  edit.link(there, g);
  const FaceId cut_off = edit.add_face(g, f);
  for (HalfedgeId k = there; k != before_h; k = edit.next(k)) edit.set_face(k, cut_off);
  edit.set_face(before_h, cut_off);
  if (edit.face(edit.first(f)) != f) edit.set_first(f, h);
}

/// A vertex within f, joined to all its corners. The triangle of `first(f)` stays f.
template <class Edit>
void split_face(Edit& edit, FaceId f) {
  const HalfedgeId start = edit.first(f);
  const VertexId v = edit.add_vertex(edit.origin(start));
  HalfedgeId h = start;
  FaceId part = f;
  const HalfedgeId first_in = edit.add_halfedge(edit.origin(h), FaceId());
  HalfedgeId in = first_in;  // from the origin of h to v; belongs to the part before
  do {
    const HalfedgeId after = edit.next(h);
    const HalfedgeId out = edit.add_halfedge(v, part);
    edit.pair(in, out);
    const HalfedgeId next_in =
        after == start ? first_in : edit.add_halfedge(edit.origin(after), part);
    edit.set_face(next_in, part);
    edit.set_face(h, part);
    edit.link(out, h);
    edit.link(h, next_in);
    edit.link(next_in, out);
    if (h == start) edit.set_outgoing(v, out);
    if (after != start) part = edit.add_face(after, f);
    in = next_in;
    h = after;
  } while (h != start);
}

/// An edge that gets a vertex, and which of its sides are triangles, which are cut.
struct Split {
  HalfedgeId halfedge;
  bool cuts_left;
  bool cuts_right;
  // In a batch, the numbers from which on its new elements are counted.
  VertexId vertex = {};
  HalfedgeId new_halfedge = {};
  FaceId face = {};

  [[nodiscard]] Index new_faces() const noexcept { return Index{cuts_left} + Index{cuts_right}; }
  [[nodiscard]] Index new_halfedges() const noexcept { return 2 + 2 * new_faces(); }
};
template <class Edit>
[[nodiscard]] Split split_of(const Edit& edit, HalfedgeId h) noexcept {
  return {h, is_triangle(edit, h), is_triangle(edit, edit.opposite(h))};
}

/// A vertex on an edge, joined to the one across in each triangle. \pre EditMesh::can_split_edge
template <class Edit>
void split_edge(Edit& edit, const Split& split) {
  const HalfedgeId h = split.halfedge;
  const HalfedgeId o = edit.opposite(h);
  const HalfedgeId on = insert_vertex(edit, h);
  if (split.cuts_left) cut_face(edit, on, edit.prev(h));
  if (split.cuts_right) cut_face(edit, edit.opposite(h), edit.prev(o));
}

}  // namespace hedgerow::kernels
