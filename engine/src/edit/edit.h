#pragma once

#include <initializer_list>

#include "hedgerow/circulate.h"
#include "hedgerow/edit.h"
#include "kernels/flip_edges.h"
#include "kernels/local_edits.h"

namespace hedgerow {

/// Old to new numbers, each kind in ascending order; kInvalidIndex for what was removed.
struct PackedIds {
  Buffer<Index> vertices;
  Buffer<Index> halfedges;
  Buffer<Index> faces;
};

/// One edit under way: reads and writes the columns of a mesh, and keeps the record of it. What it
/// is asked to do has been found possible.
class Edit {
 public:
  explicit Edit(EditMesh& mesh) noexcept;

  [[nodiscard]] VertexId origin(HalfedgeId h) const noexcept { return VertexId(m_.origin_[i(h)]); }
  [[nodiscard]] VertexId target(HalfedgeId h) const noexcept { return origin(opposite(h)); }
  [[nodiscard]] HalfedgeId opposite(HalfedgeId h) const noexcept {
    return HalfedgeId(m_.opposite_[i(h)]);
  }
  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept { return HalfedgeId(m_.next_[i(h)]); }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept { return HalfedgeId(m_.prev_[i(h)]); }
  [[nodiscard]] FaceId face(HalfedgeId h) const noexcept { return FaceId(m_.face_[i(h)]); }
  [[nodiscard]] HalfedgeId first(FaceId f) const noexcept { return HalfedgeId(m_.first_[i(f)]); }
  [[nodiscard]] HalfedgeId outgoing(VertexId v) const noexcept {
    return HalfedgeId(m_.outgoing_[i(v)]);
  }
  /// The next half-edge that leaves the same vertex.
  [[nodiscard]] HalfedgeId clockwise(HalfedgeId h) const noexcept { return next(opposite(h)); }

  void set_origin(HalfedgeId h, VertexId v) { set(EditColumn::origin, h.value, v.value); }
  void set_face(HalfedgeId h, FaceId f) { set(EditColumn::face, h.value, f.value); }
  void set_first(FaceId f, HalfedgeId h) { set(EditColumn::first, f.value, h.value); }
  void set_outgoing(VertexId v, HalfedgeId h) { set(EditColumn::outgoing, v.value, h.value); }
  /// `g` follows `h`.
  void link(HalfedgeId h, HalfedgeId g) {
    set(EditColumn::next, h.value, g.value);
    set(EditColumn::prev, g.value, h.value);
  }
  /// They are opposite.
  void pair(HalfedgeId h, HalfedgeId o) {
    set(EditColumn::opposite, h.value, o.value);
    set(EditColumn::opposite, o.value, h.value);
  }
  /// Gives the half-edges from `begin` up to, and without, `end` to the face.
  void give(HalfedgeId begin, HalfedgeId end, FaceId f);

  VertexId add_vertex(VertexId source, VertexId other = {});
  HalfedgeId add_halfedge(VertexId origin, FaceId face, HalfedgeId source = {});
  FaceId add_face(HalfedgeId first, FaceId source);
  void remove(VertexId v);
  void remove(HalfedgeId h);
  void remove(FaceId f);

  /// Turns the edge of h by one corner. \pre can_flip
  void flip(HalfedgeId h);
  /// For many at once, without a record.
  [[nodiscard]] kernels::Flip flip_of(HalfedgeId h) const noexcept;
  [[nodiscard]] static kernels::EditColumns columns(EditMesh& mesh) noexcept;
  /// Room for so many more elements, and for records of `writes` changes; throws before any change.
  static void make_room(EditMesh& mesh, Index vertices, Index halfedges, Index faces,
                        std::size_t writes);
  /// So many more elements, all of their entries to be filled.
  void grow(Index vertices, Index halfedges, Index faces) noexcept;

  /// Numbers what is left anew, in its order and in place: unlike `EditMesh::compact` half-edges,
  /// too. Records of before are of another mesh. Throws std::bad_alloc before any change.
  [[nodiscard]] static PackedIds pack(EditMesh& mesh);

  void settle(VertexId v, HalfedgeId h) { kernels::settle(*this, v, h); }
  void settle_if_needed(VertexId v, HalfedgeId h) { kernels::settle_if_needed(*this, v, h); }

  EditResult done();

