#include "kernels/flip_tests.h"

#include <array>
#include <cmath>

#include "kernels/predicates.h"

namespace hedgerow::kernels {
namespace {

using Displacement = std::array<double, 3>;

Displacement difference(const float* a, const float* b) noexcept {
  return {double{a[0]} - b[0], double{a[1]} - b[1], double{a[2]} - b[2]};
}
double dot(const Displacement& a, const Displacement& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length_of_cross(const Displacement& a, const Displacement& b) noexcept {
  const Displacement cross = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                              a[0] * b[1] - a[1] * b[0]};
  return std::sqrt(dot(cross, cross));
}

// The angle at `apex` times the lengths of its sides, whose product is `size`.
struct Angle {
  double cosine;
  double sine;
  double size;
};
Angle angle_at(const float* apex, const float* a, const float* b) noexcept {
  const Displacement to_a = difference(a, apex);
  const Displacement to_b = difference(b, apex);
  return {dot(to_a, to_b), length_of_cross(to_a, to_b),
          std::sqrt(dot(to_a, to_a) * dot(to_b, to_b))};
}

bool is_finite_in_plane(const float* p) noexcept {
  return std::isfinite(p[0]) && std::isfinite(p[1]);
}
Point2 flat(const float* p) noexcept { return {p[0], p[1]}; }

}  // namespace

EdgeState test_angle_sum(const float* a, const float* b, const float* c, const float* d) noexcept {
  constexpr double kTolerance = 1e-12;  // radians
  const Angle left = angle_at(d, a, b);
  const Angle right = angle_at(c, b, a);
  const double sine_of_sum = left.sine * right.cosine + left.cosine * right.sine;
  const double bound = -kTolerance * (left.size * right.size);
  // Two obtuse angles first: of two flat triangles the sum is 360 degrees.
  if (left.cosine < 0 && right.cosine < 0) return EdgeState::illegal;
  if (sine_of_sum < bound) return EdgeState::illegal;
  return sine_of_sum >= bound ? EdgeState::legal : EdgeState::undefined;
}

EdgeState test_in_circle(const float* a, const float* b, const float* c, const float* d) noexcept {
  if (!is_finite_in_plane(a) || !is_finite_in_plane(b) || !is_finite_in_plane(c) ||
      !is_finite_in_plane(d)) {
    return EdgeState::undefined;
  }
  const Point2 p = flat(a);
  const Point2 q = flat(b);
  const Point2 right = flat(c);
  const Point2 left = flat(d);
  const int turn = orient2d(p, q, left);
  const int side = turn != 0 ? turn : orient2d(q, p, right);
  if (turn != 0 && incircle(p, q, left, right) * turn <= 0) return EdgeState::legal;
  const bool stays =
      side != 0 && orient2d(right, left, p) == side && orient2d(left, right, q) == side;
  return stays ? EdgeState::illegal : EdgeState::legal;
}

}  // namespace hedgerow::kernels
