// What float cannot hold: area vectors of edges near 1e-20 or 1e15 lie outside its range. Their
// products fit double with room to spare, so no value is scaled before it is known to need it.

#include <bit>
#include <cmath>
#include <cstdint>

#include "kernels/normals_math.h"
#include "kernels/normals_source.h"

namespace hedgerow::kernels {

namespace {

using Double3 = Vec3<double>;

// Between these exponents a float keeps all its digits, with room for a sum of 2^31 of them.
constexpr int kNarrowExponent = 90;

Double3 widen(Float3 a) noexcept {
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

Float3 round(Double3 a) noexcept {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

double largest(Double3 a) noexcept {
  const double x = std::fabs(a.x);
  const double y = std::fabs(a.y);
  const double z = std::fabs(a.z);
  const double xy = x > y ? x : y;
  return xy > z ? xy : z;
}

bool is_finite(Double3 a) noexcept {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// \pre a is positive, finite and normal.
int exponent_of_double(double a) noexcept {
  return static_cast<int>(std::bit_cast<std::uint64_t>(a) >> 52 & 0x7ff) - 1023;
}

// \pre -1022 <= exponent <= 1023
double power_of_two(int exponent) noexcept {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

Wide to_wide(Double3 a) noexcept {
  const double size = largest(a);
  if (!is_finite(a) || !(size >= 0x1p-1000)) return {};
  const int exponent = exponent_of_double(size);
  return {round(a * power_of_two(-exponent)), exponent};
}

Wide to_unit(Double3 a) noexcept {
  const double square = dot(a, a);
  if (!is_finite(a) || !(square > 0)) return {};
  return {round(a * (1 / std::sqrt(square))), 0};
}

bool is_zero(const Wide& value) noexcept {
  return value.v.x == 0 && value.v.y == 0 && value.v.z == 0;
}

// The angle depends on the ratio of its two arguments only.
float wide_angle(Double3 a, Double3 b) noexcept {
  const Double3 c = cross(a, b);
  const double length = std::sqrt(dot(c, c));
  const double d = dot(a, b);
  const double size = length > std::fabs(d) ? length : std::fabs(d);
  if (!(size > 0) || !std::isfinite(size)) return 0;
  return angle_of(static_cast<float>(length / size), static_cast<float>(d / size));
}

Wide max_term(Double3 area, Double3 a, Double3 b) noexcept {
  const double squares = dot(a, a) * dot(b, b);
  if (!(squares > 0)) return {};
  return to_wide(area * (1 / squares));
}

}  // namespace

Wide triangle_vector(Float3 p0, Float3 p1, Float3 p2, bool unit) noexcept {
  const Float3 area = cross(p1 - p0, p2 - p0);
  const float square = dot(area, area);
  if (is_usual(square)) {
    return {unit ? area * (1.0f / square_root(square)) : area, 0};
  }
  const Double3 origin = widen(p0);
  const Double3 wide = cross(widen(p1) - origin, widen(p2) - origin);
  return unit ? to_unit(wide) : to_wide(wide);
}

Wide polygon_vector(const FaceSource& faces, Index f, const Points& points, PolygonMethod method,
                    bool unit) noexcept {
  const Index begin = faces.begin(f);
  const Index degree = faces.begin(f + 1) - begin;
  if (degree < 3) return {};
  const auto point = [&](Index k) { return points[faces.corner(begin + k)]; };
  if (degree == 3) return triangle_vector(point(0), point(1), point(2), unit);
  Double3 sum{0, 0, 0};
  const Double3 first = widen(point(0));
  if (method == PolygonMethod::newell) {
    Double3 before = widen(point(1)) - first;
    for (Index k = 2; k < degree; ++k) {
      const Double3 here = widen(point(k)) - first;
      sum = sum + cross(before, here);
      before = here;
    }
  } else {
    Double3 before = widen(point(degree - 1));
    Double3 here = first;
    for (Index k = 0; k < degree; ++k) {
      const Double3 after = k + 1 < degree ? widen(point(k + 1)) : first;
      sum = sum + cross(after - here, before - here);
      before = here;
      here = after;
    }
    sum = sum * (1.0 / static_cast<double>(degree));
  }
  if (unit) return to_unit(sum);
  const Float3 area = round(sum);
  return is_usual(dot(area, area)) ? Wide{area, 0} : to_wide(sum);
}

template <NormalWeight W>
Wide wide_corner(Float3 p0, Float3 p1, Float3 p2, int k) noexcept {
  if constexpr (W == NormalWeight::area) return triangle_vector(p0, p1, p2, false);
  TriangleTerms<float> terms;
  if (triangle_terms<W>(p0, p1, p2, terms)) {
    return {corner_term<W>(terms, k == 0, k == 2), 0};
  }
  if constexpr (W == NormalWeight::uniform) return triangle_vector(p0, p1, p2, true);
  const Double3 p[3] = {widen(p0), widen(p1), widen(p2)};
  const Double3 after = p[(k + 1) % 3] - p[k];
  const Double3 before = p[(k + 2) % 3] - p[k];
  const Double3 area = cross(p[1] - p[0], p[2] - p[0]);
  if constexpr (W == NormalWeight::max) return max_term(area, after, before);
  const Wide unit = to_unit(area);
  if (is_zero(unit)) return {};
  return {unit.v * wide_angle(after, before), 0};
}

template <NormalWeight W>
Wide wide_corner(const Wide& face, Float3 before, Float3 here, Float3 after) noexcept {
  if constexpr (W == NormalWeight::area || W == NormalWeight::uniform) return face;
  const Float3 a = after - here;
  const Float3 b = before - here;
  const Float3 c = cross(a, b);
  if constexpr (W == NormalWeight::max) {
    const float aa = dot(a, a);
    const float bb = dot(b, b);
    if (is_usual_factor(aa) & is_usual_factor(bb)) return {c * (1.0f / (aa * bb)), 0};
    const Double3 wide_a = widen(after) - widen(here);
    const Double3 wide_b = widen(before) - widen(here);
    return max_term(cross(wide_a, wide_b), wide_a, wide_b);
  }
  if (is_zero(face)) return {};
  const float square = dot(c, c);
  if (is_usual(square) & (dot(a, a) + dot(b, b) <= kLargeSquare)) {
    const float angle = angle_of(square_root(square), dot(a, b));
    return {face.v * (dot(c, face.v) < 0 ? 2 * kPi - angle : angle), 0};
  }
  const Double3 wide_a = widen(after) - widen(here);
  const Double3 wide_b = widen(before) - widen(here);
  const float angle = wide_angle(wide_a, wide_b);
  const bool is_reflex = dot(cross(wide_a, wide_b), widen(face.v)) < 0;
  return {face.v * (is_reflex ? 2 * kPi - angle : angle), 0};
}

template Wide wide_corner<NormalWeight::uniform>(Float3, Float3, Float3, int) noexcept;
template Wide wide_corner<NormalWeight::area>(Float3, Float3, Float3, int) noexcept;
template Wide wide_corner<NormalWeight::angle>(Float3, Float3, Float3, int) noexcept;
template Wide wide_corner<NormalWeight::max>(Float3, Float3, Float3, int) noexcept;
template Wide wide_corner<NormalWeight::uniform>(const Wide&, Float3, Float3, Float3) noexcept;
template Wide wide_corner<NormalWeight::area>(const Wide&, Float3, Float3, Float3) noexcept;
template Wide wide_corner<NormalWeight::angle>(const Wide&, Float3, Float3, Float3) noexcept;
template Wide wide_corner<NormalWeight::max>(const Wide&, Float3, Float3, Float3) noexcept;

Float3 narrow(const Wide& value) noexcept {
  if (value.exponent == 0) return value.v;
  if (value.exponent >= -kNarrowExponent && value.exponent <= kNarrowExponent) {
    return round(widen(value.v) * power_of_two(value.exponent));
  }
  const float unknown = std::bit_cast<float>(std::uint32_t{0x7fc00000});
  return {unknown, unknown, unknown};
}

int exponent_of(const Wide& value) noexcept {
  const Double3 v = widen(value.v);
  const double size = largest(v);
  if (!is_finite(v) || !(size > 0)) return kNoExponent;
  return exponent_of_double(size) + value.exponent;
}

Float3 scaled(const Wide& value, int exponent) noexcept {
  const int shift = value.exponent - exponent;
  if (shift < -1000 || exponent_of(value) == kNoExponent) return {0, 0, 0};
  return round(widen(value.v) * power_of_two(shift));
}

bool normalise_wide(Float3 sum, Float3& unit) noexcept {
  const Wide wide = to_unit(widen(sum));
  unit = wide.v;
  return !is_zero(wide);
}

}  // namespace hedgerow::kernels
