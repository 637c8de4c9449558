#include "report/reference_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hedgerow::tool {
namespace {

using Vector = std::array<double, 3>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEdge = 1e-3;       // weights this near to 0 are met at an edge
constexpr double kTolerance = 2e-4;  // of t
constexpr std::int64_t kTriangleTests = 200'000'000;
constexpr std::int64_t kMostRays = 10'000;

Vector minus(const double* a, const double* b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector wide(const ray::Vec3& a) { return {a[0], a[1], a[2]}; }

}  // namespace

ReferenceRays::ReferenceRays(const Soup& soup, const Buffer<float>& xyz) {
  const FaceList faces = soup.face_list();
  const auto add = [&](Index a, Index b, Index c) {
    for (const Index v : {a, b, c}) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        corners_.push_back(xyz[3 * static_cast<std::size_t>(v) + axis]);
      }
    }
  };
  for (Index f = 0; f < soup.face_count(); ++f) {
    const IndexRange range = faces.corner_range(f);
    const Index* v = soup.corners.data() + range.begin;
    if (range.size() == 3) {
      add(v[0], v[1], v[2]);
    } else if (range.size() == 4) {
      add(v[0], v[1], v[3]);
      add(v[2], v[3], v[1]);
    } else {
      knows_all_faces_ = false;
    }
  }
}

std::int64_t ReferenceRays::affordable_rays() const noexcept {
  const auto triangles = std::max<std::int64_t>(1, std::ssize(corners_) / 9);
  return std::clamp<std::int64_t>(kTriangleTests / triangles, 16, kMostRays);
}

ReferenceRays::Answer ReferenceRays::nearest(const ray::Ray& ray) const {
  const Vector origin = wide(ray.origin);
  const Vector way = wide(ray.direction);
  Answer answer{kInfinity, kInfinity};
  for (std::size_t i = 0; i < corners_.size(); i += 9) {
    const double* a = corners_.data() + i;
    const Vector ab = minus(a + 3, a);
    const Vector ac = minus(a + 6, a);
    const Vector normal = cross(ab, ac);
    const double determinant = -dot(way, normal);
    if (determinant == 0) continue;
    const Vector offset = minus(origin.data(), a);
    const double t = dot(offset, normal) / determinant;
    if (!(t >= ray.near && t <= ray.far) || t > answer.first) continue;
    const Vector turned = cross(offset, way);
    const double u = dot(ac, turned) / determinant;
    const double v = -dot(ab, turned) / determinant;
    const double least = std::min({u, v, 1 - u - v});
    if (least > kEdge) answer.first = t;
    if (least > -kEdge) answer.first_perhaps = std::min(answer.first_perhaps, t);
  }
  return answer;
}

bool ReferenceRays::accepts(const ray::Ray& ray, const ray::Hit& hit) const {
  const Answer answer = nearest(ray);
  if (!hit.valid()) return answer.first == kInfinity;
  const double slack = kTolerance * (1 + std::abs(hit.t));
  return hit.t >= answer.first_perhaps - slack && hit.t <= answer.first + slack &&
         answer.first_perhaps < kInfinity;
}

bool ReferenceRays::accepts(const ray::Ray& ray, bool is_occluded) const {
  const Answer answer = nearest(ray);
  // What lies at either end may be on this side or on the other.
  const auto is_inside = [&](double t) { return t > ray.near && t < ray.far * (1 - kTolerance); };
  return is_occluded ? answer.first_perhaps < kInfinity : !is_inside(answer.first);
}

}  // namespace hedgerow::tool
