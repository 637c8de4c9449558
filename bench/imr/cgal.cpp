#include <cmath>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include "imr/suite.h"

namespace hedgerow::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<float>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Face = Mesh::Face_index;
using Halfedge = Mesh::Halfedge_index;
using Size = Mesh::size_type;

class CgalImr final : public ImrMesh {
 public:
  /// False where the library refuses a face.
  [[nodiscard]] bool fill(const FaceList& faces, Positions positions) {
    const auto vertex_count = static_cast<Size>(faces.vertex_count);
    const auto face_count = static_cast<Size>(faces.face_count);
    mesh_.reserve(vertex_count, vertex_count + face_count, face_count);
    ids_ = mesh_.add_property_map<Vertex, Index>("v:id").first;
    vertex_normals_ = mesh_.add_property_map<Vertex, Vector>("v:normal").first;
    face_normals_ = mesh_.add_property_map<Face, Vector>("f:normal").first;
    for (Index v = 0; v < faces.vertex_count; ++v) {
      const float* p = positions[v];
      ids_[mesh_.add_vertex(Point(p[0], p[1], p[2]))] = v;
    }
    const auto* corners = static_cast<const Index*>(faces.corners);
    for (Index f = 0; f < faces.face_count; ++f) {
      const auto corner = [&](Index k) { return Vertex(static_cast<Size>(corners[3 * f + k])); };
      if (mesh_.add_face(corner(0), corner(1), corner(2)) == Mesh::null_face()) return false;
    }
    return true;
  }

  [[nodiscard]] RingSums circulate() override {
    RingSums sums;
    for (const Vertex v : mesh_.vertices()) {
      if (mesh_.is_isolated(v)) continue;
      for (const Face f : mesh_.faces_around_target(mesh_.halfedge(v))) {
        if (f == Mesh::null_face()) continue;
        ++sums.faces;
        sums.face_ids += f.idx();
      }
    }
    for (const Face f : mesh_.faces()) {
      for (const Vertex v : mesh_.vertices_around_face(mesh_.halfedge(f))) {
        ++sums.vertices;
        sums.vertex_ids += v.idx();
      }
    }
    return sums;
  }

  void subtract_barycenter() override {
    std::array<double, 3> mean{};
    for (const Vertex v : mesh_.vertices()) {
      const Point& p = mesh_.point(v);
      mean[0] += double{p.x()};
      mean[1] += double{p.y()};
      mean[2] += double{p.z()};
    }
    for (double& x : mean) x /= static_cast<double>(mesh_.number_of_vertices());
    const Vector offset(static_cast<float>(mean[0]), static_cast<float>(mean[1]),
                        static_cast<float>(mean[2]));
    for (const Vertex v : mesh_.vertices()) mesh_.point(v) = mesh_.point(v) - offset;
  }

  void compute_normals() override {
    for (const Face f : mesh_.faces()) {
      Halfedge h = mesh_.halfedge(f);
      const Point& a = mesh_.point(mesh_.target(h));
      h = mesh_.next(h);
      const Point& b = mesh_.point(mesh_.target(h));
      const Point& c = mesh_.point(mesh_.target(mesh_.next(h)));
      face_normals_[f] = unit(CGAL::cross_product(b - a, c - a));
    }
    for (const Vertex v : mesh_.vertices()) {
      Vector sum(0, 0, 0);
      if (!mesh_.is_isolated(v)) {
        for (const Face f : mesh_.faces_around_target(mesh_.halfedge(v))) {
          if (f != Mesh::null_face()) sum = sum + face_normals_[f];
        }
      }
      vertex_normals_[v] = unit(sum);
    }
  }

  void smooth() override {
    for (const Vertex v : mesh_.vertices()) {
      if (!is_inner(v)) continue;
      const Ring ring = ring_of(v);
      mesh_.point(v) = CGAL::ORIGIN + ring.sum / static_cast<float>(ring.valence);
    }
  }

  void subdivide() override {
    const Size vertex_count = mesh_.number_of_vertices();
    const Size edge_count = mesh_.number_of_edges();
    const Size face_count = mesh_.number_of_faces();
    mesh_.reserve(vertex_count + face_count, edge_count + 3 * face_count, 3 * face_count);
    std::vector<Point> moved;
    moved.reserve(vertex_count);
    for (const Vertex v : mesh_.vertices()) moved.push_back(subdivided(v));
    for (Size f = 0; f < face_count; ++f) split(Face(f));
    for (Size v = 0; v < vertex_count; ++v) mesh_.point(Vertex(v)) = moved[v];
    for (Size e = 0; e < edge_count; ++e) {
      const Mesh::Edge_index edge(e);
      if (!mesh_.is_border(edge)) CGAL::Euler::flip_edge(mesh_.halfedge(edge), mesh_);
    }
  }

