// Edits that take an edge away: collapse, and joining two faces.
#include <cstdint>

#include "edit/edit.h"
#include "kernels/scatter_edits.h"

namespace hedgerow {

EditCheck EditMesh::can_join_faces(HalfedgeId h) const {
  const EditTest test(*this);
  if (const EditCheck exists = test.has(h); !exists) return exists;
  const EditView& mesh = test.view();
  const HalfedgeId o = mesh.opposite[h];
  const FaceId f = mesh.face(h);
  const FaceId g = mesh.face(o);
  if (!f.valid() || !g.valid()) return {Refusal::boundary, h.value};
  if (f == g) return {Refusal::same_face, f.value};
  const VertexId a = mesh.origin[h];
  const VertexId b = mesh.origin[o];
  for (const VertexId v : vertices(mesh, g)) {
    if (v != a && v != b && test.is_in(f, v)) return {Refusal::same_vertex, v.value};
  }
  return test.has_one_fan({a, b});
}

EditResult EditMesh::join_faces(HalfedgeId h) {
  if (const EditCheck possible = can_join_faces(h); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  const HalfedgeId o = edit.opposite(h);
  const HalfedgeId n = edit.next(h);
  const HalfedgeId m = edit.next(o);
  const FaceId f = edit.face(h);
  const FaceId g = edit.face(o);
  const VertexId a = edit.origin(h);
  const VertexId b = edit.origin(o);
  edit.give(m, o, f);
  edit.link(edit.prev(h), m);
  edit.link(edit.prev(o), n);
  if (edit.first(f) == h) edit.set_first(f, n);
  if (edit.outgoing(a) == h) edit.set_outgoing(a, m);
  if (edit.outgoing(b) == o) edit.set_outgoing(b, n);
  edit.remove(h);
  edit.remove(o);
  edit.remove(g);
  return edit.done();
}

namespace {

// The vertex across the edge of h if that side is a triangle.
VertexId apex(const EditTest& test, HalfedgeId h) {
  return test.is_triangle(h) ? test.view().origin[test.view().prev(h)] : VertexId();
}

// A triangle whose two other edges are on the boundary would leave an edge without a face.
bool would_dangle(const EditTest& test, HalfedgeId h) {
  const EditView& mesh = test.view();
  if (!test.is_triangle(h)) return false;
  const FaceId beyond_next = mesh.face(mesh.opposite[mesh.next(h)]);
  const FaceId beyond_prev = mesh.face(mesh.opposite[mesh.prev(h)]);
  return !beyond_next.valid() && !beyond_prev.valid();
}

// One of 64, of numbers that may lie close together.
std::uint64_t bit_of(VertexId v) {
  return std::uint64_t{1} << (static_cast<std::uint64_t>(v.value) * 0x9e3779b97f4a7c15U >> 58U);
}

// A neighbour that both ends have is a duplicate edge, unless the triangle between goes.
EditCheck test_neighbours(const EditTest& test, HalfedgeId h) {
  const EditView& mesh = test.view();
  const VertexId a = mesh.origin[h];
  const VertexId b = mesh.target(h);
  const VertexId left = apex(test, h);
  const VertexId right = apex(test, mesh.opposite[h]);
  for (const HalfedgeId to_b : outgoing_halfedges(mesh, b)) {
    const VertexId v = mesh.target(to_b);
    if (v == a || v == left || v == right) continue;
    for (const HalfedgeId to_a : outgoing_halfedges(mesh, a)) {
      if (mesh.target(to_a) == v) return {Refusal::link_condition, v.value};
    }
  }
  return {};
}

// A triangle at a whose third edge has a triangle with b on the other side.
EditCheck test_triangles(const EditTest& test, HalfedgeId h) {
  const EditView& mesh = test.view();
  const VertexId b = mesh.target(h);
  const FaceId f = mesh.face(h);
  const FaceId g = mesh.face(mesh.opposite[h]);
  for (const HalfedgeId out : outgoing_halfedges(mesh, mesh.origin[h])) {
    const FaceId at = mesh.face(out);
    if (!at.valid() || at == f || at == g || !test.is_triangle(out)) continue;
    const HalfedgeId beyond = mesh.opposite[mesh.next(out)];
    if (mesh.face(beyond).valid() && apex(test, beyond) == b) {
      return {Refusal::duplicate_face, mesh.face(beyond).value};
    }
  }
  return {};
}

// The answer of all tests together where it is yes on a mesh of triangles, `a` has faces all round,
// and nobody is both its neighbour and that of b but the two across the edge: in one walk round
// `a`, and one round b if anything is left to compare.
bool collapses_plainly(const EditTest& test, HalfedgeId h) {
  const EditView& mesh = test.view();
  const HalfedgeId o = mesh.opposite[h];
  const VertexId a = mesh.origin[h];
  const VertexId b = mesh.origin[o];
  if (!mesh.fans.empty() || test.is_on_boundary(a)) return false;
  const VertexId left = mesh.origin[mesh.prev(h)];
  const VertexId right = mesh.origin[mesh.prev(o)];
  if (left == right || !test.is_triangle(h) || !test.is_triangle(o) || !mesh.face(h).valid()) {
    return false;
  }
  const HalfedgeId end = mesh.prev(h);  // enters `a` beside h: the last one is opposite to it
  HalfedgeId out = test.clockwise(h);
  std::uint64_t neighbours = 0;  // a set with errors: what is not in it is none
  for (HalfedgeId in = HalfedgeId(); in != end; out = mesh.next(in)) {
    in = mesh.opposite[out];
    const HalfedgeId third = mesh.next(out);
    const VertexId v = mesh.origin[third];
    if (v != right && v != left) neighbours |= bit_of(v);
    if (out == mesh.next(o)) continue;  // in the face of o
    const HalfedgeId beyond = mesh.opposite[third];
    if (v == b || !test.is_triangle(out) || !mesh.face(out).valid() ||
        mesh.origin[mesh.prev(beyond)] == b) {
      return false;
    }
  }
  const bool may_have_gaps = test.is_on_boundary(b);
  if (neighbours == 0 && !may_have_gaps) return true;
  Index gaps = 0;
  HalfedgeId to = o;
  do {
    const VertexId v = mesh.target(to);
    if ((neighbours & bit_of(v)) != 0 && v != a && v != left && v != right) return false;
    gaps += Index{!mesh.face(to).valid()};
    to = test.clockwise(to);
  } while (to != o);
  return gaps <= 1;
}

}  // namespace

EditCheck EditMesh::can_collapse(HalfedgeId h) const {
  const EditTest test(*this);
  if (const EditCheck exists = test.has(h); !exists) return exists;
  if (collapses_plainly(test, h)) return {};
  const EditView& mesh = test.view();
  const HalfedgeId o = mesh.opposite[h];
  const VertexId a = mesh.origin[h];
  const VertexId b = mesh.origin[o];
  const FaceId f = mesh.face(h);
  const FaceId g = mesh.face(o);
  if (!f.valid() && !g.valid()) return {Refusal::boundary, h.value};
  const VertexId left = apex(test, h);
  const VertexId right = apex(test, o);
  if (const EditCheck one = test.has_one_fan({a, b}); !one) return one;
  for (const VertexId v : {left, right}) {
    if (!v.valid()) continue;
    if (const EditCheck one = test.has_one_fan({v}); !one) return one;
  }
  const bool is_inner = f.valid() && g.valid();
  if (is_inner && test.is_on_boundary(a) && test.is_on_boundary(b)) {
    return {Refusal::several_fans, b.value};
  }
  for (const VertexId v : {a, b}) {
    if (test.gaps(v) > 1) return {Refusal::several_fans, v.value};
  }
  // A hole of three edges would be gone, and with it a boundary loop.
  for (const HalfedgeId side : {h, o}) {
    if (!mesh.face(side).valid() && test.is_triangle(side)) return {Refusal::boundary, side.value};
  }
  if (would_dangle(test, h) || would_dangle(test, o)) return {Refusal::boundary, h.value};
  if (left.valid() && left == right) return {Refusal::link_condition, left.value};
  if (const EditCheck apart = test_neighbours(test, h); !apart) return apart;
  if (const EditCheck distinct = test_triangles(test, h); !distinct) return distinct;
  if (test.have_face(a, b, f, g)) return {Refusal::same_vertex, b.value};
  return {};
}

EditResult EditMesh::collapse(HalfedgeId h) {
  if (const EditCheck possible = can_collapse(h); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  const kernels::Collapse collapse = kernels::collapse_of(edit, h);
  if (is_recording_) {
    kernels::collapse_edge(edit, collapse);
  } else {
    kernels::scatter_collapses({0, 1}, &collapse, Edit::columns(*this));
  }
  return edit.done();
}

}  // namespace hedgerow
