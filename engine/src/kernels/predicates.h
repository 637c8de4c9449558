#pragma once

#include <cfloat>
#include <cmath>
#include <limits>

#include "hedgerow/point2.h"

/// Signs of determinants of points in the plane, exact for doubles.
///
/// Pre: each coordinate is zero or of a magnitude from 2^-200 to 2^200, so that no term of degree
/// four overflows and no tail underflows. A bound on the rounding error, inline, settles most
/// calls; the rest are computed exactly, on the stack.
namespace hedgerow::kernels {

// Sums that are rounded twice, as on the 387, are not those of the bounds.
static_assert(FLT_EVAL_METHOD == 0 && std::numeric_limits<double>::digits == 53);

namespace detail {
// Half a unit in the last place of one; the bounds are those of the paper that expansion.h names,
// sections 4.3 and 4.4. A fused multiply-add only makes the error smaller.
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon() / 2;
inline constexpr double kOrientBound = (3 + 16 * kEpsilon) * kEpsilon;
inline constexpr double kCircleBound = (10 + 96 * kEpsilon) * kEpsilon;

[[nodiscard]] int exact_orient2d(const Point2& a, const Point2& b, const Point2& c) noexcept;
/// `value` and `size` as `incircle` computes them.
[[nodiscard]] int exact_incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d,
                                 double value, double size) noexcept;
}  // namespace detail

/// 1 if a, b, c turn left, -1 if they turn right, 0 if they lie on a line.
[[nodiscard]] inline int orient2d(const Point2& a, const Point2& b, const Point2& c) noexcept {
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double area = left - right;
  const double bound = detail::kOrientBound * (std::abs(left) + std::abs(right));
  if (area > bound) return 1;
  if (-area > bound) return -1;
  return detail::exact_orient2d(a, b, c);
}

/// 1 if d lies inside the circle through a, b, c, -1 outside, 0 on it, when a, b, c turn left; the
/// other sign when they turn right.
[[nodiscard]] inline int incircle(const Point2& a, const Point2& b, const Point2& c,
                                  const Point2& d) noexcept {
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
  const double bound = detail::kCircleBound * size;
  if (value > bound) return 1;
  if (-value > bound) return -1;
  return detail::exact_incircle(a, b, c, d, value, size);
}

}  // namespace hedgerow::kernels
