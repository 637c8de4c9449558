#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hedgerow/positions.h"
#include "hedgerow/topology.h"
#include "kernels/wide_integer.h"

/// In which direction a face leaves an edge, compared without any angle: by signs, which are right
/// for every float. Pure functions that read the mesh and the positions.
///
/// The area vector of a face (Newell's sum, about the origin of the half-edge), turned over where
/// the half-edge runs from the larger vertex to the smaller, is the direction of the face at a
/// right angle to the edge, turned by a quarter. So the area vectors stand round the edge as the
/// faces do. The axis points from the larger vertex to the smaller: to a viewer who looks along the
/// edge from the smaller vertex, turning about it is counter-clockwise.
///
/// Signs are first asked of doubles with a bound of their error, as by J. Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", 1997; what they leave
/// open is computed in whole numbers. A coordinate that is not finite counts as a number beyond the
/// largest float, so that the order is an order all the same.
namespace hedgerow::kernels {

/// A half-edge with the area vector of its face, as said above.
struct RadialSide {
  Index halfedge = kInvalidIndex;
  Index run = 0;          ///< the same for the half-edges of one edge
  int sector = 0;         ///< for `order_sides`
  int unit = 0;           ///< all coordinates of the face are multiples of 2^unit
  double term_count = 0;  ///< of the sum
  std::array<double, 3> area{};
  std::array<double, 3> size{};  ///< the same sum of magnitudes: what errors are in proportion to
};

template <class Number>
using Triple = std::array<Number, 3>;

template <class Number>
[[nodiscard]] constexpr Triple<Number> difference(const Triple<Number>& a,
                                                  const Triple<Number>& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Number>
[[nodiscard]] constexpr Triple<Number> cross(const Triple<Number>& a,
                                             const Triple<Number>& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Number>
[[nodiscard]] constexpr Number dot(const Triple<Number>& a, const Triple<Number>& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// `cross` of magnitudes, with no minus: a bound of every term that goes into it.
[[nodiscard]] constexpr Triple<double> cross_size(const Triple<double>& a,
                                                  const Triple<double>& b) noexcept {
  return {a[1] * b[2] + a[2] * b[1], a[2] * b[0] + a[0] * b[2], a[0] * b[1] + a[1] * b[0]};
}
[[nodiscard]] inline Triple<double> magnitudes(const Triple<double>& a) noexcept {
  return {std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])};
}

/// Which point the formulas below take for a vertex: doubles, which hold a float as it is, or whole
/// numbers of 2^unit.
struct DoublePoints {
  Positions positions;
  [[nodiscard]] Triple<double> operator()(VertexId v) const noexcept {
    const float* p = positions[v.value];
    return {p[0], p[1], p[2]};
  }
};

/// That of the largest float, and of what counts as larger: of zeros alone, any would do.
inline constexpr int kLargestUnit = 128;

/// magnitude * 2^exponent, with an odd magnitude.
struct FloatParts {
  std::uint32_t magnitude = 0;
  int exponent = std::numeric_limits<int>::max();  ///< of zero: larger than any other
  bool is_negative = false;
};

[[nodiscard]] inline FloatParts parts_of(float value) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t biased = bits >> 23U & 0xffU;
  const std::uint32_t magnitude = (bits & 0x7fffffU) | (biased != 0 ? 0x800000U : 0U);
  if (magnitude == 0) return {};
  const int zeros = std::countr_zero(magnitude);
  return {magnitude >> zeros, static_cast<int>(biased != 0 ? biased : 1) - 150 + zeros,
          bits >> 31U != 0};
}

struct WholePoints {
  Positions positions;
  int unit = 0;
  [[nodiscard]] Triple<WideInteger> operator()(VertexId v) const noexcept {
    const float* p = positions[v.value];
    return {whole(p[0]), whole(p[1]), whole(p[2])};
  }

