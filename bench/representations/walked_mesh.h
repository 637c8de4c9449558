#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "baselines/src/ring_algorithms.h"
#include "representations/representation.h"

namespace hedgerow::bench {

/// The questions, asked by walking: the same loops for every layout, so that the times tell the
/// layouts apart and nothing else.
///
/// `Walk` has a `Handle` of a half-edge, with ==; is_valid, next, prev, opposite (invalid: none),
/// origin, target and face (numbers; -1 = none) of it; position of its origin; vertex_count(),
/// face_count(), outgoing(v); for_each_side(f, visit), for_each_halfedge(visit) and
/// for_each_edge(visit), which gives one half-edge of each edge; kIsClosed; and `Marks`, a set of
/// half-edges made from a walk. One fan at each vertex.
template <class Walk>
class Walked {
 public:
  using Handle = typename Walk::Handle;

  explicit Walked(const Walk& walk) : walk_(walk) {}

  [[nodiscard]] std::uint64_t answer(Question question) const {
    switch (question) {
      case Question::face_vertices:
      case Question::face_edges:
        return of_corners(question);
      case Question::ring_halfedges:
      case Question::ring_reversed:
      case Question::ring_vertices:
      case Question::ring_faces:
      case Question::is_boundary_vertex:
        return of_vertices(question);
      case Question::boundary_loop:
        return sum_loop();
      case Question::components:
        return count_components();
      case Question::euler:
        return euler();
      case Question::genus:
        return (2 * count_components() - count_loops() - euler()) / 2;
      default:
        return answer_without_vertices(question);
    }
  }
  /// What of the above takes no origin, target, vertex_count, outgoing or position.
  [[nodiscard]] std::uint64_t answer_without_vertices(Question question) const {
    switch (question) {
      case Question::face_degree:
        return of_degrees();
      case Question::edge_faces:
      case Question::is_boundary_half:
      case Question::is_boundary_edge:
        return of_edges(question);
      case Question::boundary_loops:
        return count_loops();
      default:
        return of_faces(question);
    }
  }

  void fill_vertex_normals(const auto& store) const {
    using namespace baselines::detail;
    for (Index v = 0; v < walk_.vertex_count(); ++v) {
      Vector sum;
      for_each_outgoing(walk_, walk_.outgoing(v), [&](Handle h) {
        if (Walk::kIsClosed && walk_.face(h) < 0) return;
        const Vector corner = load(walk_.position(h));
        const Vector a = load(walk_.position(walk_.next(h))) - corner;
        const Vector b = load(walk_.position(walk_.prev(h))) - corner;
        sum = sum + cross(a, b);
      });
      store(v, normalized(sum));
    }
  }

 private:
  [[nodiscard]] bool has_face_across(Handle h) const {
    const Handle across = walk_.opposite(h);
    return walk_.is_valid(across) && (!Walk::kIsClosed || walk_.face(across) >= 0);
  }
  static std::uint64_t as_number(Index i) noexcept { return static_cast<std::uint64_t>(i); }
  // Which element an answer belongs to counts, too.
  static std::uint64_t weighed(Index element, std::uint64_t sum) noexcept {
    return as_number(element + 1) * sum;
  }

  template <class OfSide>
  [[nodiscard]] std::uint64_t sum_over_faces(const OfSide& of_side) const {
    std::uint64_t total = 0;
    for (Index f = 0; f < walk_.face_count(); ++f) {
      std::uint64_t sum = 0;
      walk_.for_each_side(f, [&](Handle h) { sum += of_side(h); });
      total += weighed(f, sum);
    }
    return total;
  }
  [[nodiscard]] std::uint64_t of_corners(Question question) const {
    if (question == Question::face_vertices) {
      return sum_over_faces([&](Handle h) { return as_number(walk_.origin(h)); });
    }
    return sum_over_faces(
        [&](Handle h) { return as_number(walk_.origin(h)) ^ as_number(walk_.target(h)); });
  }
  [[nodiscard]] std::uint64_t of_faces(Question question) const {
    switch (question) {
      case Question::face_faces:
        return sum_over_faces([&](Handle h) {
          const Handle across = walk_.opposite(h);
          const Index f = walk_.is_valid(across) ? walk_.face(across) : kInvalidIndex;
          return as_number(f + 1);
        });
      case Question::face_neighbours:
        return sum_over_faces([&](Handle h) { return std::uint64_t{has_face_across(h)}; });
      default: {
        std::uint64_t count = 0;
        for (Index f = 0; f < walk_.face_count(); ++f) {
          bool is_boundary = false;
          walk_.for_each_side(f, [&](Handle h) { is_boundary |= !has_face_across(h); });
          count += is_boundary;
        }
        return count;
      }
    }
  }
  [[nodiscard]] std::uint64_t of_degrees() const {
    std::uint64_t sum = 0;
    walk_.for_each_halfedge([&](Handle h) {
      if (!Walk::kIsClosed || walk_.face(h) >= 0) sum += as_number(walk_.degree(h));
    });
    return sum;
  }

