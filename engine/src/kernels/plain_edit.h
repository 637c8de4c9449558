#pragma once

#include <initializer_list>

#include "kernels/edit_columns.h"

namespace hedgerow::kernels {

/// An edit under way on raw columns, without a record: what `Edit` is for one with. Elements that
/// it makes get the numbers from those it was given on; the columns have room for them.
class PlainEdit {
 public:
  explicit PlainEdit(const EditColumns& columns) noexcept : c_(columns) {}
  PlainEdit(const EditColumns& columns, VertexId vertex, HalfedgeId halfedge, FaceId face) noexcept
      : c_(columns), vertex_(vertex), halfedge_(halfedge), face_(face) {}

  [[nodiscard]] VertexId origin(HalfedgeId h) const noexcept {
    return VertexId(c_.origin[h.value]);
  }
  [[nodiscard]] VertexId target(HalfedgeId h) const noexcept { return origin(opposite(h)); }
  [[nodiscard]] HalfedgeId opposite(HalfedgeId h) const noexcept {
    return HalfedgeId(c_.opposite[h.value]);
  }
  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept {
    return HalfedgeId(c_.next[h.value]);
  }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept {
    return HalfedgeId(c_.prev[h.value]);
  }
  [[nodiscard]] FaceId face(HalfedgeId h) const noexcept { return FaceId(c_.face[h.value]); }
  [[nodiscard]] HalfedgeId first(FaceId f) const noexcept { return HalfedgeId(c_.first[f.value]); }
  [[nodiscard]] HalfedgeId outgoing(VertexId v) const noexcept {
    return HalfedgeId(c_.outgoing[v.value]);
  }
  [[nodiscard]] HalfedgeId clockwise(HalfedgeId h) const noexcept { return next(opposite(h)); }

  void set_origin(HalfedgeId h, VertexId v) noexcept { c_.origin[h.value] = v.value; }
  void set_face(HalfedgeId h, FaceId f) noexcept { c_.face[h.value] = f.value; }
  void set_first(FaceId f, HalfedgeId h) noexcept { c_.first[f.value] = h.value; }
  void set_outgoing(VertexId v, HalfedgeId h) noexcept { c_.outgoing[v.value] = h.value; }
  void link(HalfedgeId h, HalfedgeId g) noexcept {
    c_.next[h.value] = g.value;
    c_.prev[g.value] = h.value;
  }
  void pair(HalfedgeId h, HalfedgeId o) noexcept {
    c_.opposite[h.value] = o.value;
    c_.opposite[o.value] = h.value;
  }

  VertexId add_vertex(VertexId, VertexId = {}) noexcept { return VertexId(vertex_.value++); }
  HalfedgeId add_halfedge(VertexId origin, FaceId face, HalfedgeId = {}) noexcept {
    const HalfedgeId h(halfedge_.value++);
    set_origin(h, origin);
    set_face(h, face);
    return h;
  }
  FaceId add_face(HalfedgeId first, FaceId) noexcept {
    const FaceId f(face_.value++);
    set_first(f, first);
    return f;
  }
  void remove(VertexId v) noexcept {
    set_outgoing(v, HalfedgeId());
    c_.is_gone[v.value] = 1;
  }
  void remove(HalfedgeId h) noexcept {
    for (Index* column : {c_.origin, c_.opposite, c_.next, c_.prev, c_.face}) {
      column[h.value] = kInvalidIndex;
    }
  }
  void remove(FaceId f) noexcept { set_first(f, HalfedgeId()); }

 private:
  EditColumns c_;
  VertexId vertex_;  // the next one to be made
  HalfedgeId halfedge_;
  FaceId face_;
};

}  // namespace hedgerow::kernels
