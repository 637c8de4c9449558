#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "imr/suite.h"

namespace hedgerow::bench {

namespace {

struct Traits : OpenMesh::DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::Normal);
  FaceAttributes(OpenMesh::Attributes::Normal);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

class OpenMeshImr final : public ImrMesh {
 public:
  /// False where the library refuses a face.
  [[nodiscard]] bool fill(const FaceList& faces, Positions positions) {
    const auto vertex_count = static_cast<std::size_t>(faces.vertex_count);
    const auto face_count = static_cast<std::size_t>(faces.face_count);
    mesh_.reserve(vertex_count, vertex_count + face_count, face_count);
    for (Index v = 0; v < faces.vertex_count; ++v) {
      const float* p = positions[v];
      mesh_.add_vertex({p[0], p[1], p[2]});
    }
    const auto* corners = static_cast<const Index*>(faces.corners);
    for (Index f = 0; f < faces.face_count; ++f) {
      const auto corner = [&](Index k) {
        return OpenMesh::VertexHandle(static_cast<int>(corners[3 * f + k]));
      };
      if (!mesh_.add_face(corner(0), corner(1), corner(2)).is_valid()) return false;
    }
    return true;
  }

  [[nodiscard]] RingSums circulate() override {
    RingSums sums;
    for (const auto v : mesh_.vertices()) {
      for (auto f = mesh_.cvf_begin(v); f.is_valid(); ++f) {
        ++sums.faces;
        sums.face_ids += static_cast<std::uint64_t>(f->idx());
      }
    }
    for (const auto f : mesh_.faces()) {
      for (auto v = mesh_.cfv_begin(f); v.is_valid(); ++v) {
        ++sums.vertices;
        sums.vertex_ids += static_cast<std::uint64_t>(v->idx());
      }
    }
    return sums;
  }

  void subtract_barycenter() override {
    OpenMesh::Vec3d mean(0, 0, 0);
    for (const auto v : mesh_.vertices()) {
      mean += OpenMesh::vector_cast<OpenMesh::Vec3d>(mesh_.point(v));
    }
    mean /= static_cast<double>(mesh_.n_vertices());
    const auto offset = OpenMesh::vector_cast<OpenMesh::Vec3f>(mean);
    for (const auto v : mesh_.vertices()) mesh_.point(v) -= offset;
  }

  void compute_normals() override {
    mesh_.update_face_normals();
    mesh_.update_vertex_normals();
  }

  void smooth() override {
    for (const auto v : mesh_.vertices()) {
      if (mesh_.is_boundary(v) || mesh_.is_isolated(v)) continue;
      OpenMesh::Vec3f sum(0, 0, 0);
      float count = 0;
      for (auto u = mesh_.cvv_begin(v); u.is_valid(); ++u) {
        sum += mesh_.point(*u);
        ++count;
      }
      mesh_.set_point(v, sum / count);
    }
  }

  void subdivide() override {
    const std::size_t vertex_count = mesh_.n_vertices();
    const std::size_t edge_count = mesh_.n_edges();
    const std::size_t face_count = mesh_.n_faces();
    mesh_.reserve(vertex_count + face_count, edge_count + 3 * face_count, 3 * face_count);
    std::vector<OpenMesh::Vec3f> moved;
    moved.reserve(vertex_count);
    for (const auto v : mesh_.vertices()) moved.push_back(subdivided(v));
    for (std::size_t f = 0; f < face_count; ++f) split(f);
    for (std::size_t v = 0; v < vertex_count; ++v) {
      mesh_.set_point(OpenMesh::VertexHandle(static_cast<int>(v)), moved[v]);
    }
    for (std::size_t e = 0; e < edge_count; ++e) {
      const OpenMesh::EdgeHandle edge(static_cast<int>(e));
      if (mesh_.is_flip_ok(edge)) mesh_.flip(edge);
    }
  }

  void split_and_collapse() override {
    const std::size_t vertex_count = mesh_.n_vertices();
    const std::size_t face_count = mesh_.n_faces();
    mesh_.reserve(vertex_count + face_count, mesh_.n_edges() + 3 * face_count, 3 * face_count);
    for (std::size_t f = 0; f < face_count; ++f) split(f);
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    for (std::size_t v = vertex_count; v < vertex_count + face_count; ++v) {
      mesh_.collapse(mesh_.halfedge_handle(OpenMesh::VertexHandle(static_cast<int>(v))));
    }
    mesh_.garbage_collection();
  }

  void move_to(Positions positions) override {
    for (const auto v : mesh_.vertices()) {
      const float* p = positions[static_cast<Index>(v.idx())];
      mesh_.set_point(v, {p[0], p[1], p[2]});
    }
  }
  [[nodiscard]] std::vector<float> vertex_normals() const override {
    std::vector<float> normals;
    for (const auto v : mesh_.vertices()) append(mesh_.normal(v), normals);
    return normals;
  }
  [[nodiscard]] ImrSurface surface() const override {
    ImrSurface surface;
    for (const auto v : mesh_.vertices()) append(mesh_.point(v), surface.xyz);
    for (const auto f : mesh_.faces()) {
      for (auto v = mesh_.cfv_begin(f); v.is_valid(); ++v) surface.corners.push_back(v->idx());
    }
    return surface;
  }

  static std::unique_ptr<ImrMesh> make(const FaceList& faces, Positions positions,
                                       const Execution& /*execution*/) {
    auto mesh = std::make_unique<OpenMeshImr>();
    if (!mesh->fill(faces, positions)) return nullptr;
    return mesh;
  }

 private:
  static void append(const OpenMesh::Vec3f& p, std::vector<float>& out) {
    out.insert(out.end(), {p[0], p[1], p[2]});
  }

  void split(std::size_t f) {
    const OpenMesh::FaceHandle face(static_cast<int>(f));
    mesh_.split(face, mesh_.calc_face_centroid(face));
  }

  [[nodiscard]] OpenMesh::Vec3f subdivided(OpenMesh::VertexHandle v) const {
    if (mesh_.is_boundary(v) || mesh_.is_isolated(v)) return mesh_.point(v);
    OpenMesh::Vec3f sum(0, 0, 0);
    int count = 0;
    for (auto u = mesh_.cvv_begin(v); u.is_valid(); ++u) {
      sum += mesh_.point(*u);
      ++count;
    }
    const auto share = static_cast<float>(sqrt3_share(count));
    return mesh_.point(v) * (1 - share) + sum * (share / static_cast<float>(count));
  }

  Mesh mesh_;
};

}  // namespace

std::vector<ImrKind> imr_openmesh() {
  return {{"openmesh", {kImrRows.begin(), kImrRows.end()}, OpenMeshImr::make}};
}

}  // namespace hedgerow::bench
