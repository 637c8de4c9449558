// Edits that add and remove vertices and faces.
#include <algorithm>

#include "edit/edit.h"

namespace hedgerow {

EditCheck EditMesh::can_add_vertex() const { return EditTest(*this).has_room(1, 0, 0); }

EditResult EditMesh::add_vertex() {
  if (const EditCheck possible = can_add_vertex(); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  edit.add_vertex(VertexId());
  return edit.done();
}

namespace {

// The edge of two half-edges without a face goes; what was on either side of it is joined.
void remove_edge(Edit& edit, HalfedgeId h) {
  const HalfedgeId o = edit.opposite(h);
  for (const HalfedgeId side : {h, o}) {
    const HalfedgeId other = edit.opposite(side);
    const VertexId v = edit.origin(side);
    const HalfedgeId before = edit.prev(side);
    const HalfedgeId after = edit.next(other);
    if (before == other) {
      edit.set_outgoing(v, HalfedgeId());  // it was the last edge here
    } else {
      edit.link(before, after);
      if (edit.outgoing(v) == side) edit.set_outgoing(v, after);
    }
  }
  edit.remove(h);
  edit.remove(o);
}

EditCheck can_remove(const EditTest& test, FaceId f) {
  for (const VertexId v : vertices(test.view(), f)) {
    if (const EditCheck one = test.has_one_fan({v}); !one) return one;
  }
  return {};
}

void remove_one_face(Edit& edit, FaceId f) {
  const HalfedgeId start = edit.first(f);
  HalfedgeId h = start;
  do {
    edit.set_face(h, FaceId());
    edit.set_outgoing(edit.origin(h), h);  // of all at this vertex one on the boundary
    h = edit.next(h);
  } while (h != start);
  edit.remove(f);
  // Edges go in turn; the last one says when all have been looked at.
  const HalfedgeId last = edit.prev(start);
  for (bool is_last = false; !is_last;) {
    const HalfedgeId after = edit.next(h);
    is_last = h == last;
    if (!edit.face(edit.opposite(h)).valid()) remove_edge(edit, h);
    h = after;
  }
}

}  // namespace

EditCheck EditMesh::can_remove_face(FaceId f) const {
  if (!has(f)) return {Refusal::no_such_element, f.value};
  return can_remove(EditTest(*this), f);
}

EditResult EditMesh::remove_face(FaceId f) {
  if (const EditCheck possible = can_remove_face(f); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  remove_one_face(edit, f);
  return edit.done();
}

EditCheck EditMesh::can_remove_vertex(VertexId v) const {
  if (!has(v)) return {Refusal::no_such_element, v.value};
  const EditTest test(*this);
  for (const HalfedgeId h : outgoing_halfedges(test.view(), v)) {
    const FaceId f = test.view().face(h);
    const FaceId beyond = test.view().face(test.view().opposite[h]);
    if (!f.valid() && !beyond.valid()) return {Refusal::boundary, h.value};
    if (!f.valid()) continue;
    if (const EditCheck possible = can_remove(test, f); !possible) return possible;
  }
  return {};
}

EditResult EditMesh::remove_vertex(VertexId v) {
  if (const EditCheck possible = can_remove_vertex(v); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  // Each face takes the edges that it is the last on along.
  while (edit.outgoing(v).valid()) {
    HalfedgeId h = edit.outgoing(v);
    while (!edit.face(h).valid()) h = edit.clockwise(h);
    remove_one_face(edit, edit.face(h));
  }
  edit.remove(v);
  return edit.done();
}

// ---- add a face

namespace {

// A gap at the vertex of two boundary half-edges, in and out, that can take up what lies clockwise
// from in to out: it lies clockwise from out to in. The boundary half-edge that comes in there;
// invalid if there is none.
HalfedgeId other_gap(const EditView& mesh, HalfedgeId in, HalfedgeId out) {
  for (HalfedgeId g = mesh.next(mesh.opposite[out]); mesh.prev(g) != in;
       g = mesh.next(mesh.opposite[g])) {
    if (!mesh.face(g).valid()) return mesh.prev(g);
  }
  return {};
}

// Brings `out` behind `in` by moving the faces between them to another gap.
void bring_together(Edit& edit, const EditView& mesh, HalfedgeId in, HalfedgeId out) {
  const HalfedgeId before = other_gap(mesh, in, out);
  const HalfedgeId after = edit.next(before);
  const HalfedgeId patch_begin = edit.next(in);
  const HalfedgeId patch_end = edit.prev(out);
  edit.link(before, patch_begin);
  edit.link(patch_end, after);
  edit.link(in, out);
}

}  // namespace

EditCheck EditMesh::can_add_face(std::span<const VertexId> corners) const {
  const EditTest test(*this);
  const EditView& mesh = test.view();
  const std::size_t n = corners.size();
  if (n < 3) return {Refusal::too_few_corners, static_cast<Index>(n)};
  if (n > static_cast<std::size_t>(kMaxCount / 2)) return {Refusal::too_many, kMaxCount / 2};
  for (std::size_t i = 0; i < n; ++i) {
    if (!has(corners[i])) return {Refusal::no_such_element, corners[i].value};
    const auto again =
        std::find(corners.begin() + static_cast<std::ptrdiff_t>(i) + 1, corners.end(), corners[i]);
    if (again != corners.end()) return {Refusal::same_vertex, corners[i].value};
    if (const EditCheck one = test.has_one_fan({corners[i]}); !one) return one;
  }
  HalfedgeId in = find(corners[n - 1], corners[0]);
  for (std::size_t i = 0; i < n; ++i) {
    const HalfedgeId out = find(corners[i], corners[(i + 1) % n]);
    if (out.valid() && mesh.face(out).valid()) return {Refusal::boundary, out.value};
    const bool is_isolated = !mesh.outgoing[corners[i]].valid();
    if (!out.valid() && !is_isolated && !test.is_on_boundary(corners[i])) {
      return {Refusal::boundary, corners[i].value};
    }
    const bool is_apart = in.valid() && out.valid() && mesh.next(in) != out;
    if (is_apart && !other_gap(mesh, in, out).valid()) {
      return {Refusal::several_fans, corners[i].value};
    }
    in = out;
  }
  return test.has_room(0, 2 * static_cast<Index>(n), 1);
}

EditResult EditMesh::add_face(std::span<const VertexId> corners) {
  if (const EditCheck possible = can_add_face(corners); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  const std::size_t n = corners.size();
  const auto corner = [&](std::size_t i) { return corners[i % n]; };
  const Index new_begin = halfedge_count();
  const auto is_new = [&](HalfedgeId h) { return h.value >= new_begin; };
  const FaceId f = edit.add_face(HalfedgeId(), FaceId());
  HalfedgeId first;
  for (std::size_t i = 0; i < n; ++i) {
    HalfedgeId h = find(corner(i), corner(i + 1));
    if (!h.valid()) {
      h = edit.add_halfedge(corner(i), f);
      edit.pair(h, edit.add_halfedge(corner(i + 1), FaceId()));
    }
    // New half-edges are not found at their vertices before they are linked: ids tell them.
    edit.set_face(h, f);
    if (i == 0) first = h;
    sides_.push_back(h);
  }
  edit.set_first(f, first);
  for (std::size_t i = 0; i < n; ++i) {
    const HalfedgeId in = sides_[i];
    const HalfedgeId out = sides_[(i + 1) % n];
    const VertexId v = corner(i + 1);
    const HalfedgeId after_in = edit.opposite(in);     // leaves v
    const HalfedgeId before_out = edit.opposite(out);  // comes to v
    if (!is_new(in) && !is_new(out)) {
      if (edit.next(in) != out) bring_together(edit, view(), in, out);
    } else if (!is_new(out)) {
      edit.link(edit.prev(out), after_in);
    } else if (!is_new(in)) {
      edit.link(before_out, edit.next(in));
    } else if (edit.outgoing(v).valid()) {
      const HalfedgeId boundary = edit.outgoing(v);
      edit.link(edit.prev(boundary), after_in);
      edit.link(before_out, boundary);
    } else {
      edit.link(before_out, after_in);
    }
    edit.link(in, out);
  }
  for (std::size_t i = 0; i < n; ++i) edit.settle(corner(i), sides_[i]);
  sides_.clear();
  return edit.done();
}

}  // namespace hedgerow