  template <class OfVertex>
  [[nodiscard]] std::uint64_t sum_over_vertices(const OfVertex& of_vertex) const {
    std::uint64_t total = 0;
    for (Index v = 0; v < walk_.vertex_count(); ++v) {
      const Handle start = walk_.outgoing(v);
      if (walk_.is_valid(start)) total += weighed(v, of_vertex(start));
    }
    return total;
  }
  [[nodiscard]] std::uint64_t count_reversed(Handle start) const {
    // In the default form the last of an open fan is where this way begins.
    if (!Walk::kIsClosed && !walk_.is_valid(walk_.opposite(walk_.prev(start)))) {
      while (walk_.is_valid(walk_.opposite(start))) start = walk_.next(walk_.opposite(start));
    }
    std::uint64_t count = 0;
    Handle h = start;
    do {
      ++count;
      h = walk_.opposite(walk_.prev(h));
    } while (walk_.is_valid(h) && !(h == start));
    return count;
  }
  [[nodiscard]] std::uint64_t of_vertices(Question question) const {
    using baselines::detail::for_each_outgoing;
    switch (question) {
      case Question::ring_halfedges:
        return sum_over_vertices([&](Handle start) {
          std::uint64_t count = 0;
          for_each_outgoing(walk_, start, [&](Handle) { ++count; });
          return count;
        });
      case Question::ring_reversed:
        return sum_over_vertices([&](Handle start) { return count_reversed(start); });
      case Question::ring_vertices:
        return sum_over_vertices([&](Handle start) {
          std::uint64_t sum = 0;
          for_each_outgoing(walk_, start, [&](Handle h) { sum += as_number(walk_.target(h)); });
          if constexpr (!Walk::kIsClosed) {
            const Handle before = walk_.prev(start);
            if (!walk_.is_valid(walk_.opposite(before))) sum += as_number(walk_.origin(before));
          }
          return sum;
        });
      case Question::ring_faces:
        return sum_over_vertices([&](Handle start) {
          std::uint64_t sum = 0;
          for_each_outgoing(walk_, start, [&](Handle h) { sum += as_number(walk_.face(h) + 1); });
          return sum;
        });
      default: {
        std::uint64_t count = 0;
        for (Index v = 0; v < walk_.vertex_count(); ++v) count += is_boundary(walk_.outgoing(v));
        return count;
      }
    }
  }
  // Of the vertex whose rotation starts here.
  [[nodiscard]] bool is_boundary(Handle start) const {
    if (!walk_.is_valid(start)) return false;
    return Walk::kIsClosed ? walk_.face(start) < 0
                           : !walk_.is_valid(walk_.opposite(walk_.prev(start)));
  }

  [[nodiscard]] bool is_boundary_half(Handle h) const {
    return Walk::kIsClosed ? walk_.face(h) < 0 : !walk_.is_valid(walk_.opposite(h));
  }
  [[nodiscard]] std::uint64_t of_edges(Question question) const {
    std::uint64_t sum = 0;
    switch (question) {
      case Question::edge_faces:
        walk_.for_each_edge([&](Handle h) {
          const Handle across = walk_.opposite(h);
          sum += as_number(walk_.face(h) + 1);
          if (walk_.is_valid(across)) sum += as_number(walk_.face(across) + 1);
        });
        return sum;
      case Question::is_boundary_half:
        walk_.for_each_halfedge([&](Handle h) { sum += is_boundary_half(h); });
        return sum;
      default:
        walk_.for_each_edge([&](Handle h) {
          sum += is_boundary_half(h) || (Walk::kIsClosed && is_boundary_half(walk_.opposite(h)));
        });
        return sum;
    }
  }

  [[nodiscard]] Handle next_boundary(Handle h) const {
    return Walk::kIsClosed ? walk_.next(h) : baselines::detail::next_boundary(walk_, h);
  }
  template <class Visit>
  void walk_loop(Handle start, const Visit& visit) const {
    Handle h = start;
    do {
      visit(h);
      h = next_boundary(h);
    } while (!(h == start));
  }
  [[nodiscard]] std::uint64_t sum_loop() const {
    // The boundary half-edge at the smallest boundary vertex: the same loop in every layout.
    for (Index v = 0; v < walk_.vertex_count(); ++v) {
      Handle h = walk_.outgoing(v);
      if (!is_boundary(h)) continue;
      if (!Walk::kIsClosed) {
        while (walk_.is_valid(walk_.opposite(h))) h = walk_.next(walk_.opposite(h));
      }
      std::uint64_t sum = 0;
      walk_loop(h, [&](Handle g) { sum += as_number(walk_.origin(g)); });
      return sum;
    }
    return 0;
  }
  [[nodiscard]] std::uint64_t count_loops() const {
    typename Walk::Marks seen(walk_);
    std::uint64_t loops = 0;
    walk_.for_each_halfedge([&](Handle h) {
      if (!is_boundary_half(h) || !seen.insert(h)) return;
      ++loops;
      walk_loop(h, [&](Handle g) { seen.insert(g); });
    });
    return loops;
  }
  [[nodiscard]] std::uint64_t count_components() const {
    baselines::detail::Sets sets(static_cast<std::size_t>(walk_.vertex_count()));
    walk_.for_each_edge([&](Handle h) { sets.unite(walk_.origin(h), walk_.target(h)); });
    std::uint64_t count = 0;
    for (Index v = 0; v < walk_.vertex_count(); ++v) {
      count += walk_.is_valid(walk_.outgoing(v)) && sets.find(v) == v;
    }
    return count;
  }
  [[nodiscard]] std::uint64_t euler() const {
    std::uint64_t sum = as_number(walk_.face_count());
    for (Index v = 0; v < walk_.vertex_count(); ++v) sum += walk_.is_valid(walk_.outgoing(v));
    walk_.for_each_edge([&](Handle) { --sum; });
    return sum;
  }

  const Walk& walk_;
};

}  // namespace hedgerow::bench
