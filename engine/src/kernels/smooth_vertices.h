#pragma once

#include <cmath>

#include "hedgerow/circulate.h"
#include "hedgerow/index.h"
#include "hedgerow/positions.h"
#include "hedgerow/query.h"
#include "hedgerow/smooth.h"
#include "kernels/normals_math.h"

/// One step of Laplacian smoothing.
namespace hedgerow::kernels {

/// From where to where; they may be the same array, which is then changed on the way.
struct SmoothStep {
  Positions from;
  MutablePositions to;
  float step;

  [[nodiscard]] Vec3<double> operator[](VertexId v) const noexcept {
    const float* p = from[v.value];
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
};

/// The cotangent of the angle at `p` between the ways to `a` and `b`; nothing of a negative one,
/// nor where there is no angle.
[[nodiscard]] inline double cotangent(Vec3<double> p, Vec3<double> a, Vec3<double> b) noexcept {
  const Vec3<double> u = a - p;
  const Vec3<double> v = b - p;
  const Vec3<double> c = cross(u, v);
  const double sine = std::sqrt(dot(c, c));
  const double cosine = dot(u, v);
  return sine > 0 && cosine > 0 ? cosine / sine : 0;
}

/// The weight of the half-edge that leaves the vertex to be moved.
template <SmoothWeights W, class Mesh>
[[nodiscard]] double weight_of(const Mesh& mesh, const SmoothStep& step, HalfedgeId h) noexcept {
  if constexpr (W == SmoothWeights::umbrella) return 1;
  const HalfedgeId o = mesh.opposite[h];
  const Vec3<double> here = step[mesh.origin[h]];
  const Vec3<double> there = step[mesh.target(h)];
  return cotangent(step[mesh.origin[mesh.prev(h)]], here, there) +
         cotangent(step[mesh.origin[mesh.prev(o)]], here, there);
}

template <class Mesh>
[[nodiscard]] bool is_movable(const Mesh& mesh, VertexId v) noexcept {
  return mesh.outgoing[v].valid() && !is_boundary(mesh, v) && extra_fans(mesh.fans, v).empty();
}

template <SmoothWeights W, class Mesh>
void smooth_weighted(IndexRange range, const Mesh& mesh, const SmoothStep& step) noexcept {
  for (VertexId v(range.begin); v.value < range.end; ++v.value) {
    float* to = step.to[v.value];
    const float* here = step.from[v.value];
    Vec3<double> sum{0, 0, 0};
    double weights = 0;
    if (is_movable(mesh, v)) {
      for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
        const double weight = weight_of<W>(mesh, step, h);
        sum = sum + step[mesh.target(h)] * weight;
        weights += weight;
      }
    }
    const Vec3<double> way = sum * (1 / weights) - step[v];
    const Vec3<double> place = step[v] + way * static_cast<double>(step.step);
    const auto x = static_cast<float>(place.x);
    const auto y = static_cast<float>(place.y);
    const auto z = static_cast<float>(place.z);
    // Not finite without weights, too: 0 / 0.
    const bool is_moved = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
    to[0] = is_moved ? x : here[0];
    to[1] = is_moved ? y : here[1];
    to[2] = is_moved ? z : here[2];
  }
}

/// Moves the vertices of a range. Reads those of their neighbours.
template <class Mesh>
void smooth_vertices(IndexRange range, const Mesh& mesh, const SmoothStep& step,
                     SmoothWeights weights) noexcept {
  if (weights == SmoothWeights::cotangent) {
    smooth_weighted<SmoothWeights::cotangent>(range, mesh, step);
  } else {
    smooth_weighted<SmoothWeights::umbrella>(range, mesh, step);
  }
}

inline void copy_positions(IndexRange range, const Positions& from,
                           const MutablePositions& to) noexcept {
  for (Index v = range.begin; v < range.end; ++v) {
    for (int k = 0; k < 3; ++k) to[v][k] = from[v][k];
  }
}

}  // namespace hedgerow::kernels
