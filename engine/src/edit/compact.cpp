#include <optional>
#include <utility>
#include <vector>

#include "at.h"
#include "edit/edit.h"
#include "kernels/prefetch.h"
#include "represent/forms.h"
#include "represent/number_halfedges.h"

namespace hedgerow {

namespace {

// The elements that are left, with vertices and faces by their new numbers.
class LiveSource {
 public:
  explicit LiveSource(const EditMesh& mesh) : mesh_(mesh), view_(mesh.view()) {
    Index count = 0;
    vertices_.resize(static_cast<std::size_t>(mesh.vertex_count()));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (mesh.has(VertexId(v))) vertices_[static_cast<std::size_t>(v)] = VertexId(count++);
    }
    vertex_count_ = count;
    faces_.resize(static_cast<std::size_t>(mesh.face_count()));
    for (Index f = 0; f < mesh.face_count(); ++f) {
      if (!mesh.has(FaceId(f))) continue;
      faces_[static_cast<std::size_t>(f)] = FaceId(static_cast<Index>(old_faces_.size()));
      old_faces_.push_back(f);
    }
  }

  [[nodiscard]] Index record_count() const noexcept { return view_.halfedge_count(); }
  [[nodiscard]] Index vertex_count() const noexcept { return vertex_count_; }
  [[nodiscard]] Index face_count() const noexcept { return static_cast<Index>(old_faces_.size()); }
  [[nodiscard]] bool exists(Index h) const noexcept { return mesh_.has(HalfedgeId(h)); }
  [[nodiscard]] Index origin(Index h) const noexcept {
    return vertices_[static_cast<std::size_t>(view_.origin[HalfedgeId(h)].value)].value;
  }
  [[nodiscard]] Index opposite(Index h) const noexcept {
    return view_.opposite[HalfedgeId(h)].value;
  }
  [[nodiscard]] Index next(Index h) const noexcept { return view_.next(HalfedgeId(h)).value; }
  [[nodiscard]] Index face(Index h) const noexcept {
    const FaceId f = view_.face(HalfedgeId(h));
    return f.valid() ? faces_[static_cast<std::size_t>(f.value)].value : kInvalidIndex;
  }
  [[nodiscard]] Index face_record(Index f) const noexcept {
    return view_.first(FaceId(old_faces_[static_cast<std::size_t>(f)])).value;
  }
  template <class Visit>
  void for_each_start(const Visit& visit) const {
    for (Index v = 0; v < view_.vertex_count(); ++v) visit(view_.outgoing[VertexId(v)].value);
    for (const FanStart& fan : view_.fans) visit(fan.start.value);
  }

  [[nodiscard]] std::vector<VertexId> take_vertices() { return std::move(vertices_); }
  [[nodiscard]] std::vector<FaceId> take_faces() { return std::move(faces_); }

 private:
  const EditMesh& mesh_;
  EditView view_;
  std::vector<VertexId> vertices_;
  std::vector<FaceId> faces_;
  std::vector<Index> old_faces_;
  Index vertex_count_ = 0;
};

// So many ids, none of them valid yet.
template <class Id>
std::vector<Id> no_ids(Index count) {
  std::vector<Id> ids;
  ids.reserve(static_cast<std::size_t>(count));
  detail::prefer_huge_pages(ids.data(), ids.capacity() * sizeof(Id));
  ids.resize(static_cast<std::size_t>(count));
  return ids;
}

/// What `compact` gives, for triangles in the default form, in passes that search for no order: the
/// half-edges of face f are 3f, 3f + 1 and 3f + 2, and those of the boundary go.
class TriangleCompaction {
 public:
  explicit TriangleCompaction(const EditMesh& mesh) : mesh_(mesh), view_(mesh.view()) {}

  /// Nothing if some face is none, an edge dangles or a vertex has several fans.
  std::optional<Compacted> run() {
    if (!view_.fans.empty() || !number_faces()) return {};
    const Index vertex_count = number_vertices();
    const Index boundary_count = fill_corners();
    Index halfedge_count = 0;
    for (Index h = 0; h < view_.halfedge_count(); ++h) {
      halfedge_count += Index{view_.next_of.data()[h] >= 0};
    }
    if (halfedge_count != columns_.origin.size() + boundary_count) return {};
    if (fill_outgoing(vertex_count) != boundary_count) return {};
    columns_.all_triangles = true;
    return Compacted{Connectivity(std::move(columns_)), std::move(maps_)};
  }

 private:
  bool number_faces() {
    maps_.faces = no_ids<FaceId>(view_.face_count());
    maps_.halfedges = no_ids<HalfedgeId>(view_.halfedge_count());
    Index count = 0;
    for (Index f = 0; f < view_.face_count(); ++f) {
      kernels::prefetch_ahead(view_.first_of.data() + f);
      const HalfedgeId h = view_.first(FaceId(f));
      if (!h.valid()) continue;
      const HalfedgeId n = view_.next(h);
      const HalfedgeId p = view_.next(n);
      if (view_.next(p) != h) return false;
      kernels::prefetch_ahead(view_.next_of.data() + h.value);
      maps_.faces[at(f)] = FaceId(count);
      maps_.halfedges[at(h.value)] = HalfedgeId(3 * count);
      maps_.halfedges[at(n.value)] = HalfedgeId(3 * count + 1);
      maps_.halfedges[at(p.value)] = HalfedgeId(3 * count + 2);
      ++count;
    }
    face_count_ = count;
    return true;
  }

  Index number_vertices() {
    maps_.vertices = no_ids<VertexId>(view_.vertex_count());
    Index count = 0;
    for (Index v = 0; v < view_.vertex_count(); ++v) {
      if (mesh_.has(VertexId(v))) maps_.vertices[at(v)] = VertexId(count++);
    }
    return count;
  }

