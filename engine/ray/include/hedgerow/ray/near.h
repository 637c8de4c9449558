#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hedgerow/circulate.h"
#include "hedgerow/positions.h"
#include "hedgerow/ray/ray.h"

/// The surroundings of a point of the surface, along the edges of the mesh. The one-ring is
/// `neighbours` of circulate.h.
namespace hedgerow::ray {

struct VertexDistance {
  VertexId vertex{};
  float distance = 0;

  friend bool operator==(const VertexDistance&, const VertexDistance&) noexcept = default;
};

namespace detail {

inline Vec3 between(const float* from, const float* to) noexcept {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}
inline float dot(const Vec3& a, const Vec3& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline float length(const Vec3& a) noexcept { return std::sqrt(dot(a, a)); }

}  // namespace detail

/// Searches of small neighbourhoods, one after the other, over memory that is kept: four bytes a
/// vertex of the mesh and what a search finds. A search that finds no more than one before it
/// allocates nothing, and does not visit the rest of the mesh.
///
/// Threads    One search at a time: give each thread its own.
/// Lifetime   Answers are valid until the next search. Throws std::bad_alloc.
class NearbySearch {
 public:
  /// The vertices at most `rings` edges away from `start`: itself first, then ring by ring, each in
  /// the order in which `neighbours` of the ring before names them. O(edges at what is found).
  /// \pre rings >= 0
  template <Topology Mesh>
  [[nodiscard]] std::span<const VertexId> k_ring(const Mesh& mesh, VertexId start, int rings) {
    begin(mesh.vertex_count());
    found_.clear();
    meet(start);
    std::size_t done = 0;
    for (int ring = 0; ring < rings; ++ring) {
      for (const std::size_t end = found_.size(); done < end; ++done) {
        for (const VertexId u : neighbours(mesh, found_[done])) meet(u);
      }
    }
    return found_;
  }

  /// The vertices within `radius` of a point of the surface, along edges: the way goes from the
  /// point straight to a corner of its triangle and on by edges. In the order of distance, equal
  /// ones by vertex id. Each distance is the smallest of the float sums along all ways, taken from
  /// the point on: E. Dijkstra, "A note on two problems in connexion with graphs", 1959.
  /// O(n log n) in the edges at what is found.
  template <Topology Mesh>
  [[nodiscard]] std::span<const VertexDistance> geodesic_ball(const Mesh& mesh, Positions positions,
                                                              const SurfacePoint& point,
                                                              float radius) {
    begin(mesh.vertex_count());
    ball_.clear();
    heap_.clear();
    Vec3 at{};
    for (std::size_t k = 0; k < 3; ++k) {
      const float* corner = positions[mesh.origin[point.corners[k]].value];
      for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += point.weights[k] * corner[axis];
    }
    for (const HalfedgeId h : point.corners) {
      const float* corner = positions[mesh.origin[h].value];
      push({mesh.origin[h], detail::length(detail::between(at.data(), corner))}, radius);
    }
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), is_further);
      const VertexDistance nearest = heap_.back();
      heap_.pop_back();
      if (!mark(nearest.vertex)) continue;
      ball_.push_back(nearest);
      const float* from = positions[nearest.vertex.value];
      for (const VertexId u : neighbours(mesh, nearest.vertex)) {
        if (is_marked(u)) continue;
        const float edge = detail::length(detail::between(from, positions[u.value]));
        push({u, nearest.distance + edge}, radius);
      }
    }
    return ball_;
  }

 private:
  static bool is_further(const VertexDistance& a, const VertexDistance& b) noexcept {
    if (a.distance != b.distance) return a.distance > b.distance;
    return a.vertex > b.vertex;
  }
  void begin(Index vertex_count) {
    if (stamp_of_.size() < static_cast<std::size_t>(vertex_count)) {
      stamp_of_.resize(static_cast<std::size_t>(vertex_count));
    }
    if (++stamp_ == 0) {  // after 2^32 searches the old stamps would mean something again
      std::fill(stamp_of_.begin(), stamp_of_.end(), 0U);
      stamp_ = 1;
    }
  }
  [[nodiscard]] bool is_marked(VertexId v) const noexcept {
    return stamp_of_[static_cast<std::size_t>(v.value)] == stamp_;
  }
  bool mark(VertexId v) noexcept {
    return std::exchange(stamp_of_[static_cast<std::size_t>(v.value)], stamp_) != stamp_;
  }
  void meet(VertexId v) {
    if (mark(v)) found_.push_back(v);
  }
  void push(const VertexDistance& next, float radius) {
    if (!(next.distance <= radius)) return;
    heap_.push_back(next);
    std::push_heap(heap_.begin(), heap_.end(), is_further);
  }

  std::vector<std::uint32_t> stamp_of_;
  std::uint32_t stamp_ = 0;
  std::vector<VertexId> found_;
  std::vector<VertexDistance> heap_;
  std::vector<VertexDistance> ball_;
};

/// Walks from vertex to vertex along the edge that turns least from `direction`, and writes the
/// vertices after `start`. Ends when `out` is full or no edge leads less than a right angle from
/// the direction: at the rim, or where the surface turns away. Returns the steps taken.
///
/// Ties go to the smaller vertex id; edges without length are never taken. O(valence) a step.
/// \pre direction is finite
template <Topology Mesh>
[[nodiscard]] std::size_t edge_walk(const Mesh& mesh, Positions positions, VertexId start,
                                    const Vec3& direction, std::span<VertexId> out) noexcept {
  VertexId at = start;
  for (std::size_t step = 0; step < out.size(); ++step) {
    VertexId best;
    float best_cosine = 0;
    for (const VertexId u : neighbours(mesh, at)) {
      const Vec3 edge = detail::between(positions[at.value], positions[u.value]);
      const float edge_length = detail::length(edge);
      if (!(edge_length > 0)) continue;
      const float cosine = detail::dot(edge, direction) / edge_length;
      if (cosine > best_cosine || (best.valid() && cosine == best_cosine && u < best)) {
        best = u;
        best_cosine = cosine;
      }
    }
    if (!best.valid()) return step;
    out[step] = best;
    at = best;
  }
  return out.size();
}

}  // namespace hedgerow::ray
