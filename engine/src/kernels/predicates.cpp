#include "kernels/predicates.h"

#include <cmath>
#include <limits>

#include "kernels/expansion.h"

namespace hedgerow::kernels {
namespace {

// Half a unit in the last place of one; the bounds are those of the paper, sections 4.3 and 4.4.
constexpr double kEpsilon = std::numeric_limits<double>::epsilon() / 2;
constexpr double kOrientBound = (3 + 16 * kEpsilon) * kEpsilon;
constexpr double kCircleBound = (10 + 96 * kEpsilon) * kEpsilon;

int sign_of(double value) noexcept { return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0); }

// From the coordinates themselves, for differences of them may round.
Expansion<4> exact_cross(const Point2& a, const Point2& b) noexcept {
  return expand(exact_product(a[0], b[1])) + expand(exact_product(-a[1], b[0]));
}

Expansion<12> exact_area(const Point2& a, const Point2& b, const Point2& c) noexcept {
  return exact_cross(a, b) + exact_cross(b, c) + exact_cross(c, a);
}

// |p|^2 times the area of the other three, with a sign.
Expansion<96> exact_lift(const Expansion<12>& area, const Point2& p, double sign) noexcept {
  return area * p[0] * (sign * p[0]) + area * p[1] * (sign * p[1]);
}

int exact_incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) noexcept {
  const auto ab = exact_lift(exact_area(b, c, d), a, 1) + exact_lift(exact_area(a, c, d), b, -1);
  const auto cd = exact_lift(exact_area(a, b, d), c, 1) + exact_lift(exact_area(a, b, c), d, -1);
  return (ab + cd).sign();
}

}  // namespace

int orient2d(const Point2& a, const Point2& b, const Point2& c) noexcept {
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double area = left - right;
  if (std::abs(area) > kOrientBound * (std::abs(left) + std::abs(right))) return sign_of(area);
  return exact_area(a, b, c).sign();
}

int incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) noexcept {
  const double ax = a[0] - d[0];
  const double ay = a[1] - d[1];
  const double bx = b[0] - d[0];
  const double by = b[1] - d[1];
  const double cx = c[0] - d[0];
  const double cy = c[1] - d[1];
  const double a_lift = ax * ax + ay * ay;
  const double b_lift = bx * bx + by * by;
  const double c_lift = cx * cx + cy * cy;
  const double value =
      a_lift * (bx * cy - cx * by) + b_lift * (cx * ay - ax * cy) + c_lift * (ax * by - bx * ay);
  const double size = a_lift * (std::abs(bx * cy) + std::abs(cx * by)) +
                      b_lift * (std::abs(cx * ay) + std::abs(ax * cy)) +
                      c_lift * (std::abs(ax * by) + std::abs(bx * ay));
  if (std::abs(value) > kCircleBound * size) return sign_of(value);
  return exact_incircle(a, b, c, d);
}

}  // namespace hedgerow::kernels
