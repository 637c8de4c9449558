#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hedgerow/circulate.h"
#include "hedgerow/edit.h"

namespace hedgerow::test {

/// All entries of a mesh that is being edited, to compare with.
struct EditState {
  std::vector<std::vector<Index>> columns;
  std::vector<bool> has_vertex;
  friend bool operator==(const EditState&, const EditState&) = default;
};
inline EditState state_of(const EditMesh& mesh) {
  const EditView view = mesh.view();
  const auto list = [](const auto& column) {
    return std::vector<Index>(column.data(), column.data() + column.size());
  };
  EditState state{{list(view.origin), list(view.opposite), list(view.next_of), list(view.prev_of),
                   list(view.face_of), list(view.outgoing), list(view.first_of)},
                  {}};
  for (Index v = 0; v < mesh.vertex_count(); ++v) state.has_vertex.push_back(mesh.has(VertexId(v)));
  return state;
}

/// The first relation that does not hold, in words; "" if the mesh is sound. Written from the
/// invariants, with marks.
class EditSoundness {
 public:
  /// `may_double`: a mesh whose non-manifold edges were cut has several edges between two vertices.
  EditSoundness(const EditMesh& mesh, bool may_double)
      : mesh_(mesh),
        view_(mesh.view()),
        may_double_(may_double),
        met_(static_cast<std::size_t>(view_.halfedge_count()), 0),
        face_of_corner_(static_cast<std::size_t>(view_.vertex_count()), kInvalidIndex) {}

  std::string find_fault() {
    for (Index h = 0; h < view_.halfedge_count() && fault_.empty(); ++h) {
      if (mesh_.has(HalfedgeId(h))) check_halfedge(HalfedgeId(h));
    }
    for (Index f = 0; f < view_.face_count() && fault_.empty(); ++f) {
      if (mesh_.has(FaceId(f))) check_face(FaceId(f));
    }
    for (Index v = 0; v < view_.vertex_count() && fault_.empty(); ++v) {
      if (mesh_.has(VertexId(v))) check_vertex(VertexId(v));
    }
    for (Index h = 0; h < view_.halfedge_count() && fault_.empty(); ++h) {
      if (mesh_.has(HalfedgeId(h)) && met_[at(h)] == 0) say("is met by no rotation", h);
    }
    if (!may_double_) check_edges();
    return fault_;
  }

 private:
  static std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }
  void say(const char* what, Index element) {
    if (!fault_.empty()) return;
    std::ostringstream out;
    out << element << ' ' << what;
    fault_ = out.str();
  }
  void expect(bool holds, const char* what, Index element) {
    if (!holds) say(what, element);
  }

  void check_halfedge(HalfedgeId h) {
    const HalfedgeId o = view_.opposite[h];
    expect(mesh_.has(o) && o != h && view_.opposite[o] == h, "has no good opposite", h.value);
    expect(mesh_.has(view_.next(h)) && view_.prev(view_.next(h)) == h, "has no good next", h.value);
    expect(mesh_.has(view_.prev(h)) && view_.next(view_.prev(h)) == h, "has no good prev", h.value);
    expect(mesh_.has(view_.origin[h]), "leaves no vertex", h.value);
    if (!fault_.empty()) return;
    expect(view_.origin[view_.next(h)] == view_.origin[o], "is not followed at its target",
           h.value);
    expect(view_.face(view_.next(h)) == view_.face(h), "is followed in another face", h.value);
    expect(!view_.face(h).valid() || mesh_.has(view_.face(h)), "has a face that is gone", h.value);
    expect(view_.origin[h] != view_.origin[o], "joins a vertex to itself", h.value);
    edges_.emplace_back(view_.origin[h], view_.origin[o]);
  }
  void check_edges() {
    std::sort(edges_.begin(), edges_.end());
    const auto twice = std::adjacent_find(edges_.begin(), edges_.end());
    if (twice != edges_.end()) say("has two edges to the same vertex", twice->first.value);
  }
  void check_face(FaceId f) {
    const HalfedgeId start = view_.first(f);
    expect(mesh_.has(start) && view_.face(start) == f, "has no good first", f.value);
    if (!fault_.empty()) return;
    Index degree = 0;
    HalfedgeId h = start;
    do {
      ++degree;
      Index& last = face_of_corner_[at(view_.origin[h].value)];
      expect(last != f.value, "meets a vertex twice", f.value);
      last = f.value;
      h = view_.next(h);
    } while (h != start && fault_.empty());
    expect(degree >= 3, "has fewer than three corners", f.value);
  }
  void check_vertex(VertexId v) {
    const HalfedgeId start = view_.outgoing[v];
    if (!start.valid()) return;
    expect(mesh_.has(start) && view_.origin[start] == v, "has no good outgoing", v.value);
    if (!fault_.empty()) return;
    bool is_on_boundary = false;
    HalfedgeId h = start;
    do {
      met_[at(h.value)] = 1;
      is_on_boundary |= !view_.face(h).valid();
      h = view_.next(view_.opposite[h]);
    } while (h != start);
    expect(!is_on_boundary || !view_.face(start).valid(), "starts within its boundary", v.value);
    for (const FanStart& fan : extra_fans(view_.fans, v)) {
      h = fan.start;
      do {
        met_[at(h.value)] = 1;
        h = view_.next(view_.opposite[h]);
      } while (h != fan.start);
    }
  }

  const EditMesh& mesh_;
  EditView view_;
  bool may_double_;
  std::vector<std::pair<VertexId, VertexId>> edges_;
  std::vector<char> met_;
  std::vector<Index> face_of_corner_;  // the last one that was met at a vertex
  std::string fault_;
};

inline std::string find_fault(const EditMesh& mesh, bool may_double = false) {
  return EditSoundness(mesh, may_double).find_fault();
}

}  // namespace hedgerow::test
