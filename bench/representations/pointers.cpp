// The textbook meshes of pointers.
#include <unordered_set>

#include "baselines/pointer_mesh.h"
#include "baselines/pointer_winged_mesh.h"
#include "representations/walked_mesh.h"

namespace hedgerow::bench {

namespace {

using baselines::PointerHalfedgeMesh;
using baselines::PointerWingedEdgeMesh;

/// A set of records, which have no numbers.
template <class Handle, class Hash>
class MarkedHandles {
 public:
  explicit MarkedHandles(const auto&) {}
  bool insert(Handle h) { return handles_.insert(h).second; }

 private:
  std::unordered_set<Handle, Hash> handles_;
};

/// What both meshes have: steps from `Steps`, elements from `Mesh`.
template <class Mesh, class Steps>
class PointerWalk : public Steps {
 public:
  using Handle = typename Steps::Handle;
  static constexpr bool kIsClosed = false;

  explicit PointerWalk(const Mesh& mesh) : mesh_(&mesh) {}

  static Index target(Handle h) noexcept { return Steps::origin(Steps::next(h)); }
  // Hides that of the steps, which gives the record.
  static Index face(Handle h) noexcept { return Steps::face(h).id; }
  static Index degree(Handle h) noexcept {
    Index count = 0;
    Handle side = h;
    do {
      ++count;
      side = Steps::next(side);
    } while (!(side == h));
    return count;
  }
  [[nodiscard]] Index vertex_count() const noexcept { return mesh_->vertex_count(); }
  [[nodiscard]] Index face_count() const noexcept { return mesh_->face_count(); }
  [[nodiscard]] Handle outgoing(Index v) const noexcept {
    return Steps::outgoing(mesh_->vertex(v));
  }
  template <class Visit>
  void for_each_side(Index f, const Visit& visit) const {
    const Handle start = Steps::first(mesh_->face(f));
    Handle h = start;
    do {
      visit(h);
      h = Steps::next(h);
    } while (!(h == start));
  }

 protected:
  const Mesh* mesh_;
};

class HalfWalk : public PointerWalk<PointerHalfedgeMesh, baselines::HalfedgeWalk> {
 public:
  using PointerWalk::PointerWalk;
  using Marks = MarkedHandles<Handle, std::hash<Handle>>;

  template <class Visit>
  void for_each_halfedge(const Visit& visit) const {
    for (Index h = 0; h < mesh_->halfedge_count(); ++h) visit(&mesh_->halfedge(h));
  }
  // Of two half-edges that which leaves the smaller vertex.
  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    for_each_halfedge([&](Handle h) {
      if (!is_valid(opposite(h)) || origin(h) < origin(opposite(h))) visit(h);
    });
  }
};

struct SideHash {
  std::size_t operator()(PointerWingedEdgeMesh::Side s) const noexcept {
    return std::hash<const void*>{}(s.edge) ^ static_cast<std::size_t>(s.is_ccw);
  }
};

class SideWalk : public PointerWalk<PointerWingedEdgeMesh, baselines::WingedWalk> {
 public:
  using PointerWalk::PointerWalk;
  using Marks = MarkedHandles<Handle, SideHash>;

  static Index target(Handle s) noexcept { return end(s)->id; }
  template <class Visit>
  void for_each_halfedge(const Visit& visit) const {
    for_each_edge([&](Handle s) {
      visit(s);
      if (is_valid(opposite(s))) visit(opposite(s));
    });
  }
  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    for (Index e = 0; e < mesh_->edge_count(); ++e) visit(Handle{&mesh_->edge(e), false});
  }
};

template <class Mesh, class Walk>
class PointerRepresentation final : public Representation {
 public:
  PointerRepresentation(const FaceList& faces, Positions positions) : mesh_(faces, positions) {}

  [[nodiscard]] std::size_t bytes() const override {
    // Without position and normal of a vertex, normal and area of a face.
    const auto vertices = static_cast<std::size_t>(mesh_.vertex_count());
    const auto faces = static_cast<std::size_t>(mesh_.face_count());
    return mesh_.bytes() - 6 * sizeof(float) * vertices - 4 * sizeof(float) * faces;
  }
  [[nodiscard]] std::optional<std::uint64_t> answer(Question question) const override {
    const Walk walk(mesh_);
    return Walked<Walk>(walk).answer(question);
  }
  void compute_vertex_normals() override {
    const Walk walk(mesh_);
    Walked<Walk>(walk).fill_vertex_normals([&](Index v, baselines::detail::Vector normal) {
      baselines::detail::store(normal, mesh_.vertex(v).normal);
    });
  }
  [[nodiscard]] std::vector<float> vertex_normals() const override {
    return mesh_.vertex_normals();
  }

 private:
  Mesh mesh_;
};

}  // namespace

std::unique_ptr<Representation> build_pointer_half(const FaceList& faces, Positions positions) {
  return std::make_unique<PointerRepresentation<PointerHalfedgeMesh, HalfWalk>>(faces, positions);
}

std::unique_ptr<Representation> build_pointer_winged(const FaceList& faces, Positions positions) {
  return std::make_unique<PointerRepresentation<PointerWingedEdgeMesh, SideWalk>>(faces, positions);
}

}  // namespace hedgerow::bench