 private:
  template <class Id>
  static std::size_t i(Id id) noexcept {
    return static_cast<std::size_t>(id.value);
  }
  void set(EditColumn column, Index index, Index value);
  void note_birth(const Birth& birth);
  void note_death(const Death& death);

  EditMesh& m_;
};

/// What the questions before an edit are made of.
class EditTest {
 public:
  explicit EditTest(const EditMesh& mesh) noexcept : view_(mesh.view()) {}

  [[nodiscard]] const EditView& view() const noexcept { return view_; }
  [[nodiscard]] EditCheck has(HalfedgeId h) const noexcept {
    const bool exists = h.value >= 0 && h.value < view_.halfedge_count() && view_.next(h).valid();
    return exists ? EditCheck{} : EditCheck{Refusal::no_such_element, h.value};
  }
  /// That there is room for so many more.
  [[nodiscard]] EditCheck has_room(Index vertices, Index halfedges, Index faces) const noexcept {
    const bool fits = vertices <= kMaxCount - view_.vertex_count() &&
                      halfedges <= kMaxCount - view_.halfedge_count() &&
                      faces <= kMaxCount - view_.face_count();
    return fits ? EditCheck{} : EditCheck{Refusal::too_many, kMaxCount};
  }
  [[nodiscard]] EditCheck has_one_fan(std::initializer_list<VertexId> vertices) const noexcept {
    if (view_.fans.empty()) return {};
    for (const VertexId v : vertices) {
      if (!extra_fans(view_.fans, v).empty()) return {Refusal::several_fans, v.value};
    }
    return {};
  }
  [[nodiscard]] bool is_in(FaceId f, VertexId v) const noexcept {
    return is_on_cycle(view_.first(f), v);
  }
  /// Whether some half-edge of the cycle of h leaves `v`.
  [[nodiscard]] bool is_on_cycle(HalfedgeId h, VertexId v) const noexcept {
    HalfedgeId k = h;
    do {
      if (view_.origin[k] == v) return true;
      k = view_.next(k);
    } while (k != h);
    return false;
  }
  [[nodiscard]] bool is_triangle(HalfedgeId h) const noexcept {
    return view_.next(view_.next(view_.next(h))) == h;
  }
  [[nodiscard]] bool is_on_boundary(VertexId v) const noexcept {
    return view_.outgoing[v].valid() && !view_.face(view_.outgoing[v]).valid();
  }
  /// The next half-edge that leaves the same vertex.
  [[nodiscard]] HalfedgeId clockwise(HalfedgeId h) const noexcept {
    return view_.next(view_.opposite[h]);
  }
  /// Whether there is an edge between the origins of the two half-edges. O(smaller valence).
  [[nodiscard]] bool are_joined(HalfedgeId from_a, HalfedgeId from_b) const noexcept;
  /// The number of boundary half-edges that leave `v`.
  [[nodiscard]] Index gaps(VertexId v) const noexcept;
  /// Whether some face at `a`, but for these two, has `b` as a corner.
  [[nodiscard]] bool have_face(VertexId a, VertexId b, FaceId but, FaceId and_but) const noexcept;

 private:
  EditView view_;
};

inline bool EditTest::are_joined(HalfedgeId from_a, HalfedgeId from_b) const noexcept {
  const VertexId a = view_.origin[from_a];
  const VertexId b = view_.origin[from_b];
  if (!view_.fans.empty()) {
    for (const HalfedgeId h : outgoing_halfedges(view_, a)) {
      if (view_.target(h) == b) return true;
    }
    return false;
  }
  // Both at once, and whoever is round first knows: one may be the middle of a large fan.
  HalfedgeId i = from_a;
  HalfedgeId j = from_b;
  do {
    const HalfedgeId across_i = view_.opposite[i];
    const HalfedgeId across_j = view_.opposite[j];
    if (view_.origin[across_i] == b || view_.origin[across_j] == a) return true;
    i = view_.next(across_i);
    j = view_.next(across_j);
  } while (i != from_a && j != from_b);
  return false;
}

inline Index EditTest::gaps(VertexId v) const noexcept {
  Index count = 0;
  for (const HalfedgeId h : outgoing_halfedges(view_, v)) count += !view_.face(h).valid();
  return count;
}

inline bool EditTest::have_face(VertexId a, VertexId b, FaceId but, FaceId and_but) const noexcept {
  for (const FaceId f : incident_faces(view_, a)) {
    if (f != but && f != and_but && is_in(f, b)) return true;
  }
  return false;
}

}  // namespace hedgerow
