// Cutting a mesh open along a path, and sewing it together again.
#include "edit/edit.h"

namespace hedgerow {

EditCheck EditMesh::can_cut(std::span<const HalfedgeId> path) const {
  const EditTest test(*this);
  const EditView& mesh = test.view();
  if (path.empty()) return {Refusal::not_a_path, kInvalidIndex};
  for (const HalfedgeId h : path) {
    if (const EditCheck exists = test.has(h); !exists) return exists;
    if (!mesh.face(h).valid() || !mesh.face(mesh.opposite[h]).valid()) {
      return {Refusal::boundary, h.value};
    }
    const EditCheck one = test.has_one_fan({mesh.origin[h], mesh.target(h)});
    if (!one) return one;
  }
  const VertexId begin = mesh.origin[path.front()];
  const VertexId end = mesh.target(path.back());
  const bool is_ring = begin == end;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const VertexId v = mesh.target(path[i]);
    const bool is_last = i + 1 == path.size();
    if (!is_last && mesh.origin[path[i + 1]] != v) return {Refusal::not_a_path, path[i + 1].value};
    if ((!is_last || is_ring) && test.is_on_boundary(v)) return {Refusal::boundary, v.value};
    for (std::size_t j = 0; j < i; ++j) {
      if (mesh.target(path[j]) == v) return {Refusal::not_a_path, path[i].value};
    }
    if (!is_last && v == begin) return {Refusal::not_a_path, path[i].value};
  }
  // There and back along one edge.
  if (is_ring && path.size() == 2) return {Refusal::not_a_path, path[1].value};
  for (const VertexId v : {begin, end}) {
    if (test.gaps(v) > 1) return {Refusal::several_fans, v.value};
  }
  // Both halves of a single edge would join the same two vertices.
  if (path.size() == 1 && !test.is_on_boundary(begin) && !test.is_on_boundary(end)) {
    return {Refusal::duplicate_edge, path[0].value};
  }
  const auto count = static_cast<Index>(path.size());
  return test.has_room(count + 1, 2 * count, 0);
}

namespace {

// Each edge of the path gets two half-edges without face: `left[i]` behind path[i], `right[i]`
// behind its opposite. They are numbered in pairs from `first` on.
struct Slit {
  Index first;

  [[nodiscard]] HalfedgeId left(std::size_t i) const noexcept {
    return HalfedgeId(first + 2 * static_cast<Index>(i));
  }
  [[nodiscard]] HalfedgeId right(std::size_t i) const noexcept {
    return HalfedgeId(first + 2 * static_cast<Index>(i) + 1);
  }
};

// The half-edges that leave v on the right go to a vertex of their own: clockwise from `begin` up
// to, and without, `end`.
void double_vertex(Edit& edit, HalfedgeId begin, HalfedgeId end, HalfedgeId new_start) {
  const VertexId v = edit.origin(begin);
  const VertexId w = edit.add_vertex(v);
  HalfedgeId h = begin;
  do {
    const HalfedgeId after = edit.clockwise(h);
    edit.set_origin(h, w);
    h = after;
  } while (h != end);
  edit.set_origin(new_start, w);
  edit.set_outgoing(w, new_start);
}

}  // namespace

