#pragma once

#include <array>

/// Signs of determinants of points in the plane, exact for doubles.
///
/// Pre: each coordinate is zero or of a magnitude from 2^-200 to 2^200, so that no term of degree
/// four overflows and no tail underflows. A bound on the rounding error settles most calls; the
/// rest are computed exactly, on the stack.
namespace hedgerow::kernels {

using Point2 = std::array<double, 2>;

/// 1 if a, b, c turn left, -1 if they turn right, 0 if they lie on a line.
[[nodiscard]] int orient2d(const Point2& a, const Point2& b, const Point2& c) noexcept;

/// 1 if d lies inside the circle through a, b, c, -1 outside, 0 on it, when a, b, c turn left; the
/// other sign when they turn right.
[[nodiscard]] int incircle(const Point2& a, const Point2& b, const Point2& c,
                           const Point2& d) noexcept;

}  // namespace hedgerow::kernels
