// The non-manifold winged-edge records: every answer is a row, nothing is walked.
#include "baselines/src/ring_algorithms.h"
#include "hedgerow/nonmanifold_edge.h"
#include "representations/built.h"
#include "representations/representation.h"

namespace hedgerow::bench {

namespace {

std::uint64_t as_number(Index i) noexcept { return static_cast<std::uint64_t>(i); }
std::uint64_t weighed(Index element, std::uint64_t sum) noexcept {
  return as_number(element + 1) * sum;
}

class NonmanifoldMesh final : public Representation {
 public:
  NonmanifoldMesh(NonmanifoldEdges&& edges, Positions positions)
      : edges_(std::move(edges)),
        positions_(positions),
        normals_(3 * static_cast<std::size_t>(positions.count)) {}

  [[nodiscard]] std::size_t bytes() const override { return edges_.bytes(); }
  [[nodiscard]] std::optional<std::uint64_t> answer(Question question) const override {
    switch (question) {
      case Question::face_vertices:
      case Question::face_edges:
      case Question::face_faces:
      case Question::face_neighbours:
      case Question::is_boundary_face:
        return of_faces(question);
      case Question::ring_halfedges:  // rows have no rotation
      case Question::ring_reversed:
        return std::nullopt;
      case Question::ring_vertices:
      case Question::ring_faces:
      case Question::is_boundary_vertex:
        return of_vertices(question);
      case Question::face_degree:
        return of_uses();
      case Question::edge_faces:
      case Question::is_boundary_half:
      case Question::is_boundary_edge:
        return of_edges(question);
      default:
        return of_mesh(question);
    }
  }
  void compute_vertex_normals() override {
    using namespace baselines::detail;
    for (Index v = 0; v < edges_.vertex_count(); ++v) {
      Vector sum;
      for (const FaceId f : edges_.vertex_faces[VertexId(v)]) {
        const std::span<const VertexId> corners = edges_.face_vertices[f];
        const Vector a = load(positions_[corners[0].value]);
        const Vector b = load(positions_[corners[1].value]);
        const Vector c = load(positions_[corners[2].value]);
        sum = sum + cross(b - a, c - a);
      }
      store(normalized(sum), normals_.data() + 3 * v);
    }
  }
  [[nodiscard]] std::vector<float> vertex_normals() const override { return normals_; }

 private:
  [[nodiscard]] bool is_boundary(EdgeId e) const noexcept { return edges_.uses[e].size() == 1; }
  // Of the faces at an edge of f those that are not f.
  [[nodiscard]] std::uint64_t sum_across(EdgeId e, FaceId f) const noexcept {
    std::uint64_t sum = 0;
    for (const EdgeUse& use : edges_.uses[e]) {
      if (use.face != f) sum += as_number(use.face.value + 1);
    }
    return sum;
  }

  template <class OfFace>
  [[nodiscard]] std::uint64_t sum_over_faces(const OfFace& of_face) const {
    std::uint64_t total = 0;
    for (Index f = 0; f < edges_.face_count(); ++f) total += of_face(FaceId(f));
    return total;
  }
  [[nodiscard]] std::uint64_t of_faces(Question question) const {
    return sum_over_faces([&](FaceId f) -> std::uint64_t {
      std::uint64_t sum = 0;
      switch (question) {
        case Question::face_vertices:
          for (const VertexId v : edges_.face_vertices[f]) sum += as_number(v.value);
          return weighed(f.value, sum);
        case Question::face_edges:
          for (const EdgeId e : edges_.edges_of(f)) {
            const EdgeEnds& ends = edges_.ends.data()[e.value];
            sum += as_number(ends.smaller.value) ^ as_number(ends.larger.value);
          }
          return weighed(f.value, sum);
        case Question::face_faces:
          for (const EdgeId e : edges_.edges_of(f)) sum += sum_across(e, f);
          return weighed(f.value, sum);
        case Question::face_neighbours:
          for (const EdgeId e : edges_.edges_of(f)) sum += edges_.uses[e].size() - 1;
          return weighed(f.value, sum);
        default:
          for (const EdgeId e : edges_.edges_of(f)) sum |= std::uint64_t{is_boundary(e)};
          return sum;
      }
    });
  }

