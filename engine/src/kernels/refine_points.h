#pragma once

#include <array>
#include <limits>

#include "hedgerow/positions.h"
#include "hedgerow/topology.h"
#include "kernels/refine.h"

/// Where subdivision puts vertices. Each function computes one point from its neighbours, which it
/// only reads: in double, in the order of rotation.
namespace hedgerow::kernels {

struct Point {
  double x = 0;
  double y = 0;
  double z = 0;

  friend Point operator+(Point a, Point b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point operator*(double s, Point a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
};

[[nodiscard]] inline Point point_at(const Positions& positions, VertexId v) noexcept {
  const float* p = positions[v.value];
  return {p[0], p[1], p[2]};
}
inline void store(Point p, float* out) noexcept {
  out[0] = static_cast<float>(p.x);
  out[1] = static_cast<float>(p.y);
  out[2] = static_cast<float>(p.z);
}

/// cos(2 pi / n), n >= 2, by its series: the same bits with every C library.
[[nodiscard]] constexpr double cosine_of_share(double n) noexcept {
  const double x = 6.283185307179586476925 / n;
  double term = 1;
  double sum = 1;
  for (int i = 1; i <= 15; ++i) {
    term *= -x * x / ((2.0 * i - 1) * (2.0 * i));
    sum += term;
  }
  return sum;
}
inline constexpr int kTabledValences = 32;
inline constexpr std::array<double, kTabledValences> kCosines = [] {
  std::array<double, kTabledValences> cosines{};
  for (int n = 2; n < kTabledValences; ++n) {
    cosines[static_cast<std::size_t>(n)] = cosine_of_share(n);
  }
  return cosines;
}();
[[nodiscard]] inline double cosine_of_valence(Index n) noexcept {
  return n < kTabledValences ? kCosines[static_cast<std::size_t>(n)]
                             : cosine_of_share(static_cast<double>(n));
}

/// Sharpness of edges; infinite on the boundary.
template <Topology Mesh>
struct Sharpness {
  const Mesh& mesh;
  const float* of_halfedge;  ///< null: no creases

  [[nodiscard]] double operator()(HalfedgeId h) const noexcept {
    const HalfedgeId across = mesh.opposite[h];
    if (!across.valid()) return std::numeric_limits<double>::infinity();
    if (of_halfedge == nullptr) return 0;
    const float a = of_halfedge[h.value];
    const float b = of_halfedge[across.value];
    const float larger = a > b || !(b > 0) ? a : b;
    return larger > 0 ? static_cast<double>(larger) : 0;
  }
};

[[nodiscard]] inline Point blend(Point smooth, Point sharp, double sharpness) noexcept {
  return (1 - sharpness) * smooth + sharpness * sharp;
}

template <Topology Mesh>
[[nodiscard]] Point face_centre(const Mesh& mesh, const Positions& positions, FaceId f) noexcept {
  const HalfedgeId first = mesh.first(f);
  const Index degree = mesh.degree(f);
  Point sum;
  for (Index k = 0; k < degree; ++k) {
    sum = sum + point_at(positions, mesh.origin[HalfedgeId(first.value + k)]);
  }
  return (1.0 / static_cast<double>(degree)) * sum;
}

/// The point of the edge of h: `smooth(h)`, its middle, or between. \pre smooth needs an opposite
template <Topology Mesh, class Smooth>
[[nodiscard]] Point edge_point(const Mesh& mesh, const Positions& positions,
                               const Sharpness<Mesh>& sharpness, HalfedgeId h,
                               const Smooth& smooth) noexcept {
  const double sharp = sharpness(h);
  if (!(sharp > 0)) return smooth(h);
  const Point middle =
      0.5 * (point_at(positions, mesh.origin[h]) + point_at(positions, mesh.target(h)));
  return sharp >= 1 ? middle : blend(smooth(h), middle, sharp);
}

/// The new place of an old vertex by the rules of smooth, crease and corner vertices;
/// `crease(v, a + b)` is the rule for two sharp edges to neighbours a and b, and
/// `smooth(v)` that for none.
template <Topology Mesh, class Smooth, class Crease>
[[nodiscard]] Point vertex_point(const Mesh& mesh, const Positions& positions,
                                 const Sharpness<Mesh>& sharpness, VertexId v, const Smooth& smooth,
                                 const Crease& crease) noexcept {
  const Point old = point_at(positions, v);
  const HalfedgeId start = mesh.outgoing[v];
  if (!start.valid() || !extra_fans(mesh.fans, v).empty()) return old;
  if (sharpness.of_halfedge == nullptr && mesh.opposite[mesh.prev(start)].valid()) {
    return smooth(v);
  }
  int sharp_count = 0;
  double total = 0;
  Point sum;
  const auto add = [&](HalfedgeId edge, VertexId neighbour) {
    const double s = sharpness(edge);
    if (!(s > 0)) return;
    ++sharp_count;
    total += s;
    sum = sum + point_at(positions, neighbour);
  };
  if (!mesh.opposite[mesh.prev(start)].valid()) {
    add(mesh.prev(start), mesh.origin[mesh.prev(start)]);
  }
  HalfedgeId h = start;
  do {
    add(h, mesh.target(h));
    const HalfedgeId across = mesh.opposite[h];
    if (!across.valid()) break;
    h = mesh.next(across);
  } while (h != start);
  if (sharp_count < 2) return smooth(v);
  const Point sharp = sharp_count == 2 ? crease(old, sum) : old;
  const double mean = total / sharp_count;
  return mean >= 1 ? sharp : blend(smooth(v), sharp, mean);
}

/// A vertex on a B-spline curve between neighbours whose sum is `sum`.
[[nodiscard]] inline Point spline_point(Point old, Point sum) noexcept {
  return 0.125 * (6.0 * old + sum);
}

struct RingSum {
  Point neighbours;
  Point faces;  ///< of their centres, if asked for
  Index valence = 0;
};
/// \pre v is inside the mesh, in one fan.
template <Topology Mesh>
[[nodiscard]] RingSum ring_sum(const Mesh& mesh, const Positions& positions, VertexId v,
                               const Positions* centres = nullptr) noexcept {
  RingSum ring;
  const HalfedgeId start = mesh.outgoing[v];
  HalfedgeId h = start;
  do {
    // The neighbour is where the walk goes on from.
    const HalfedgeId across = mesh.opposite[h];
    ring.neighbours = ring.neighbours + point_at(positions, mesh.origin[across]);
    if (centres != nullptr) {
      ring.faces = ring.faces + point_at(*centres, VertexId(mesh.face(h).value));
    }
    ++ring.valence;
    h = mesh.next(across);
  } while (h != start);
  return ring;
}

/// Catmull and Clark's rule inside; `centres` are the new points of the faces.
template <Topology Mesh>
[[nodiscard]] Point quad_smooth(const Mesh& mesh, const Positions& positions,
                                const Positions& centres, VertexId v) noexcept {
  const RingSum ring = ring_sum(mesh, positions, v, &centres);
  const auto n = static_cast<double>(ring.valence);
  // Of the middles, half is the vertex itself: Q / n + 2 R / n + (n - 3) S / n.
  const Point old = point_at(positions, v);
  return (1 / (n * n)) * (ring.faces + ring.neighbours) + ((n - 2) / n) * old;
}

[[nodiscard]] inline Point loop_smooth(const TriangleView& mesh, const Positions& positions,
                                       VertexId v) noexcept {
  const RingSum ring = ring_sum(mesh, positions, v);
  const auto n = static_cast<double>(ring.valence);
  const double inner = 0.375 + 0.25 * cosine_of_valence(ring.valence);
  const double share = (0.625 - inner * inner) / n;
  return (1 - n * share) * point_at(positions, v) + share * ring.neighbours;
}

[[nodiscard]] inline Point sqrt3_smooth(const TriangleView& mesh, const Positions& positions,
                                        VertexId v) noexcept {
  const RingSum ring = ring_sum(mesh, positions, v);
  const double share = (4 - 2 * cosine_of_valence(ring.valence)) / 9;
  return (1 - share) * point_at(positions, v) +
         (share / static_cast<double>(ring.valence)) * ring.neighbours;
}

/// The boundary half-edge that ends where the boundary half-edge h begins, round the same fan.
[[nodiscard]] inline HalfedgeId boundary_before(const TriangleView& mesh, HalfedgeId h) noexcept {
  HalfedgeId side = mesh.prev(h);
  while (mesh.opposite[side].valid()) side = mesh.prev(mesh.opposite[side]);
  return side;
}
[[nodiscard]] inline HalfedgeId boundary_after(const TriangleView& mesh, HalfedgeId h) noexcept {
  HalfedgeId side = mesh.next(h);
  while (mesh.opposite[side].valid()) side = mesh.next(mesh.opposite[side]);
  return side;
}

}  // namespace hedgerow::kernels
