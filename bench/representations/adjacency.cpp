// Faces and half-edges without vertices.
#include "hedgerow/adjacency.h"

#include "representations/built.h"
#include "representations/topology_walk.h"

namespace hedgerow::bench {

namespace {

/// Asked what needs no id of a vertex. What is true of the whole mesh comes from `summarise`, which
/// finds the vertices as orbits: all numbers of the summary in one pass, whichever is asked.
class AdjacencyMesh final : public Representation {
 public:
  explicit AdjacencyMesh(Adjacency&& adjacency)
      : adjacency_(std::move(adjacency)), walk_(AdjacencyView(adjacency_), Positions{}) {}

  [[nodiscard]] std::size_t bytes() const override { return adjacency_.bytes(); }
  [[nodiscard]] std::optional<std::uint64_t> answer(Question question) const override {
    switch (question) {
      case Question::components:
        return static_cast<std::uint64_t>(summarise(adjacency_).components);
      case Question::euler:
        return static_cast<std::uint64_t>(summarise(adjacency_).euler());
      case Question::genus:
        return static_cast<std::uint64_t>(summarise(adjacency_).genus());
      default:
        return Walked(walk_).answer_without_vertices(question);
    }
  }
  void compute_vertex_normals() override {}
  [[nodiscard]] std::vector<float> vertex_normals() const override { return {}; }

 private:
  Adjacency adjacency_;
  TopologyWalk<AdjacencyView, false> walk_;
};

}  // namespace

std::unique_ptr<Representation> build_adjacency_only(const FaceList& faces, Positions) {
  return std::make_unique<AdjacencyMesh>(build_adjacency(built_core(faces), Execution::serial()));
}

}  // namespace hedgerow::bench
