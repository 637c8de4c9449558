#include <algorithm>
#include <memory>
#include <utility>

#include "baselines/pointer_mesh.h"
#include "baselines/src/triangle_edits.h"

namespace hedgerow::baselines {

/// What the edits write.
class PointerEditor : public HalfedgeWalk {
 public:
  using Handle = PointerHalfedgeMesh::Halfedge*;
  using Vertex = PointerHalfedgeMesh::Vertex*;
  using Face = PointerHalfedgeMesh::Face*;

  explicit PointerEditor(PointerHalfedgeMesh& mesh) noexcept : mesh_(mesh) {}

  static Handle next(Handle h) noexcept { return h->next; }
  static Handle prev(Handle h) noexcept { return h->prev; }
  static Handle opposite(Handle h) noexcept { return h->opposite; }
  static Vertex vertex(Handle h) noexcept { return h->vertex; }
  static Face face_of(Handle h) noexcept { return h->face; }
  static Handle first(Face f) noexcept { return f->halfedge; }
  static Handle outgoing(Vertex v) noexcept { return v->halfedge; }

  static void link(Handle h, Handle g) noexcept {
    h->next = g;
    g->prev = h;
  }
  static void pair(Handle h, Handle g) noexcept {
    if (h != nullptr) h->opposite = g;
    if (g != nullptr) g->opposite = h;
  }
  static void set_vertex(Handle h, Vertex v) noexcept { h->vertex = v; }
  static void set_face(Handle h, Face f) noexcept { h->face = f; }
  static void set_first(Face f, Handle h) noexcept { f->halfedge = h; }
  static void set_outgoing(Vertex v, Handle h) noexcept { v->halfedge = h; }

  Vertex add_vertex(const float* position) {
    auto vertex = std::make_unique<PointerHalfedgeMesh::Vertex>();
    std::copy_n(position, 3, vertex->position);
    vertex->id = mesh_.vertex_count();
    mesh_.vertices_.push_back(std::move(vertex));
    return mesh_.vertices_.back().get();
  }
  Face add_face() {
    auto face = std::make_unique<PointerHalfedgeMesh::Face>();
    face->id = mesh_.face_count();
    mesh_.faces_.push_back(std::move(face));
    return mesh_.faces_.back().get();
  }
  Handle add_halfedge(Vertex v, Face f) {
    auto h = std::make_unique<PointerHalfedgeMesh::Halfedge>();
    h->vertex = v;
    h->face = f;
    mesh_.halfedges_.push_back(std::move(h));
    return mesh_.halfedges_.back().get();
  }
  // Marked only, so that ids stay what they are until `compact`.
  static void remove_face(Face f) noexcept { f->halfedge = nullptr; }
  static void remove_halfedge(Handle h) noexcept { h->next = nullptr; }
  static void remove_vertex(Vertex v) noexcept { v->id = kInvalidIndex; }

 private:
  PointerHalfedgeMesh& mesh_;
};

void PointerHalfedgeMesh::split_face(Index f) {
  Face* face = faces_[static_cast<std::size_t>(f)].get();
  const auto position = detail::center(HalfedgeWalk{}, HalfedgeWalk::first(*face));
  PointerEditor editor(*this);
  detail::split_face(editor, face, position.data());
}

bool PointerHalfedgeMesh::flip(Index h) {
  Halfedge* side = halfedges_[static_cast<std::size_t>(h)].get();
  PointerEditor editor(*this);
  if (!detail::can_flip(editor, side)) return false;
  detail::flip(editor, side);
  return true;
}

void PointerHalfedgeMesh::collapse(Index v) {
  PointerEditor editor(*this);
  detail::collapse(editor, vertex(v).halfedge);
}

void PointerHalfedgeMesh::compact() {
  std::erase_if(vertices_, [](const auto& vertex) { return vertex->id == kInvalidIndex; });
  std::erase_if(faces_, [](const auto& face) { return face->halfedge == nullptr; });
  std::erase_if(halfedges_, [](const auto& h) { return h->next == nullptr; });
  for (std::size_t v = 0; v < vertices_.size(); ++v) vertices_[v]->id = static_cast<Index>(v);
  for (std::size_t f = 0; f < faces_.size(); ++f) faces_[f]->id = static_cast<Index>(f);
}

}  // namespace hedgerow::baselines
