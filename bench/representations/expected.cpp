#include "representations/expected.h"

#include <algorithm>
#include <vector>

namespace hedgerow::bench {

namespace {

std::uint64_t as_number(Index i) noexcept { return static_cast<std::uint64_t>(i); }

/// Triangles with their pairs, the plainest way.
struct Plain {
  explicit Plain(const Dataset& data)
      : corners(static_cast<const Index*>(data.faces().corners)),
        opposite(data.reference().opposite),
        count(static_cast<Index>(opposite.size())),
        vertex_count(data.mesh.vertex_count()) {}

  [[nodiscard]] Index across(Index h) const { return opposite[static_cast<std::size_t>(h)]; }
  [[nodiscard]] bool is_boundary(Index h) const { return across(h) == kInvalidIndex; }
  [[nodiscard]] static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] Index origin(Index h) const { return corners[h]; }
  [[nodiscard]] Index target(Index h) const { return corners[next(h)]; }
  [[nodiscard]] std::vector<bool> boundary_vertices() const {
    std::vector<bool> is_on(static_cast<std::size_t>(vertex_count), false);
    for (Index h = 0; h < count; ++h) {
      if (is_boundary(h)) is_on[static_cast<std::size_t>(origin(h))] = true;
    }
    return is_on;
  }

  const Index* corners;
  const std::vector<Index>& opposite;
  Index count;
  Index vertex_count;
};

template <class OfHalfedge>
std::uint64_t sum(const Plain& mesh, const OfHalfedge& of_halfedge) {
  std::uint64_t total = 0;
  for (Index h = 0; h < mesh.count; ++h) total += of_halfedge(h);
  return total;
}

std::uint64_t of_faces(const Plain& mesh, Question question) {
  return sum(mesh, [&](Index h) -> std::uint64_t {
    const std::uint64_t weight = as_number(h / 3 + 1);
    switch (question) {
      case Question::face_vertices:
        return weight * as_number(mesh.origin(h));
      case Question::face_edges:
        return weight * (as_number(mesh.origin(h)) ^ as_number(mesh.target(h)));
      case Question::face_faces:
        return mesh.is_boundary(h) ? 0 : weight * as_number(mesh.across(h) / 3 + 1);
      case Question::face_neighbours:
        return mesh.is_boundary(h) ? 0 : weight;
      case Question::face_degree:
        return 3;
      default: {  // whether one of the three is on the boundary, once
        const Index first = h - h % 3;
        if (h != first) return 0;
        return mesh.is_boundary(h) || mesh.is_boundary(h + 1) || mesh.is_boundary(h + 2);
      }
    }
  });
}

std::uint64_t of_vertices(const Plain& mesh, Question question, bool is_closed) {
  return sum(mesh, [&](Index h) -> std::uint64_t {
    const std::uint64_t weight = as_number(mesh.origin(h) + 1);
    const std::uint64_t target_weight = as_number(mesh.target(h) + 1);
    switch (question) {
      case Question::ring_vertices: {
        const std::uint64_t there = weight * as_number(mesh.target(h));
        // On the boundary no half-edge leads back.
        return there + (mesh.is_boundary(h) ? target_weight * as_number(mesh.origin(h)) : 0);
      }
      case Question::ring_faces:
        return weight * as_number(h / 3 + 1);
      default:
        return weight + (is_closed && mesh.is_boundary(h) ? target_weight : 0);
    }
  });
}

std::uint64_t sum_loop(const Plain& mesh) {
  const std::vector<bool> is_on = mesh.boundary_vertices();
  const auto first = std::find(is_on.begin(), is_on.end(), true);
  if (first == is_on.end()) return 0;
  std::vector<Index> after(static_cast<std::size_t>(mesh.vertex_count), kInvalidIndex);
  for (Index h = 0; h < mesh.count; ++h) {
    if (mesh.is_boundary(h)) after[static_cast<std::size_t>(mesh.origin(h))] = mesh.target(h);
  }
  const auto start = static_cast<Index>(first - is_on.begin());
  std::uint64_t total = 0;
  Index v = start;
  do {
    total += as_number(v);
    v = after[static_cast<std::size_t>(v)];
  } while (v != start);
  return total;
}

std::uint64_t euler(const Plain& mesh) {
  std::vector<bool> is_used(static_cast<std::size_t>(mesh.vertex_count), false);
  for (Index h = 0; h < mesh.count; ++h) is_used[static_cast<std::size_t>(mesh.origin(h))] = true;
  const auto vertices = static_cast<Index>(std::count(is_used.begin(), is_used.end(), true));
  const std::uint64_t edges = sum(mesh, [&](Index h) { return std::uint64_t{mesh.across(h) < h}; });
  return as_number(vertices) - edges + as_number(mesh.count / 3);
}

}  // namespace

std::uint64_t expected_answer(const Dataset& data, Question question, bool is_closed) {
  const Plain mesh(data);
  switch (question) {
    case Question::ring_halfedges:
    case Question::ring_reversed:
    case Question::ring_vertices:
    case Question::ring_faces:
      return of_vertices(mesh, question, is_closed);
    case Question::edge_faces:
      return sum(mesh, [](Index h) { return as_number(h / 3 + 1); });
    case Question::is_boundary_half:
    case Question::is_boundary_edge:
      return sum(mesh, [&](Index h) { return std::uint64_t{mesh.is_boundary(h)}; });
    case Question::is_boundary_vertex: {
      const std::vector<bool> is_on = mesh.boundary_vertices();
      return static_cast<std::uint64_t>(std::count(is_on.begin(), is_on.end(), true));
    }
    case Question::boundary_loop:
      return sum_loop(mesh);
    case Question::boundary_loops:
      return as_number(data.reference().boundary_loops);
    case Question::components:
      return as_number(data.reference().components);
    case Question::euler:
      return euler(mesh);
    case Question::genus: {
      const Reference& reference = data.reference();
      return (2 * as_number(reference.components) - as_number(reference.boundary_loops) -
              euler(mesh)) /
             2;
    }
    default:
      return of_faces(mesh, question);
  }
}

double question_elements(const Dataset& data, Question question) {
  const Counts counts = counts_of(data);
  const Plain mesh(data);
  switch (question) {
    case Question::edge_faces:
    case Question::is_boundary_edge:
    case Question::components:
    case Question::euler:
    case Question::genus:
      return static_cast<double>(
          sum(mesh, [&](Index h) { return std::uint64_t{mesh.across(h) < h}; }));
    case Question::face_degree:
    case Question::is_boundary_half:
    case Question::boundary_loops:
      return counts.halfedges;
    case Question::boundary_loop:
      return static_cast<double>(
          sum(mesh, [&](Index h) { return std::uint64_t{mesh.is_boundary(h)}; }));
    case Question::ring_halfedges:
    case Question::ring_reversed:
    case Question::ring_vertices:
    case Question::ring_faces:
    case Question::is_boundary_vertex:
      return counts.vertices;
    default:
      return counts.faces;
  }
}

}  // namespace hedgerow::bench
