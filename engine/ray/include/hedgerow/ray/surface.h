#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "hedgerow/positions.h"
#include "hedgerow/ray/ray.h"
#include "hedgerow/topology.h"

/// What connectivity says about a point of the surface.
///
/// Pre        The point is of a scene over `mesh`.
/// Complexity O(1); a few loads of the columns named, no search.
/// Threads    Any number of readers.
namespace hedgerow::ray {

/// Number of the corner with the largest weight; of equal ones the first.
[[nodiscard]] inline std::size_t nearest_corner(const SurfacePoint& point) noexcept {
  const Vec3& w = point.weights;
  const std::size_t first = w[1] > w[0] ? 1 : 0;
  return w[2] > w[first] ? 2 : first;
}

/// The vertex of that corner. Reads `origin`.
template <Topology Mesh>
[[nodiscard]] VertexId nearest_vertex(const Mesh& mesh, const SurfacePoint& point) noexcept {
  return mesh.origin[point.corners[nearest_corner(point)]];
}

/// The edge of the face nearest to the point, by weight: the half-edge along which the corner off
/// it weighs least; of equal ones the first. Diagonals inside the face do not count; of a triangle
/// without any edge of its face, the half-edge that leaves the first corner.
template <Topology Mesh>
[[nodiscard]] HalfedgeId nearest_halfedge(const Mesh& mesh, const SurfacePoint& point) noexcept {
  HalfedgeId nearest = point.corners[0];
  float least = 2;
  for (std::size_t k = 0; k < 3; ++k) {
    const float off = point.weights[(k + 2) % 3];
    if (off < least && mesh.next(point.corners[k]) == point.corners[(k + 1) % 3]) {
      nearest = point.corners[k];
      least = off;
    }
  }
  return nearest;
}

/// The face of the point. Reads a stored `face`.
template <Topology Mesh>
[[nodiscard]] FaceId face_of(const Mesh& mesh, const SurfacePoint& point) noexcept {
  return mesh.face(point.corners[0]);
}

/// The weighted mean of three floats a vertex: positions, normals, colours.
template <Topology Mesh>
[[nodiscard]] Vec3 interpolate(const Mesh& mesh, const SurfacePoint& point,
                               Positions values) noexcept {
  const float* a = values[mesh.origin[point.corners[0]].value];
  const float* b = values[mesh.origin[point.corners[1]].value];
  const float* c = values[mesh.origin[point.corners[2]].value];
  const Vec3& w = point.weights;
  return {a[0] * w[0] + b[0] * w[1] + c[0] * w[2], a[1] * w[0] + b[1] * w[1] + c[1] * w[2],
          a[2] * w[0] + b[2] * w[1] + c[2] * w[2]};
}

/// The vertex normals' weighted mean, of length 1; (0, 0, 0) where they cancel.
template <Topology Mesh>
[[nodiscard]] Vec3 interpolate_normal(const Mesh& mesh, const SurfacePoint& point,
                                      Positions normals) noexcept {
  const Vec3 sum = interpolate(mesh, point, normals);
  const float squared = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
  if (!(squared > 0)) return {};
  const float scale = 1 / std::sqrt(squared);
  return {sum[0] * scale, sum[1] * scale, sum[2] * scale};
}

}  // namespace hedgerow::ray