  void split_and_collapse() override {
    const Size vertex_count = mesh_.number_of_vertices();
    const Size face_count = mesh_.number_of_faces();
    mesh_.reserve(vertex_count + face_count, mesh_.number_of_edges() + 3 * face_count,
                  3 * face_count);
    for (Size f = 0; f < face_count; ++f) split(Face(f));
    for (Size v = vertex_count; v < vertex_count + face_count; ++v) {
      if (is_by_removal_) {
        CGAL::Euler::remove_center_vertex(mesh_.halfedge(Vertex(v)), mesh_);
        continue;
      }
      // All edges at a new centre point to it, and the library keeps what an edge points to: so the
      // centre takes over what the old vertex had.
      const Halfedge h = mesh_.halfedge(Vertex(v));
      const Point point = mesh_.point(mesh_.source(h));
      const Index id = ids_[mesh_.source(h)];
      const Vertex kept = CGAL::Euler::collapse_edge(mesh_.edge(h), mesh_);
      mesh_.point(kept) = point;
      ids_[kept] = id;
    }
    mesh_.collect_garbage();
  }

  void move_to(Positions positions) override {
    for (const Vertex v : mesh_.vertices()) {
      const float* p = positions[static_cast<Index>(v.idx())];
      mesh_.point(v) = Point(p[0], p[1], p[2]);
    }
  }
  [[nodiscard]] std::vector<float> vertex_normals() const override {
    std::vector<float> normals;
    for (const Vertex v : mesh_.vertices()) {
      const Vector& n = vertex_normals_[v];
      normals.insert(normals.end(), {n.x(), n.y(), n.z()});
    }
    return normals;
  }
  [[nodiscard]] ImrSurface surface() const override {
    ImrSurface surface;
    surface.xyz.resize(3 * mesh_.number_of_vertices());
    for (const Vertex v : mesh_.vertices()) {
      const Point& p = mesh_.point(v);
      float* out = surface.xyz.data() + 3 * static_cast<std::size_t>(ids_[v]);
      out[0] = p.x();
      out[1] = p.y();
      out[2] = p.z();
    }
    for (const Face f : mesh_.faces()) {
      for (const Vertex v : mesh_.vertices_around_face(mesh_.halfedge(f))) {
        surface.corners.push_back(ids_[v]);
      }
    }
    return surface;
  }

  template <bool is_by_removal>
  static std::unique_ptr<ImrMesh> make(const FaceList& faces, Positions positions,
                                       const Execution& /*execution*/) {
    auto mesh = std::make_unique<CgalImr>();
    mesh->is_by_removal_ = is_by_removal;
    if (!mesh->fill(faces, positions)) return nullptr;
    return mesh;
  }

 private:
  struct Ring {
    Vector sum = Vector(0, 0, 0);
    int valence = 0;
  };

  static Vector unit(const Vector& vector) {
    const float squared = vector.squared_length();
    return squared > 0 ? vector / std::sqrt(squared) : vector;
  }
  static Vector from_origin(const Point& point) { return point - CGAL::ORIGIN; }

  [[nodiscard]] bool is_inner(Vertex v) const {
    return !mesh_.is_isolated(v) && !mesh_.is_border(v, false);
  }
  [[nodiscard]] Ring ring_of(Vertex v) const {
    Ring ring;
    for (const Vertex u : mesh_.vertices_around_target(mesh_.halfedge(v))) {
      ring.sum = ring.sum + from_origin(mesh_.point(u));
      ++ring.valence;
    }
    return ring;
  }
  [[nodiscard]] Point subdivided(Vertex v) const {
    if (!is_inner(v)) return mesh_.point(v);
    const Ring ring = ring_of(v);
    const auto share = static_cast<float>(sqrt3_share(ring.valence));
    return CGAL::ORIGIN + (from_origin(mesh_.point(v)) * (1 - share) +
                           ring.sum * (share / static_cast<float>(ring.valence)));
  }

  void split(Face f) {
    Vector sum(0, 0, 0);
    for (const Vertex v : mesh_.vertices_around_face(mesh_.halfedge(f))) {
      sum = sum + from_origin(mesh_.point(v));
    }
    const Halfedge h = CGAL::Euler::add_center_vertex(mesh_.halfedge(f), mesh_);
    const Vertex center = mesh_.target(h);
    mesh_.point(center) = CGAL::ORIGIN + sum / 3;
    ids_[center] = static_cast<Index>(center.idx());
  }

  Mesh mesh_;
  Mesh::Property_map<Vertex, Index> ids_;  // in the numbers of the face list
  Mesh::Property_map<Vertex, Vector> vertex_normals_;
  Mesh::Property_map<Face, Vector> face_normals_;
  bool is_by_removal_ = false;
};

}  // namespace

std::vector<ImrKind> imr_cgal() {
  return {{"cgal", {kImrRows.begin(), kImrRows.end()}, CgalImr::make<false>},
          {"cgal-removal", {ImrRow::collapse}, CgalImr::make<true>}};
}

}  // namespace hedgerow::bench
