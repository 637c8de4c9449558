#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "peers/peers.h"

namespace hedgerow::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<float>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Connectivity only: the library's vertex normals (the direction most visible from all faces) are
/// another quantity than the engine's.
class CgalMesh final : public MeasuredMesh {
 public:
  /// False where the library refuses a face.
  [[nodiscard]] bool fill(const FaceList& faces, Positions positions) {
    faces_ = faces;
    const auto vertex_count = static_cast<Mesh::size_type>(faces.vertex_count);
    const auto face_count = static_cast<Mesh::size_type>(faces.face_count);
    mesh_.reserve(vertex_count, vertex_count + face_count, face_count);
    for (Index v = 0; v < faces.vertex_count; ++v) {
      const float* p = positions[v];
      mesh_.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
    }
    const auto* corners = static_cast<const Index*>(faces.corners);
    std::vector<Mesh::Vertex_index> vertices;
    for (Index f = 0; f < faces.face_count; ++f) {
      const IndexRange range = faces.corner_range(f);
      vertices.clear();
      for (Index i = range.begin; i < range.end; ++i) {
        vertices.emplace_back(static_cast<Mesh::size_type>(corners[i]));
      }
      if (mesh_.add_face(vertices) == Mesh::null_face()) return false;
    }
    return true;
  }

  [[nodiscard]] std::vector<Index> opposite() const override {
    const auto* corners = static_cast<const Index*>(faces_.corners);
    std::vector<Index> corner_of(mesh_.number_of_halfedges(), kInvalidIndex);
    for (Index f = 0; f < faces_.face_count; ++f) {
      const IndexRange range = faces_.corner_range(f);
      const auto first = static_cast<Mesh::size_type>(corners[range.begin]);
      Mesh::Halfedge_index h = mesh_.halfedge(Mesh::Face_index(static_cast<Mesh::size_type>(f)));
      while (mesh_.source(h) != Mesh::Vertex_index(first)) h = mesh_.next(h);
      for (Index i = range.begin; i < range.end; ++i) {
        corner_of[h.idx()] = i;
        h = mesh_.next(h);
      }
    }
    std::vector<Index> opposite(static_cast<std::size_t>(faces_.corner_count()), kInvalidIndex);
    for (const Mesh::Halfedge_index h : mesh_.halfedges()) {
      if (corner_of[h.idx()] == kInvalidIndex) continue;
      opposite[static_cast<std::size_t>(corner_of[h.idx()])] = corner_of[mesh_.opposite(h).idx()];
    }
    return opposite;
  }

  void compute_face_normals() override {}
  void compute_vertex_normals() override {}
  [[nodiscard]] std::vector<float> face_normals() const override { return {}; }
  [[nodiscard]] std::vector<float> vertex_normals() const override { return {}; }

  void fill_one_ring_sums(std::span<std::uint32_t> sums) const override {
    for (const Mesh::Vertex_index v : mesh_.vertices()) sums[v.idx()] = ring_sum(v);
  }
  void set_vertex_normals(Positions normals) override {
    normals_ = mesh_.add_property_map<Mesh::Vertex_index, Kernel::Vector_3>("v:normal").first;
    for (const Mesh::Vertex_index v : mesh_.vertices()) {
      const float* n = normals[static_cast<Index>(v.idx())];
      normals_[v] = Kernel::Vector_3(n[0], n[1], n[2]);
    }
  }
  [[nodiscard]] HitSum answer_hits(std::span<const HitQuestion> hits) const override {
    HitSum sum;
    for (const HitQuestion& hit : hits) {
      const auto corner = [&](std::size_t k) {
        return normals_[vertex(hit.vertices[k])] * hit.weights[k];
      };
      const Kernel::Vector_3 normal = corner(0) + corner(1) + corner(2);
      add_normal({normal.x(), normal.y(), normal.z()}, sum);
      sum.ring += ring_sum(vertex(hit.nearest));
    }
    return sum;
  }

 private:
  static Mesh::Vertex_index vertex(Index v) {
    return Mesh::Vertex_index(static_cast<Mesh::size_type>(v));
  }
  [[nodiscard]] std::uint32_t ring_sum(Mesh::Vertex_index v) const {
    std::uint32_t sum = 0;
    if (mesh_.is_isolated(v)) return sum;
    for (const Mesh::Vertex_index neighbour : mesh_.vertices_around_target(mesh_.halfedge(v))) {
      sum += neighbour.idx();
    }
    return sum;
  }

  Mesh mesh_;
  FaceList faces_;
  Mesh::Property_map<Mesh::Vertex_index, Kernel::Vector_3> normals_;
};

std::unique_ptr<MeasuredMesh> build(const FaceList& faces, Positions positions) {
  auto mesh = std::make_unique<CgalMesh>();
  if (!mesh->fill(faces, positions)) return nullptr;
  return mesh;
}

}  // namespace

extern const Peer kCgalPeer = {"cgal", build, false, NormalWeight::uniform, false, false};

}  // namespace hedgerow::bench
