#include <cstddef>
#include <vector>

#include "baselines/src/at.h"
#include "baselines/src/triangle_edits.h"
#include "baselines/struct_mesh.h"

namespace hedgerow::baselines {

namespace {

/// Of a vertex that was removed; -1 is one without half-edges.
constexpr Index kRemoved = -2;

/// Moves what stays to the front, in order; returns the new number of each.
template <class Record, class IsGone>
std::vector<Index> close_gaps(std::vector<Record>& records, const IsGone& is_gone) {
  std::vector<Index> numbers(records.size(), kInvalidIndex);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (is_gone(records[i])) continue;
    numbers[i] = static_cast<Index>(kept);
    records[kept++] = records[i];
  }
  records.resize(kept);
  return numbers;
}

void renumber(Index& i, const std::vector<Index>& numbers) noexcept {
  if (i >= 0) i = numbers[at(i)];
}

}  // namespace

/// What the edits write.
class StructEditor {
 public:
  using Handle = Index;
  using Vertex = Index;
  using Face = Index;

  explicit StructEditor(StructHalfedgeMesh& mesh) noexcept : mesh_(mesh) {}

  static bool is_valid(Handle h) noexcept { return h != kInvalidIndex; }
  Handle next(Handle h) const noexcept { return side(h).next; }
  Handle prev(Handle h) const noexcept {
    Handle g = next(h);
    while (next(g) != h) g = next(g);
    return g;
  }
  Handle opposite(Handle h) const noexcept { return side(h).opposite; }
  Vertex vertex(Handle h) const noexcept { return side(h).origin; }
  Face face_of(Handle h) const noexcept { return side(h).face; }
  Handle first(Face f) const noexcept { return mesh_.faces_[at(f)].halfedge; }
  Handle outgoing(Vertex v) const noexcept { return mesh_.vertices_[at(v)].halfedge; }

  void link(Handle h, Handle g) noexcept { side(h).next = g; }
  void pair(Handle h, Handle g) noexcept {
    if (is_valid(h)) side(h).opposite = g;
    if (is_valid(g)) side(g).opposite = h;
  }
  void set_vertex(Handle h, Vertex v) noexcept { side(h).origin = v; }
  void set_face(Handle h, Face f) noexcept { side(h).face = f; }
  void set_first(Face f, Handle h) noexcept { mesh_.faces_[at(f)].halfedge = h; }
  void set_outgoing(Vertex v, Handle h) noexcept { mesh_.vertices_[at(v)].halfedge = h; }

  Vertex add_vertex(const float* position) {
    mesh_.vertices_.push_back({{position[0], position[1], position[2]}, {}, kInvalidIndex});
    return mesh_.vertex_count() - 1;
  }
  Face add_face() {
    mesh_.faces_.push_back({{}, 0, kInvalidIndex});
    return mesh_.face_count() - 1;
  }
  Handle add_halfedge(Vertex v, Face f) {
    mesh_.halfedges_.push_back({v, kInvalidIndex, kInvalidIndex, f});
    return mesh_.halfedge_count() - 1;
  }
  void remove_face(Face f) noexcept { set_first(f, kInvalidIndex); }
  void remove_halfedge(Handle h) noexcept { side(h).next = kInvalidIndex; }
  void remove_vertex(Vertex v) noexcept { set_outgoing(v, kRemoved); }

 private:
  StructHalfedgeMesh::Halfedge& side(Handle h) noexcept { return mesh_.halfedges_[at(h)]; }
  const StructHalfedgeMesh::Halfedge& side(Handle h) const noexcept {
    return mesh_.halfedges_[at(h)];
  }

  StructHalfedgeMesh& mesh_;
};

void StructHalfedgeMesh::split_face(Index f) {
  const auto position = detail::center(StructWalk(*this), face(f).halfedge);
  StructEditor editor(*this);
  detail::split_face(editor, f, position.data());
}

bool StructHalfedgeMesh::flip(Index h) {
  StructEditor editor(*this);
  if (!detail::can_flip(editor, h)) return false;
  detail::flip(editor, h);
  return true;
}

void StructHalfedgeMesh::collapse(Index v) {
  StructEditor editor(*this);
  detail::collapse(editor, vertex(v).halfedge);
}

void StructHalfedgeMesh::compact() {
  const auto vertices =
      close_gaps(vertices_, [](const Vertex& vertex) { return vertex.halfedge == kRemoved; });
  const auto faces =
      close_gaps(faces_, [](const Face& face) { return face.halfedge == kInvalidIndex; });
  const auto halfedges =
      close_gaps(halfedges_, [](const Halfedge& h) { return h.next == kInvalidIndex; });
  for (Vertex& vertex : vertices_) renumber(vertex.halfedge, halfedges);
  for (Face& face : faces_) renumber(face.halfedge, halfedges);
  for (Halfedge& h : halfedges_) {
    renumber(h.origin, vertices);
    renumber(h.opposite, halfedges);
    renumber(h.next, halfedges);
    renumber(h.face, faces);
  }
}

}  // namespace hedgerow::baselines
