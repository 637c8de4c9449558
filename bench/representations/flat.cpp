// The columns of the core: implicit, stored, closed, and with the cycles round edges.
#include "hedgerow/boundary.h"
#include "hedgerow/radial.h"
#include "representations/built.h"
#include "representations/topology_walk.h"

namespace hedgerow::bench {

namespace {

const auto kTriangles = [](const Connectivity& mesh) { return mesh.triangles(); };
const auto kPolygons = [](const Connectivity& mesh) { return mesh.polygons(); };

/// The implicit columns with `radial_next` beside them: asked for the faces of an edge only, as all
/// other answers are those of the columns.
class RadialMesh final : public Representation {
 public:
  explicit RadialMesh(Connectivity&& mesh)
      : mesh_(std::move(mesh)), cycles_(build_radial(mesh_, Execution::serial())) {}

  [[nodiscard]] std::size_t bytes() const override {
    return mesh_.bytes() + static_cast<std::size_t>(mesh_.halfedge_count()) * sizeof(Index);
  }
  [[nodiscard]] std::optional<std::uint64_t> answer(Question question) const override {
    if (question != Question::edge_faces) return std::nullopt;
    const TriangleView view = mesh_.triangles();
    std::uint64_t sum = 0;
    for (Index i = 0; i < view.halfedge_count(); ++i) {
      const HalfedgeId start(i);
      if (cycles_.next(start) < start) continue;  // not the smallest of two, nor of most
      if (smallest_halfedge(cycles_, start) != start) continue;
      HalfedgeId h = start;
      do {
        sum += static_cast<std::uint64_t>(view.face(h).value + 1);
        h = cycles_.next(h);
      } while (h != start);
    }
    return sum;
  }
  void compute_vertex_normals() override {}
  [[nodiscard]] std::vector<float> vertex_normals() const override { return {}; }

 private:
  Connectivity mesh_;
  RadialCycles cycles_;
};

}  // namespace

std::unique_ptr<Representation> build_flat(const FaceList& faces, Positions positions) {
  Connectivity mesh = built_core(faces);
  const std::size_t bytes = mesh.bytes();
  using Mesh = ViewedMesh<Connectivity, TriangleView, false>;
  return std::make_unique<Mesh>(std::move(mesh), bytes, positions, kTriangles);
}

std::unique_ptr<Representation> build_flat_stored(const FaceList& faces, Positions positions) {
  Connectivity mesh = built_core(faces);
  mesh.materialise(Execution::serial());
  const std::size_t bytes = mesh.bytes();
  using Mesh = ViewedMesh<Connectivity, PolygonView, false>;
  return std::make_unique<Mesh>(std::move(mesh), bytes, positions, kPolygons);
}

std::unique_ptr<Representation> build_flat_closed(const FaceList& faces, Positions positions) {
  Connectivity mesh = value_of(close_boundary(built_core(faces), Execution::serial()));
  const std::size_t bytes = mesh.bytes();
  using Mesh = ViewedMesh<Connectivity, PolygonView, true>;
  return std::make_unique<Mesh>(std::move(mesh), bytes, positions, kPolygons);
}

std::unique_ptr<Representation> build_flat_radial(const FaceList& faces, Positions) {
  return std::make_unique<RadialMesh>(built_core(faces));
}

}  // namespace hedgerow::bench
