#pragma once

#include <algorithm>
#include <array>

/// The closest point of a triangle: C. Ericson, "Real-Time Collision Detection", 2005, section
/// 5.1.5, which finds the Voronoi region (corner, edge or inside) by signs of dot products.
namespace hedgerow::ray {

using Point = std::array<double, 3>;

inline Point operator-(const Point& a, const Point& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(const Point& a, const Point& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Weights of the three corners, and which features the point lies on: `corner` 0 to 2 or -1;
/// `edge` k runs from corner k to corner k + 1, or is -1. Both -1: inside.
struct TrianglePoint {
  std::array<double, 3> weights{};
  int corner = -1;
  int edge = -1;
};

namespace detail {

inline TrianglePoint at_corner(int k) noexcept {
  TrianglePoint point;
  point.weights[static_cast<std::size_t>(k)] = 1;
  point.corner = k;
  return point;
}

/// On edge k, the share `s` of the way along it; at an end where the share rounds to one.
inline TrianglePoint on_edge(int k, double s) noexcept {
  if (!(s > 0)) return at_corner(k);
  if (!(s < 1)) return at_corner((k + 1) % 3);
  TrianglePoint point;
  point.weights[static_cast<std::size_t>(k)] = 1 - s;
  point.weights[static_cast<std::size_t>((k + 1) % 3)] = s;
  point.edge = k;
  return point;
}

inline double squared_distance(const std::array<Point, 3>& corners, const TrianglePoint& at,
                               const Point& from) noexcept {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double offset = (corners[0][axis] - from[axis]) * at.weights[0] +
                          (corners[1][axis] - from[axis]) * at.weights[1] +
                          (corners[2][axis] - from[axis]) * at.weights[2];
    sum += offset * offset;
  }
  return sum;
}

/// The closest point of the three edges.
inline TrianglePoint closest_on_edges(const std::array<Point, 3>& corners,
                                      const Point& from) noexcept {
  TrianglePoint best = at_corner(0);
  double best_distance = squared_distance(corners, best, from);
  for (int k = 0; k < 3; ++k) {
    const Point& start = corners[static_cast<std::size_t>(k)];
    const Point along = corners[static_cast<std::size_t>((k + 1) % 3)] - start;
    const double length = dot(along, along);
    const TrianglePoint point = on_edge(k, length > 0 ? dot(along, from - start) / length : 0);
    const double distance = squared_distance(corners, point, from);
    if (distance < best_distance) {
      best = point;
      best_distance = distance;
    }
  }
  return best;
}

/// By regions; exact but for rounding, which decides wrongly where the triangle is a needle.
inline TrianglePoint closest_by_region(const std::array<Point, 3>& corners,
                                       const Point& from) noexcept {
  const auto& [a, b, c] = corners;
  const Point ab = b - a;
  const Point ac = c - a;
  const double a_along_ab = dot(ab, from - a);
  const double a_along_ac = dot(ac, from - a);
  if (a_along_ab <= 0 && a_along_ac <= 0) return at_corner(0);
  const double b_along_ab = dot(ab, from - b);
  const double b_along_ac = dot(ac, from - b);
  if (b_along_ab >= 0 && b_along_ac <= b_along_ab) return at_corner(1);
  const double c_along_ab = dot(ab, from - c);
  const double c_along_ac = dot(ac, from - c);
  if (c_along_ac >= 0 && c_along_ab <= c_along_ac) return at_corner(2);

  const double area_c = a_along_ab * b_along_ac - b_along_ab * a_along_ac;
  if (area_c <= 0 && a_along_ab >= 0 && b_along_ab <= 0) {
    return on_edge(0, a_along_ab / (a_along_ab - b_along_ab));
  }
  const double area_b = c_along_ab * a_along_ac - a_along_ab * c_along_ac;
  if (area_b <= 0 && a_along_ac >= 0 && c_along_ac <= 0) {
    return on_edge(2, 1 - a_along_ac / (a_along_ac - c_along_ac));
  }
  const double area_a = b_along_ab * c_along_ac - c_along_ab * b_along_ac;
  const double b_to_c = b_along_ac - b_along_ab;
  const double c_to_b = c_along_ab - c_along_ac;
  if (area_a <= 0 && b_to_c >= 0 && c_to_b >= 0) return on_edge(1, b_to_c / (b_to_c + c_to_b));

  const double area = area_a + area_b + area_c;
  if (!(area_a > 0 && area_b > 0 && area_c > 0)) return closest_on_edges(corners, from);
  TrianglePoint inside;
  inside.weights = {area_a / area, area_b / area, area_c / area};
  return inside;
}

/// Whether the sine of the angle at the first corner is below 1e-5.
inline bool is_needle(const std::array<Point, 3>& corners) noexcept {
  const Point ab = corners[1] - corners[0];
  const Point ac = corners[2] - corners[0];
  const Point normal = {ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
                        ab[0] * ac[1] - ab[1] * ac[0]};
  return !(dot(normal, normal) > 1e-10 * dot(ab, ab) * dot(ac, ac));
}

}  // namespace detail

[[nodiscard]] inline TrianglePoint closest_on_triangle(const std::array<Point, 3>& corners,
                                                       const Point& from) noexcept {
  const TrianglePoint point = detail::closest_by_region(corners, from);
  if (!detail::is_needle(corners)) return point;
  const TrianglePoint on_edges = detail::closest_on_edges(corners, from);
  const bool is_closer = detail::squared_distance(corners, point, from) <
                         detail::squared_distance(corners, on_edges, from);
  return is_closer ? point : on_edges;
}

}  // namespace hedgerow::ray