  [[nodiscard]] std::uint64_t of_vertices(Question question) const {
    std::uint64_t total = 0;
    for (Index i = 0; i < edges_.vertex_count(); ++i) {
      const VertexId v(i);
      std::uint64_t sum = 0;
      if (question == Question::ring_faces) {
        for (const FaceId f : edges_.vertex_faces[v]) sum += as_number(f.value + 1);
        total += weighed(i, sum);
      } else if (question == Question::ring_vertices) {
        for (const EdgeId e : edges_.vertex_edges[v]) {
          sum += as_number(edges_.other_end(e, v).value);
        }
        total += weighed(i, sum);
      } else {
        for (const EdgeId e : edges_.vertex_edges[v]) sum |= std::uint64_t{is_boundary(e)};
        total += sum;
      }
    }
    return total;
  }

  // A use of an edge is what a half-edge is elsewhere.
  [[nodiscard]] std::uint64_t of_uses() const {
    std::uint64_t sum = 0;
    for (const EdgeUse& use : edges_.uses.values) sum += edges_.face_vertices[use.face].size();
    return sum;
  }

  [[nodiscard]] std::uint64_t of_edges(Question question) const {
    std::uint64_t sum = 0;
    for (Index i = 0; i < edges_.edge_count(); ++i) {
      const EdgeId e(i);
      if (question == Question::edge_faces) {
        for (const EdgeUse& use : edges_.uses[e]) sum += as_number(use.face.value + 1);
      } else {
        sum += is_boundary(e);
      }
    }
    return sum;
  }

  // The other boundary edge at the end of a boundary edge.
  [[nodiscard]] EdgeId next_boundary(EdgeId e, VertexId v) const noexcept {
    for (const EdgeId other : edges_.vertex_edges[v]) {
      if (other != e && is_boundary(other)) return other;
    }
    return e;
  }
  template <class Visit>
  void walk_loop(EdgeId start, const Visit& visit) const {
    VertexId v = edges_.ends.data()[start.value].larger;
    EdgeId e = start;
    do {
      visit(e, v);
      e = next_boundary(e, v);
      v = edges_.other_end(e, v);
    } while (e != start);
  }
  [[nodiscard]] std::uint64_t sum_loop() const {
    for (Index v = 0; v < edges_.vertex_count(); ++v) {
      for (const EdgeId e : edges_.vertex_edges[VertexId(v)]) {
        if (!is_boundary(e)) continue;
        std::uint64_t sum = 0;
        walk_loop(e, [&](EdgeId, VertexId u) { sum += as_number(u.value); });
        return sum;
      }
    }
    return 0;
  }
  [[nodiscard]] std::uint64_t count_loops() const {
    std::vector<bool> seen(edges_.ends.size(), false);
    std::uint64_t loops = 0;
    for (Index i = 0; i < edges_.edge_count(); ++i) {
      if (!is_boundary(EdgeId(i)) || seen[static_cast<std::size_t>(i)]) continue;
      ++loops;
      walk_loop(EdgeId(i),
                [&](EdgeId e, VertexId) { seen[static_cast<std::size_t>(e.value)] = true; });
    }
    return loops;
  }
  [[nodiscard]] std::uint64_t count_components() const {
    baselines::detail::Sets sets(static_cast<std::size_t>(edges_.vertex_count()));
    for (const EdgeEnds& ends : edges_.ends) sets.unite(ends.smaller.value, ends.larger.value);
    std::uint64_t count = 0;
    for (Index v = 0; v < edges_.vertex_count(); ++v) {
      count += !edges_.vertex_faces[VertexId(v)].empty() && sets.find(v) == v;
    }
    return count;
  }
  [[nodiscard]] std::uint64_t euler() const {
    std::uint64_t sum = as_number(edges_.face_count()) - as_number(edges_.edge_count());
    for (Index v = 0; v < edges_.vertex_count(); ++v) {
      sum += !edges_.vertex_faces[VertexId(v)].empty();
    }
    return sum;
  }
  [[nodiscard]] std::uint64_t of_mesh(Question question) const {
    switch (question) {
      case Question::boundary_loop:
        return sum_loop();
      case Question::boundary_loops:
        return count_loops();
      case Question::components:
        return count_components();
      case Question::euler:
        return euler();
      default:
        return (2 * count_components() - count_loops() - euler()) / 2;
    }
  }

  NonmanifoldEdges edges_;
  Positions positions_;
  std::vector<float> normals_;
};

}  // namespace

std::unique_ptr<Representation> build_nonmanifold(const FaceList& faces, Positions positions) {
  const Connectivity mesh = built_core(faces);
  const RadialCycles cycles = build_radial(mesh, Execution::serial());
  return std::make_unique<NonmanifoldMesh>(value_of(build_nonmanifold_edges(mesh, cycles)),
                                           positions);
}

}  // namespace hedgerow::bench
