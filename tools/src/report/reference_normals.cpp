#include <algorithm>
#include <array>
#include <cmath>

#include "report/reference.h"

namespace hedgerow::tool {
namespace {

using Vector = std::array<double, 3>;

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
void add(Vector& a, const Vector& b) {
  for (std::size_t i = 0; i < 3; ++i) a[i] += b[i];
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A float result may differ from the double one by this much for each unit of the condition
/// number: some tens of roundings, and the error of the angle polynomial.
constexpr double kTolerance = 8e-6;
/// Where the condition number allows more than this, there is nothing to compare.
constexpr double kMeaningless = 0.05;

/// A sum of vectors, and how much its parts could have cancelled.
struct Sum {
  Vector vector{};
  double magnitude = 0;
};

/// True if `normal` is the direction of `sum` as far as float can tell.
bool agrees(const float* normal, const Sum& sum) {
  const double size = length(sum.vector);
  const double allowed = kTolerance * sum.magnitude / size;
  if (!(allowed < kMeaningless)) return true;
  const Vector found = {normal[0], normal[1], normal[2]};
  return length(found - (1 / size) * sum.vector) <= allowed;
}

Vector position(const Soup& soup, Index corner) {
  const float* p = soup.xyz.data() +
                   3 * static_cast<std::size_t>(soup.corners[static_cast<std::size_t>(corner)]);
  return {p[0], p[1], p[2]};
}

/// The area vector of a face; `magnitude` is the size of the products that it is the sum of.
Sum area_vector(const Soup& soup, Index begin, Index end) {
  Sum sum;
  const Vector apex = position(soup, begin);
  for (Index h = begin + 1; h + 1 < end; ++h) {
    const Vector a = position(soup, h) - apex;
    const Vector b = position(soup, h + 1) - apex;
    add(sum.vector, cross(a, b));
    sum.magnitude += length(a) * length(b);
  }
  return sum;
}

/// The angle from a to b round `unit`, and how far off a float may have it. Above pi where the
/// corner is reflex; a corner at right angles to its face may be taken for either.
Sum corner_angle(const Vector& a, const Vector& b, const Vector& unit, double condition) {
  const Vector turn = cross(a, b);
  const double angle = std::atan2(length(turn), dot(a, b));
  const double reflex = 2 * std::acos(-1.0) - angle;
  const double height = dot(turn, unit);
  const double used = height < 0 ? reflex : angle;
  Sum sum{used * unit, (used + 1) * condition};
  const bool is_either = std::abs(height) <= kTolerance * condition * length(a) * length(b);
  if (is_either) sum.magnitude += (reflex - angle) / kTolerance;
  return sum;
}

/// What one corner adds to its vertex: N is the area vector of the face, a and b the edges. A face
/// of no area with edges of some length has no direction, but float may find one: then its
/// magnitude is without bound.
Sum corner_part(const Sum& face, const Vector& a, const Vector& b, NormalWeight weight) {
  const double size = length(face.vector);
  const double condition = face.magnitude / size;
  const Vector unit = (size > 0 ? 1 / size : 0) * face.vector;
  const double lengths = dot(a, a) * dot(b, b);
  if (face.magnitude == 0 && weight != NormalWeight::max) return {};
  switch (weight) {
    case NormalWeight::uniform:
      return {unit, condition};
    case NormalWeight::area:
      return face;
    case NormalWeight::angle:
      return lengths == 0 ? Sum{} : corner_angle(a, b, unit, condition);
    case NormalWeight::max:
      if (lengths == 0) return {};
      // The engine finds a x b of a triangle's corners at one of them: its rounding is in all
      // three.
      return {(1 / lengths) * cross(a, b),
              std::max(face.magnitude / lengths, 1 / std::sqrt(lengths))};
  }
  return {};
}

}  // namespace

bool Reference::accepts_face_normals(const Buffer<float>& normals) const {
  for (Index f = 0; f < face_count(); ++f) {
    const Sum sum = area_vector(soup_, first(f), first(f + 1));
    if (!agrees(normals.data() + 3 * static_cast<std::size_t>(f), sum)) return false;
  }
  return true;
}

bool Reference::accepts_vertex_normals(const Buffer<float>& normals, NormalWeight weight) const {
  std::vector<Sum> sums(static_cast<std::size_t>(soup_.vertex_count()));
  for (Index f = 0; f < face_count(); ++f) {
    const Sum face = area_vector(soup_, first(f), first(f + 1));
    Index before = first(f + 1) - 1;
    for (Index h = first(f); h < first(f + 1); ++h) {
      const Vector here = position(soup_, h);
      const Sum part = corner_part(face, position(soup_, next(f, h)) - here,
                                   position(soup_, before) - here, weight);
      Sum& sum = sums[static_cast<std::size_t>(soup_.corners[static_cast<std::size_t>(h)])];
      add(sum.vector, part.vector);
      sum.magnitude += part.magnitude;
      before = h;
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (!agrees(normals.data() + 3 * v, sums[v])) return false;
  }
  return true;
}

}  // namespace hedgerow::tool
