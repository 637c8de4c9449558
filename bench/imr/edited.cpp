#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "hedgerow/build.h"
#include "hedgerow/circulate.h"
#include "hedgerow/edit.h"
#include "hedgerow/query.h"
#include "imr/suite.h"

namespace hedgerow::bench {

namespace {

/// The same edits one by one as the other libraries do, each of them checked before.
class EditedImr final : public ImrMesh {
 public:
  EditedImr(EditMesh mesh, Positions positions)
      : mesh_(std::move(mesh)), xyz_(positions.data, positions.data + 3 * positions.count) {
    mesh_.set_recording(false);
  }

  void subdivide() override {
    const Index vertex_count = mesh_.vertex_count();
    const Index halfedge_count = mesh_.halfedge_count();
    reserve_for_splits();
    std::vector<float> moved;
    moved.reserve(xyz_.size());
    for (Index v = 0; v < vertex_count; ++v) append_moved(VertexId(v), moved);
    split_faces();
    std::copy(moved.begin(), moved.end(), xyz_.begin());
    for (HalfedgeId h(0); h.value < halfedge_count; ++h.value) {
      // Refused on the boundary.
      if (h < mesh_.view().opposite[h]) (void)mesh_.flip(h);
    }
  }

  void split_and_collapse() override {
    const Index vertex_count = mesh_.vertex_count();
    reserve_for_splits();
    split_faces();
    for (VertexId v(vertex_count); v.value < mesh_.vertex_count(); ++v.value) {
      (void)mesh_.collapse(mesh_.view().outgoing[v]);
    }
    compact();
  }

  [[nodiscard]] ImrSurface surface() const override {
    const auto copy = [this](const Connectivity& mesh) -> ImrSurface {
      const auto corners = mesh.origin();
      return {xyz_, {corners.begin(), corners.end()}};
    };
    if (packed_) return copy(*packed_);
    const Result<Compacted> compacted = mesh_.compact();
    return compacted ? copy(compacted->mesh) : ImrSurface();
  }

  static std::unique_ptr<ImrMesh> make(const FaceList& faces, Positions positions,
                                       const Execution& execution) {
    const Result<BuildOutput> built = build(faces, BuildOptions(), execution);
    if (!built) return nullptr;
    Result<EditMesh> mesh = EditMesh::of(built->mesh, execution);
    if (!mesh) return nullptr;
    return std::make_unique<EditedImr>(std::move(*mesh), positions);
  }

 private:
  [[nodiscard]] const float* point(VertexId v) const {
    return xyz_.data() + 3 * static_cast<std::size_t>(v.value);
  }

  void reserve_for_splits() {
    const Index vertices = mesh_.vertex_count() + mesh_.face_count();
    mesh_.reserve(vertices, mesh_.halfedge_count() + 6 * mesh_.face_count(),
                  3 * mesh_.face_count());
    xyz_.reserve(3 * static_cast<std::size_t>(vertices));
  }

  void split_faces() {
    const Index face_count = mesh_.face_count();
    for (Index f = 0; f < face_count; ++f) {
      std::array<float, 3> center{};
      const EditView view = mesh_.view();
      for (const VertexId v : vertices(view, FaceId(f))) {
        for (std::size_t axis = 0; axis < 3; ++axis) center[axis] += point(v)[axis] / 3;
      }
      (void)mesh_.split_face(FaceId(f));
      xyz_.insert(xyz_.end(), center.begin(), center.end());
    }
  }

  void append_moved(VertexId v, std::vector<float>& moved) const {
    const EditView view = mesh_.view();
    std::array<float, 3> result = {point(v)[0], point(v)[1], point(v)[2]};
    if (view.outgoing[v].valid() && !is_boundary(view, v)) {
      std::array<float, 3> sum{};
      int count = 0;
      for (const VertexId u : neighbours(view, v)) {
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += point(u)[axis];
        ++count;
      }
      const auto share = static_cast<float>(sqrt3_share(count));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        result[axis] = (1 - share) * result[axis] + share / static_cast<float>(count) * sum[axis];
      }
    }
    moved.insert(moved.end(), result.begin(), result.end());
  }

  /// Packs the mesh and its positions.
  void compact() {
    Result<Compacted> compacted = mesh_.compact();
    if (!compacted) return;
    for (std::size_t v = 0; v < compacted->maps.vertices.size(); ++v) {
      const VertexId to = compacted->maps.vertices[v];
      if (!to.valid()) continue;
      std::copy_n(xyz_.begin() + static_cast<std::ptrdiff_t>(3 * v), 3,
                  xyz_.begin() + static_cast<std::ptrdiff_t>(3 * to.value));
    }
    xyz_.resize(3 * static_cast<std::size_t>(compacted->mesh.vertex_count()));
    packed_ = std::move(compacted->mesh);
  }

  EditMesh mesh_;
  std::optional<Connectivity> packed_;
  std::vector<float> xyz_;
};

}  // namespace

std::vector<ImrKind> imr_edited() {
  return {{"", {ImrRow::collapse}, EditedImr::make},
          {"edits", {ImrRow::subdivision}, EditedImr::make}};
}

}  // namespace hedgerow::bench