EditResult EditMesh::cut(std::span<const HalfedgeId> path) {
  if (const EditCheck possible = can_cut(path); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  const std::size_t n = path.size();
  const Slit slit{halfedge_count()};
  const VertexId begin = edit.origin(path.front());
  const VertexId end = edit.target(path.back());
  const bool is_ring = begin == end;
  const HalfedgeId gap_at_begin = edit.outgoing(begin);
  const HalfedgeId gap_at_end = edit.outgoing(end);
  const bool is_begin_open = !edit.face(gap_at_begin).valid();
  const bool is_end_open = !edit.face(gap_at_end).valid();
  for (const HalfedgeId h : path) {
    edit.add_halfedge(edit.target(h), FaceId(), edit.opposite(h));
    edit.add_halfedge(edit.origin(h), FaceId(), h);
  }
  // Vertices are doubled while the rotations still are as before.
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_passed = i > 0 || is_ring;
    const HalfedgeId in = path[i > 0 ? i - 1 : n - 1];
    if (is_passed) {
      double_vertex(edit, edit.clockwise(path[i]), edit.clockwise(edit.opposite(in)),
                    slit.right(i));
    } else if (is_begin_open) {
      double_vertex(edit, edit.clockwise(path[0]), gap_at_begin, slit.right(0));
    }
  }
  HalfedgeId last_right = slit.left(n - 1);  // where the right side turns round at the end
  if (!is_ring && is_end_open) {
    double_vertex(edit, gap_at_end, edit.clockwise(edit.opposite(path[n - 1])), gap_at_end);
    last_right = gap_at_end;
  }
  const HalfedgeId into_begin = edit.prev(gap_at_begin);
  const HalfedgeId into_end = edit.prev(gap_at_end);
  for (std::size_t i = 0; i < n; ++i) {
    const HalfedgeId across = edit.opposite(path[i]);
    edit.pair(path[i], slit.left(i));
    edit.pair(across, slit.right(i));
  }
  for (std::size_t i = 1; i < n; ++i) {
    edit.link(slit.left(i), slit.left(i - 1));
    edit.link(slit.right(i - 1), slit.right(i));
  }
  if (is_ring) {
    edit.link(slit.left(0), slit.left(n - 1));
    edit.link(slit.right(n - 1), slit.right(0));
  } else {
    if (is_begin_open) {
      edit.link(into_begin, slit.right(0));
      edit.link(slit.left(0), gap_at_begin);
    } else {
      edit.link(slit.left(0), slit.right(0));
    }
    if (is_end_open) edit.link(into_end, slit.left(n - 1));
    edit.link(slit.right(n - 1), last_right);
  }
  for (const HalfedgeId h : path) edit.settle_if_needed(edit.origin(h), h);
  edit.settle_if_needed(end, slit.left(n - 1));
  return edit.done();
}

EditCheck EditMesh::can_zip(HalfedgeId h) const {
  const EditTest test(*this);
  if (const EditCheck exists = test.has(h); !exists) return exists;
  const EditView& mesh = test.view();
  if (mesh.face(h).valid()) return {Refusal::boundary, h.value};
  const HalfedgeId g = mesh.next(h);
  const VertexId a = mesh.origin[h];
  const VertexId c = mesh.target(g);
  if (a == c) return {Refusal::same_vertex, a.value};
  if (const EditCheck one = test.has_one_fan({a, mesh.origin[g], c}); !one) return one;
  for (const VertexId v : {a, c}) {
    if (test.gaps(v) > 1) return {Refusal::several_fans, v.value};
  }
  if (find(a, c).valid()) return {Refusal::adjacent, c.value};
  const HalfedgeId n = mesh.next(g);
  const bool closes = mesh.next(n) == mesh.prev(h) && mesh.next(mesh.next(n)) == h;
  const VertexId across = closes ? mesh.target(n) : VertexId();
  for (const HalfedgeId from_c : outgoing_halfedges(mesh, c)) {
    const VertexId v = mesh.target(from_c);
    if (v == mesh.origin[g] || v == across) continue;
    if (find(a, v).valid()) return {Refusal::link_condition, v.value};
  }
  if (across.valid()) {
    if (const EditCheck one = test.has_one_fan({across}); !one) return one;
  }
  if (test.have_face(a, c, FaceId(), FaceId())) return {Refusal::same_vertex, c.value};
  return {};
}

EditResult EditMesh::zip(HalfedgeId h) {
  if (const EditCheck possible = can_zip(h); !possible) return tl::unexpected(possible);
  Edit edit(*this);
  const HalfedgeId g = edit.next(h);
  const HalfedgeId p = edit.prev(h);
  const HalfedgeId n = edit.next(g);
  const VertexId a = edit.origin(h);
  const VertexId v = edit.origin(g);
  const VertexId c = edit.target(g);
  const HalfedgeId to_a = edit.opposite(h);    // leaves v
  const HalfedgeId from_a = edit.opposite(g);  // left c
  HalfedgeId k = from_a;
  do {
    const HalfedgeId after = edit.clockwise(k);
    edit.set_origin(k, a);
    k = after;
  } while (k != from_a);
  edit.link(p, n);
  edit.pair(to_a, from_a);
  edit.remove(h);
  edit.remove(g);
  edit.remove(c);
  edit.settle_if_needed(v, to_a);
  // Of two dangling edges one is left: its two sides are no hole.
  if (edit.next(n) != p || edit.opposite(n) == p) {
    edit.settle_if_needed(a, from_a);
    return edit.done();
  }
  // What is left of the hole has two sides, which are one edge.
  const HalfedgeId beyond_n = edit.opposite(n);
  const HalfedgeId beyond_p = edit.opposite(p);
  const VertexId w = edit.origin(p);
  edit.pair(beyond_n, beyond_p);
  edit.remove(n);
  edit.remove(p);
  edit.settle_if_needed(a, from_a);
  edit.settle_if_needed(w, beyond_n);
  return edit.done();
}

}  // namespace hedgerow