 private:
  [[nodiscard]] WideInteger whole(float value) const noexcept {
    const FloatParts parts = parts_of(value);
    if (parts.magnitude == 0) return {};
    return {parts.magnitude, static_cast<std::size_t>(parts.exponent - unit), parts.is_negative};
  }
};

/// Calls visit(p - a, q - a) for each side from p to q of the face of `h` that does not meet a, the
/// origin of `h`.
template <Topology Mesh, class Points, class Visit>
void for_each_wedge(const Mesh& mesh, const Points& points, HalfedgeId h,
                    const Visit& visit) noexcept {
  const auto a = points(mesh.origin[h]);
  HalfedgeId side = mesh.next(h);
  auto from = difference(points(mesh.origin[side]), a);
  for (HalfedgeId after = mesh.next(side); after != h; after = mesh.next(after)) {
    const auto to = difference(points(mesh.origin[after]), a);
    visit(from, to);
    from = to;
  }
}

template <Topology Mesh>
[[nodiscard]] bool runs_up(const Mesh& mesh, HalfedgeId h) noexcept {
  return mesh.origin[h] < mesh.target(h);
}

/// From the larger vertex of the edge of `h` to the smaller.
template <Topology Mesh, class Points>
[[nodiscard]] auto edge_axis(const Mesh& mesh, const Points& points, HalfedgeId h) noexcept {
  const auto from = points(mesh.origin[h]);
  const auto to = points(mesh.target(h));
  return runs_up(mesh, h) ? difference(from, to) : difference(to, from);
}

/// The largest power of two that all coordinates of the face of `h` are multiples of.
template <Topology Mesh>
[[nodiscard]] int lowest_exponent(const Mesh& mesh, Positions positions, HalfedgeId h) noexcept {
  int lowest = std::numeric_limits<int>::max();
  HalfedgeId side = h;
  do {
    const float* p = positions[mesh.origin[side].value];
    for (int k = 0; k < 3; ++k) lowest = std::min(lowest, parts_of(p[k]).exponent);
    side = mesh.next(side);
  } while (side != h);
  return lowest;
}

/// All of a side but its sector. O(degree).
template <Topology Mesh>
[[nodiscard]] RadialSide radial_side(const Mesh& mesh, Positions positions, HalfedgeId h,
                                     Index run) noexcept {
  RadialSide side;
  side.halfedge = h.value;
  side.run = run;
  side.unit = std::min(lowest_exponent(mesh, positions, h), kLargestUnit);
  const double way = runs_up(mesh, h) ? 1 : -1;
  for_each_wedge(mesh, DoublePoints{positions}, h, [&](const auto& p, const auto& q) {
    const Triple<double> area = cross(p, q);
    const Triple<double> size = cross_size(magnitudes(p), magnitudes(q));
    for (std::size_t k = 0; k < 3; ++k) {
      side.area[k] += way * area[k];
      side.size[k] += size[k];
    }
    ++side.term_count;
  });
  return side;
}

/// The signs of formulas over one or two sides of one edge.
template <Topology Mesh>
class RadialSigns {
 public:
  RadialSigns(const Mesh& mesh, Positions positions, HalfedgeId h) noexcept
      : mesh_(mesh),
        positions_(positions),
        axis_(edge_axis(mesh, DoublePoints{positions}, h)),
        axis_size_(magnitudes(axis_)) {}

  /// Which way the shorter turn from `a` to `b` goes: 1 counter-clockwise, -1 clockwise; 0 if they
  /// have the same or the opposite direction.
  [[nodiscard]] int turn(const RadialSide& a, const RadialSide& b) const noexcept {
    const double value = dot(axis_, cross(a.area, b.area));
    const double size = dot(axis_size_, cross_size(a.size, b.size));
    const int sign = sign_of(value, size, a.term_count + b.term_count);
    if (sign != 0 || is_whole(size, 5 * std::min(a.unit, b.unit))) return sign;
    const WholePoints points = whole_points(a, b);
    const auto axis = edge_axis(mesh_, points, HalfedgeId(a.halfedge));
    return dot(axis, cross(whole_area(points, a), whole_area(points, b))).sign();
  }

  /// 1 if `a` and `b` are less than a quarter turn apart, -1 if more. 0 at a quarter.
  [[nodiscard]] int nearness(const RadialSide& a, const RadialSide& b) const noexcept {
    const double value = dot(cross(axis_, a.area), cross(axis_, b.area));
    const double size = dot(cross_size(axis_size_, a.size), cross_size(axis_size_, b.size));
    const int sign = sign_of(value, size, a.term_count + b.term_count);
    if (sign != 0 || is_whole(size, 6 * std::min(a.unit, b.unit))) return sign;
    const WholePoints points = whole_points(a, b);
    const auto axis = edge_axis(mesh_, points, HalfedgeId(a.halfedge));
    return dot(cross(axis, whole_area(points, a)), cross(axis, whole_area(points, b))).sign();
  }

  /// False if the face or the edge has no extent, so that there is no angle between them.
  [[nodiscard]] bool has_direction(const RadialSide& a) const noexcept {
    return nearness(a, a) != 0;
  }

 private:
  // A term is a product of at most six differences and sums, each rounded once for each of its
  // operations: 2^-53 for each, at most 2 (terms + 16) of them, and once more for the products of
  // errors. 0: not known.
  [[nodiscard]] static int sign_of(double value, double size, double term_count) noexcept {
    constexpr double kRounding = 0x1p-53;
    const double bound = 4 * (term_count + 16) * kRounding * size;
    return value > bound ? 1 : value < -bound ? -1 : 0;
  }

  // True if no step on the way to a sum of this size has rounded, because all of them are whole
  // numbers of 2^unit below 2^53: small integers, and grids. Then a 0 is a 0, too.
  [[nodiscard]] static bool is_whole(double size, int unit) noexcept {
    return size < std::ldexp(0x1p51, unit);
  }

  // In units as large as the coordinates allow: small integers stay small.
  [[nodiscard]] WholePoints whole_points(const RadialSide& a, const RadialSide& b) const noexcept {
    return {positions_, std::min(a.unit, b.unit)};
  }
  [[nodiscard]] Triple<WideInteger> whole_area(const WholePoints& points,
                                               const RadialSide& side) const noexcept {
    const HalfedgeId h(side.halfedge);
    const bool is_up = runs_up(mesh_, h);
    Triple<WideInteger> sum;
    for_each_wedge(mesh_, points, h, [&](const auto& p, const auto& q) {
      const auto area = is_up ? cross(p, q) : cross(q, p);
      for (std::size_t k = 0; k < 3; ++k) sum[k] = sum[k] + area[k];
    });
    return sum;
  }

  const Mesh& mesh_;
  Positions positions_;
  Triple<double> axis_;
  Triple<double> axis_size_;
};

}  // namespace hedgerow::kernels
