#include "kernels/predicates.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>

#include "kernels/expansion.h"

namespace hedgerow::kernels {
namespace {

// The products are subtracted without rounding.
Expansion<4> exact_cross(double ax, double ay, double bx, double by) noexcept {
  return expand(exact_product(ax, by)) + expand(exact_product(-ay, bx));
}

// From the coordinates themselves, for where differences of them round.
Expansion<12> exact_area(const Point2& a, const Point2& b, const Point2& c) noexcept {
  return exact_cross(a[0], a[1], b[0], b[1]) + exact_cross(b[0], b[1], c[0], c[1]) +
         exact_cross(c[0], c[1], a[0], a[1]);
}

// x^2 + y^2 times the area of the other points.
template <std::size_t N>
Expansion<8 * N> exact_lift(const Expansion<N>& area, double x, double y, double sign) noexcept {
  return area * x * (sign * x) + area * y * (sign * y);
}

bool is_exact_difference(const Point2& a, const Point2& b) noexcept {
  return exact_sum(a[0], -b[0]).tail == 0 && exact_sum(a[1], -b[1]).tail == 0;
}

// The largest power of two that all values are multiples of; infinite if they are all zero.
double common_unit(std::initializer_list<double> values) noexcept {
  double unit = std::numeric_limits<double>::infinity();
  for (const double value : values) {
    if (value == 0) continue;
    int exponent = 0;
    const double mantissa = std::frexp(std::abs(value), &exponent);
    const auto bits = static_cast<std::uint64_t>(std::ldexp(mantissa, 53));
    unit = std::min(unit, std::ldexp(1.0, exponent - 53 + std::countr_zero(bits)));
  }
  return unit;
}

int sign_of(double value) noexcept { return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0); }

}  // namespace

namespace detail {

int exact_orient2d(const Point2& a, const Point2& b, const Point2& c) noexcept {
  if (!is_exact_difference(a, c) || !is_exact_difference(b, c)) return exact_area(a, b, c).sign();
  return exact_cross(a[0] - c[0], a[1] - c[1], b[0] - c[0], b[1] - c[1]).sign();
}

int exact_incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d, double value,
                   double size) noexcept {
  if (!is_exact_difference(a, d) || !is_exact_difference(b, d) || !is_exact_difference(c, d)) {
    const auto ab = exact_lift(exact_area(b, c, d), a[0], a[1], 1) +
                    exact_lift(exact_area(a, c, d), b[0], b[1], -1);
    const auto cd = exact_lift(exact_area(a, b, d), c[0], c[1], 1) +
                    exact_lift(exact_area(a, b, c), d[0], d[1], -1);
    return (ab + cd).sign();
  }
  const double ax = a[0] - d[0];
  const double ay = a[1] - d[1];
  const double bx = b[0] - d[0];
  const double by = b[1] - d[1];
  const double cx = c[0] - d[0];
  const double cy = c[1] - d[1];
  // Whole numbers of so few units that no step has rounded: what grids ask for.
  const double unit = common_unit({ax, ay, bx, by, cx, cy});
  if (size <= 0x1p52 * unit * unit * unit * unit) return sign_of(value);
  return (exact_lift(exact_cross(bx, by, cx, cy), ax, ay, 1) +
          exact_lift(exact_cross(cx, cy, ax, ay), bx, by, 1) +
          exact_lift(exact_cross(ax, ay, bx, by), cx, cy, 1))
      .sign();
}

}  // namespace detail

}  // namespace hedgerow::kernels
