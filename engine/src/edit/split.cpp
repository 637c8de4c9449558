// Edits that turn an edge or make elements: flip, and the splits of edges, faces and vertices.
#include "edit/edit.h"
#include "kernels/plain_edit.h"

namespace hedgerow {

// ---- flip

EditCheck EditMesh::can_flip(HalfedgeId h) const {
  const EditTest test(*this);
  if (const EditCheck exists = test.has(h); !exists) return exists;
  const EditView& mesh = test.view();
  const HalfedgeId o = mesh.opposite[h];
  const FaceId f = mesh.face(h);
  const FaceId g = mesh.face(o);
  if (!f.valid() || !g.valid()) return {Refusal::boundary, h.value};
  if (f == g) return {Refusal::same_face, f.value};
  const HalfedgeId from_c = mesh.next(mesh.next(o));
  const HalfedgeId from_d = mesh.next(mesh.next(h));
  const VertexId c = mesh.origin[from_c];
  const VertexId d = mesh.origin[from_d];
  // Each face takes a vertex over from the other one.
  if (test.is_on_cycle(h, c)) return {Refusal::same_vertex, c.value};
  if (test.is_on_cycle(o, d)) return {Refusal::same_vertex, d.value};
  if (test.are_joined(from_c, from_d)) return {Refusal::duplicate_edge, find(c, d).value};
  return test.has_one_fan({mesh.origin[h], mesh.origin[o], c, d});
}

kernels::Flip Edit::flip_of(HalfedgeId h) const noexcept {
  const HalfedgeId o = opposite(h);
  return {h.value, outgoing(origin(h)) == h, outgoing(origin(o)) == o};
}

void Edit::flip(HalfedgeId h) {
  if (!m_.is_recording_) {
    // Half of the time is that of choosing the column for each entry.
    const kernels::Flip one = flip_of(h);
    kernels::scatter_flips({0, 1}, &one, columns(m_));
    return;
  }
  const HalfedgeId o = opposite(h);
  const HalfedgeId n = next(h);
  const HalfedgeId m = next(o);
  const HalfedgeId p = prev(h);
  const HalfedgeId q = prev(o);
  const FaceId f = face(h);
  const FaceId g = face(o);
  const VertexId a = origin(h);
  const VertexId b = origin(o);
  const VertexId c = target(m);
  const VertexId d = target(n);
  link(h, next(n));
  link(o, next(m));
  link(p, m);
  link(m, h);
  link(q, n);
  link(n, o);
  set_origin(h, c);
  set_origin(o, d);
  set_face(m, f);
  set_face(n, g);
  if (first(f) == n) set_first(f, h);
  if (first(g) == m) set_first(g, o);
  if (outgoing(a) == h) set_outgoing(a, m);
  if (outgoing(b) == o) set_outgoing(b, n);
}

EditResult EditMesh::flip(HalfedgeId h) {
  if (const EditCheck possible = can_flip(h); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  edit.flip(h);
  return edit.done();
}

// ---- splits

EditCheck EditMesh::can_insert_vertex(HalfedgeId h) const {
  const EditTest test(*this);
  if (const EditCheck exists = test.has(h); !exists) return exists;
  return test.has_room(1, 2, 0);
}

EditResult EditMesh::insert_vertex(HalfedgeId h) {
  if (const EditCheck possible = can_insert_vertex(h); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  kernels::insert_vertex(edit, h);
  return edit.done();
}

EditCheck EditMesh::can_split_edge(HalfedgeId h) const {
  const EditTest test(*this);
  if (const EditCheck exists = test.has(h); !exists) return exists;
  const EditView& mesh = test.view();
  const HalfedgeId o = mesh.opposite[h];
  const VertexId across = mesh.origin[mesh.prev(h)];
  const bool cuts_both =
      mesh.face(h).valid() && mesh.face(o).valid() && test.is_triangle(h) && test.is_triangle(o);
  if (cuts_both && across == mesh.origin[mesh.prev(o)]) {
    return {Refusal::duplicate_edge, mesh.prev(h).value};
  }
  return test.has_room(1, 6, 2);
}

EditResult EditMesh::split_edge(HalfedgeId h) {
  if (const EditCheck possible = can_split_edge(h); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  kernels::split_edge(edit, kernels::split_of(edit, h));
  return edit.done();
}

EditCheck EditMesh::can_split_face(FaceId f) const {
  if (!has(f)) return {Refusal::no_such_element, f.value};
  const Index n = view().degree(f);
  return EditTest(*this).has_room(1, n <= kMaxCount / 2 ? 2 * n : kMaxCount, n - 1);
}

EditResult EditMesh::split_face(FaceId f) {
  if (const EditCheck possible = can_split_face(f); !possible) return tl::unexpected(possible);
  const Index n = view().degree(f);
  Edit::make_room(*this, 1, 2 * n, n - 1, 0);
  const VertexId v(vertex_count());
  const HalfedgeId h(halfedge_count());
  const FaceId part(face_count());
  Edit edit(*this);
  if (is_recording_) {
    kernels::split_face(edit, f);
  } else {
    edit.grow(1, 2 * n, n - 1);
    kernels::PlainEdit plain(Edit::columns(*this), v, h, part);
    kernels::split_face(plain, f);
  }
  return edit.done();
}

EditCheck EditMesh::can_connect(HalfedgeId h, HalfedgeId g) const {
  const EditTest test(*this);
  for (const HalfedgeId side : {h, g}) {
    if (const EditCheck exists = test.has(side); !exists) return exists;
  }
  const EditView& mesh = test.view();
  if (!mesh.face(h).valid()) return {Refusal::boundary, h.value};
  if (mesh.face(h) != mesh.face(g)) return {Refusal::other_face, g.value};
  if (mesh.origin[h] == mesh.origin[g]) return {Refusal::same_vertex, mesh.origin[g].value};
  if (mesh.next(h) == g || mesh.next(g) == h) return {Refusal::adjacent, g.value};
  const HalfedgeId there = find(mesh.origin[h], mesh.origin[g]);
  if (there.valid()) return {Refusal::duplicate_edge, there.value};
  return test.has_room(0, 2, 1);
}

EditResult EditMesh::connect(HalfedgeId h, HalfedgeId g) {
  if (const EditCheck possible = can_connect(h, g); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  kernels::cut_face(edit, h, g);
  return edit.done();
}

EditCheck EditMesh::can_split_vertex(HalfedgeId h, HalfedgeId g) const {
  const EditTest test(*this);
  for (const HalfedgeId side : {h, g}) {
    if (const EditCheck exists = test.has(side); !exists) return exists;
  }
  const EditView& mesh = test.view();
  const VertexId v = mesh.origin[h];
  if (mesh.origin[g] != v) return {Refusal::not_a_path, g.value};
  if (h == g) return {Refusal::adjacent, g.value};
  if (const EditCheck one = test.has_one_fan({v}); !one) return one;
  return test.has_room(1, 2, 0);
}

EditResult EditMesh::split_vertex(HalfedgeId h, HalfedgeId g) {
  if (const EditCheck possible = can_split_vertex(h, g); !possible) {
    return tl::unexpected(possible);
  }
  Edit edit(*this);
  const VertexId v = edit.origin(h);
  const VertexId w = edit.add_vertex(v);
  const HalfedgeId before_h = edit.prev(h);
  const HalfedgeId before_g = edit.prev(g);
  const HalfedgeId there = edit.add_halfedge(v, edit.face(h));
  const HalfedgeId back = edit.add_halfedge(w, edit.face(g));
  for (HalfedgeId k = h; k != g; k = edit.clockwise(k)) edit.set_origin(k, w);
  edit.pair(there, back);
  edit.link(before_h, there);
  edit.link(there, h);
  edit.link(before_g, back);
  edit.link(back, g);
  edit.settle(w, back);
  edit.settle_if_needed(v, there);
  return edit.done();
}

}  // namespace hedgerow