  // Returns the number of half-edges on the boundary.
  Index fill_corners() {
    Buffer<Index> origin(3 * at(face_count_));
    Buffer<Index> opposite(3 * at(face_count_));
    Index boundary_count = 0;
    std::size_t to = 0;
    for (Index f = 0; f < view_.face_count(); ++f) {
      HalfedgeId h = view_.first(FaceId(f));
      if (!h.valid()) continue;
      kernels::prefetch_ahead(view_.origin.data() + h.value);
      kernels::prefetch_ahead(view_.opposite.data() + h.value);
      for (int corner = 0; corner < 3; ++corner, ++to, h = view_.next(h)) {
        origin[to] = maps_.vertices[at(view_.origin[h].value)].value;
        opposite[to] = maps_.halfedges[at(view_.opposite[h].value)].value;
        boundary_count += Index{opposite[to] < 0};
      }
    }
    columns_.origin = std::move(origin);
    columns_.opposite = std::move(opposite);
    return boundary_count;
  }

  // Returns the number of vertices on the boundary.
  Index fill_outgoing(Index vertex_count) {
    Buffer<Index> outgoing(at(vertex_count));
    Index boundary_count = 0;
    for (Index v = 0; v < view_.vertex_count(); ++v) {
      const VertexId to = maps_.vertices[at(v)];
      if (!to.valid()) continue;
      HalfedgeId start = view_.outgoing[VertexId(v)];
      if (start.valid() && !view_.face(start).valid()) {
        ++boundary_count;
        start = view_.next(view_.opposite[start]);
      }
      outgoing[at(to.value)] = start.valid() ? maps_.halfedges[at(start.value)].value : start.value;
    }
    columns_.outgoing = std::move(outgoing);
    return boundary_count;
  }

  const EditMesh& mesh_;
  EditView view_;
  ConnectivityColumns columns_;
  CompactMaps maps_;
  Index face_count_ = 0;
};

}  // namespace

Result<Compacted> EditMesh::compact() const {
  if (form_ == Form::open) {
    if (auto done = TriangleCompaction(*this).run()) return std::move(*done);
  }
  LiveSource source(*this);
  auto numbered = detail::HalfedgeMaker(source).run();
  if (!numbered) return fail(numbered.error());
  auto made = detail::to_form(std::move(*numbered), form_, Execution::serial());
  if (!made) return fail(made.error());
  const std::span<const HalfedgeId> halfedges = std::as_const(made->halfedge_of_record).span();
  return Compacted{
      std::move(made->mesh),
      {source.take_vertices(), {halfedges.begin(), halfedges.end()}, source.take_faces()}};
}

namespace {

// New numbers of those that exist; returns how many.
template <class Exists>
Index number(Buffer<Index>& numbers, const Exists& exists) noexcept {
  Index count = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = exists(static_cast<Index>(i)) ? count++ : kInvalidIndex;
  }
  return count;
}

}  // namespace

PackedIds Edit::pack(EditMesh& mesh) {
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  PackedIds ids{Buffer<Index>(at(mesh.vertex_count())), Buffer<Index>(at(mesh.halfedge_count())),
                Buffer<Index>(at(mesh.face_count()))};
  const Index vertices = number(ids.vertices, [&](Index v) { return mesh.has(VertexId(v)); });
  const Index halfedges = number(ids.halfedges, [&](Index h) { return mesh.has(HalfedgeId(h)); });
  const Index faces = number(ids.faces, [&](Index f) { return mesh.has(FaceId(f)); });
  const auto renumbered = [&](const Buffer<Index>& numbers, Index old) {
    return old < 0 ? old : numbers[at(old)];
  };
  // No number grows, so that what is written has been read.
  for (std::size_t h = 0; h < ids.halfedges.size(); ++h) {
    if (ids.halfedges[h] < 0) continue;
    const std::size_t to = at(ids.halfedges[h]);
    mesh.origin_[to] = ids.vertices[at(mesh.origin_[h])];
    mesh.opposite_[to] = ids.halfedges[at(mesh.opposite_[h])];
    mesh.next_[to] = ids.halfedges[at(mesh.next_[h])];
    mesh.prev_[to] = ids.halfedges[at(mesh.prev_[h])];
    mesh.face_[to] = renumbered(ids.faces, mesh.face_[h]);
  }
  for (std::size_t v = 0; v < ids.vertices.size(); ++v) {
    if (ids.vertices[v] < 0) continue;
    mesh.outgoing_[at(ids.vertices[v])] = renumbered(ids.halfedges, mesh.outgoing_[v]);
    mesh.is_gone_[at(ids.vertices[v])] = 0;
  }
  for (std::size_t f = 0; f < ids.faces.size(); ++f) {
    if (ids.faces[f] >= 0) mesh.first_[at(ids.faces[f])] = ids.halfedges[at(mesh.first_[f])];
  }
  for (FanStart& fan : mesh.fans_) {
    fan = {VertexId(ids.vertices[at(fan.vertex.value)]),
           HalfedgeId(ids.halfedges[at(fan.start.value)])};
  }
  const Index counts[] = {vertices, halfedges, faces};
  for (const EditColumn which :
       {EditColumn::origin, EditColumn::opposite, EditColumn::next, EditColumn::prev,
        EditColumn::face, EditColumn::outgoing, EditColumn::is_gone, EditColumn::first}) {
    mesh.column(which).resize(at(counts[static_cast<std::size_t>(element_of(which))]), 0);
  }
  return ids;
}

}  // namespace hedgerow
