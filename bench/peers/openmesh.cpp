#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "peers/peers.h"

namespace hedgerow::bench {

namespace {

/// Attributes that the measured operations need, and no more.
struct Traits : OpenMesh::DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::Normal);
  FaceAttributes(OpenMesh::Attributes::Normal);
};

template <class Mesh>
class OpenMeshMesh final : public MeasuredMesh {
 public:
  /// False where the library refuses a face.
  [[nodiscard]] bool fill(const FaceList& faces, Positions positions) {
    faces_ = faces;
    const auto vertex_count = static_cast<std::size_t>(faces.vertex_count);
    const auto face_count = static_cast<std::size_t>(faces.face_count);
    mesh_.reserve(vertex_count, vertex_count + face_count, face_count);
    for (Index v = 0; v < faces.vertex_count; ++v) {
      const float* p = positions[v];
      mesh_.add_vertex({p[0], p[1], p[2]});
    }
    const auto* corners = static_cast<const Index*>(faces.corners);
    std::vector<OpenMesh::VertexHandle> handles;
    for (Index f = 0; f < faces.face_count; ++f) {
      const IndexRange range = faces.corner_range(f);
      handles.clear();
      for (Index i = range.begin; i < range.end; ++i)
        handles.emplace_back(static_cast<int>(corners[i]));
      if (!mesh_.add_face(handles).is_valid()) return false;
    }
    return true;
  }

  [[nodiscard]] std::vector<Index> opposite() const override {
    const auto* corners = static_cast<const Index*>(faces_.corners);
    std::vector<Index> corner_of(mesh_.n_halfedges(), kInvalidIndex);
    for (Index f = 0; f < faces_.face_count; ++f) {
      const IndexRange range = faces_.corner_range(f);
      OpenMesh::HalfedgeHandle h = mesh_.halfedge_handle(OpenMesh::FaceHandle(static_cast<int>(f)));
      while (mesh_.from_vertex_handle(h).idx() != corners[range.begin])
        h = mesh_.next_halfedge_handle(h);
      for (Index i = range.begin; i < range.end; ++i) {
        corner_of[static_cast<std::size_t>(h.idx())] = i;
        h = mesh_.next_halfedge_handle(h);
      }
    }
    std::vector<Index> opposite(static_cast<std::size_t>(faces_.corner_count()), kInvalidIndex);
    for (std::size_t h = 0; h < corner_of.size(); ++h) {
      if (corner_of[h] == kInvalidIndex) continue;
      // The library keeps the two half-edges of an edge side by side.
      opposite[static_cast<std::size_t>(corner_of[h])] = corner_of[h ^ 1U];
    }
    return opposite;
  }

  void compute_face_normals() override { mesh_.update_face_normals(); }
  void compute_vertex_normals() override {
    mesh_.update_face_normals();
    mesh_.update_vertex_normals();
  }
  [[nodiscard]] std::vector<float> face_normals() const override {
    std::vector<float> normals;
    for (const auto f : mesh_.faces()) append(mesh_.normal(f), normals);
    return normals;
  }
  [[nodiscard]] std::vector<float> vertex_normals() const override {
    std::vector<float> normals;
    for (const auto v : mesh_.vertices()) append(mesh_.normal(v), normals);
    return normals;
  }

  void fill_one_ring_sums(std::span<std::uint32_t> sums) const override {
    for (const auto v : mesh_.vertices()) sums[static_cast<std::size_t>(v.idx())] = ring_sum(v);
  }
  void set_vertex_normals(Positions normals) override {
    for (const auto v : mesh_.vertices()) {
      const float* n = normals[static_cast<Index>(v.idx())];
      mesh_.set_normal(v, {n[0], n[1], n[2]});
    }
  }
  [[nodiscard]] HitSum answer_hits(std::span<const HitQuestion> hits) const override {
    HitSum sum;
    for (const HitQuestion& hit : hits) {
      const auto corner = [&](std::size_t k) {
        return mesh_.normal(OpenMesh::VertexHandle(static_cast<int>(hit.vertices[k]))) *
               hit.weights[k];
      };
      const OpenMesh::Vec3f normal = corner(0) + corner(1) + corner(2);
      add_normal({normal[0], normal[1], normal[2]}, sum);
      sum.ring += ring_sum(OpenMesh::VertexHandle(static_cast<int>(hit.nearest)));
    }
    return sum;
  }
  void move_to(Positions positions) override {
    for (const auto v : mesh_.vertices()) {
      const float* p = positions[static_cast<Index>(v.idx())];
      mesh_.set_point(v, {p[0], p[1], p[2]});
    }
  }

 private:
  [[nodiscard]] std::uint32_t ring_sum(OpenMesh::VertexHandle v) const {
    std::uint32_t sum = 0;
    for (auto neighbour = mesh_.cvv_begin(v); neighbour.is_valid(); ++neighbour) {
      sum += static_cast<std::uint32_t>(neighbour->idx());
    }
    return sum;
  }
  static void append(const OpenMesh::Vec3f& normal, std::vector<float>& out) {
    out.insert(out.end(), {normal[0], normal[1], normal[2]});
  }

  Mesh mesh_;
  FaceList faces_;
};

template <class Mesh>
std::unique_ptr<MeasuredMesh> build_as(const FaceList& faces, Positions positions) {
  auto mesh = std::make_unique<OpenMeshMesh<Mesh>>();
  if (!mesh->fill(faces, positions)) return nullptr;
  return mesh;
}

std::unique_ptr<MeasuredMesh> build(const FaceList& faces, Positions positions) {
  if (faces.is_triangles()) {
    return build_as<OpenMesh::TriMesh_ArrayKernelT<Traits>>(faces, positions);
  }
  return build_as<OpenMesh::PolyMesh_ArrayKernelT<Traits>>(faces, positions);
}

}  // namespace

extern const Peer kOpenMeshPeer = {"openmesh", build, true, NormalWeight::uniform, false, false};

}  // namespace hedgerow::bench
