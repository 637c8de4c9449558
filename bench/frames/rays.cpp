#include "frames/rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace hedgerow::bench {
namespace {

using ray::Vec3;

constexpr float kSlope = 0.42F;  // half the width of the picture at distance 1: the mesh fills it

Vec3 plus(const Vec3& a, const Vec3& b, float s) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
float dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec3 unit(const Vec3& a) {
  const float length = std::sqrt(dot(a, a));
  if (!(length > 0)) return {0, 0, 1};
  return {a[0] / length, a[1] / length, a[2] / length};
}
float fraction(std::mt19937_64& random) {
  return static_cast<float>(random() >> 40U) / 16777216.0F;
}
Vec3 vertex(const Subject& subject, HalfedgeId h) {
  const Index v = subject.mesh.origin()[static_cast<std::size_t>(h.value)];
  const float* xyz = subject.soup.positions()[v];
  return {xyz[0], xyz[1], xyz[2]};
}

}  // namespace

Packets primary_rays(const Subject& subject, std::int64_t count) {
  const auto tiles = std::max(1.0, std::sqrt(static_cast<double>(count) / (64.0 * 16 * 9)));
  const int columns = 8 * static_cast<int>(16 * tiles);
  const int rows = 8 * static_cast<int>(9 * tiles);
  const Vec3 back = unit({0.3F, 0.35F, 0.9F});
  const Vec3 right = unit(cross({0, 1, 0}, back));
  const Vec3 up = cross(back, right);
  const Vec3 eye = plus(subject.centre, back, 1.3F * subject.diagonal);
  Packets packets;
  for (int top = 0; top < rows; top += 8) {
    for (int left = 0; left < columns; left += 8) {
      for (int y = top; y < top + 8; ++y) {
        ray::RayPacket& packet = packets.emplace_back();
        for (int i = 0; i < 8; ++i) {
          const float across = (static_cast<float>(left + i) + 0.5F) / static_cast<float>(columns);
          const float down = (static_cast<float>(y) + 0.5F) / static_cast<float>(rows);
          const Vec3 way = plus(plus(plus({}, back, -1), right, kSlope * (2 * across - 1)), up,
                                kSlope * 9 / 16 * (1 - 2 * down));
          packet.set(static_cast<std::size_t>(i), {eye, unit(way)});
        }
      }
    }
  }
  return packets;
}

Packets scattered_rays(const Subject& subject, const ray::Scene& scene, const Packets& packets,
                       const std::vector<ray::HitPacket>& hits, int per_hit, float reach) {
  std::mt19937_64 random(7);
  Packets out;
  std::size_t lane = 8;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    for (std::size_t k = 0; k < 8; ++k) {
      if (!hits[i][k].valid()) continue;
      const ray::Ray from = ray_of(packets[i], k);
      const auto at = scene.primitives().point(hits[i][k]).corners;
      const Vec3 a = vertex(subject, at[0]);
      Vec3 normal =
          unit(cross(plus(vertex(subject, at[1]), a, -1), plus(vertex(subject, at[2]), a, -1)));
      if (dot(normal, from.direction) > 0) normal = plus({}, normal, -1);
      const Vec3 helper = std::abs(normal[0]) < 0.6F ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
      const Vec3 tangent = unit(cross(normal, helper));
      const Vec3 other = cross(normal, tangent);
      const Vec3 start =
          plus(plus(from.origin, from.direction, hits[i][k].t), normal, 1e-4F * subject.diagonal);
      for (int j = 0; j < per_hit; ++j) {
        const float squared = fraction(random);
        const float angle = 6.2831853F * fraction(random);
        const Vec3 way = plus(plus(plus({}, tangent, std::sqrt(squared) * std::cos(angle)), other,
                                   std::sqrt(squared) * std::sin(angle)),
                              normal, std::sqrt(1 - squared));
        if (lane == 8) {
          out.emplace_back();
          lane = 0;
        }
        out.back().set(lane++, {start, way, 0, reach * subject.diagonal});
      }
    }
  }
  if (lane < 8) out.back().count = static_cast<int>(lane);
  return out;
}

std::vector<Vec3> random_points(const Subject& subject, std::int64_t count) {
  std::mt19937_64 random(11);
  std::vector<Vec3> points;
  for (std::int64_t i = 0; i < count; ++i) {
    Vec3 point = subject.centre;
    for (float& coordinate : point) coordinate += subject.diagonal * (fraction(random) - 0.5F);
    points.push_back(point);
  }
  return points;
}

ray::Ray ray_of(const ray::RayPacket& packet, std::size_t lane) {
  ray::Ray ray;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ray.origin[axis] = packet.origin[axis][lane];
    ray.direction[axis] = packet.direction[axis][lane];
  }
  ray.near = packet.near[lane];
  ray.far = packet.far[lane];
  return ray;
}

std::int64_t count_rays(const Packets& packets) {
  std::int64_t count = 0;
  for (const ray::RayPacket& packet : packets) count += packet.count;
  return count;
}

std::int64_t count_hits(const std::vector<ray::HitPacket>& hits) {
  std::int64_t count = 0;
  for (const ray::HitPacket& packet : hits)
    count += std::ranges::count_if(packet, &ray::Hit::valid);
  return count;
}

namespace {

/// Of a ray: t of the first face met clearly, and of the first met at all, edges included.
struct Slow {
  double clear = 1e300;
  double any = 1e300;
};

Slow try_all(const Subject& subject, const Buffer<float>& xyz, const ray::Ray& ray) {
  Slow slow;
  const auto at = [&](Index v, std::size_t axis) {
    return static_cast<double>(xyz[3 * static_cast<std::size_t>(v) + axis]);
  };
  const auto try_triangle = [&](Index a, Index b, Index c) {
    std::array<double, 3> ab;
    std::array<double, 3> ac;
    std::array<double, 3> offset;
    std::array<double, 3> way;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ab[axis] = at(b, axis) - at(a, axis);
      ac[axis] = at(c, axis) - at(a, axis);
      offset[axis] = static_cast<double>(ray.origin[axis]) - at(a, axis);
      way[axis] = ray.direction[axis];
    }
    const auto times = [](const auto& p, const auto& q) {
      return std::array<double, 3>{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                                   p[0] * q[1] - p[1] * q[0]};
    };
    const auto inner = [](const auto& p, const auto& q) {
      return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    };
    const auto normal = times(ab, ac);
    const double determinant = -inner(way, normal);
    if (determinant == 0) return;
    const double t = inner(offset, normal) / determinant;
    if (!(t >= ray.near && t <= ray.far) || t > slow.clear) return;
    const auto turned = times(offset, way);
    const double u = inner(ac, turned) / determinant;
    const double v = -inner(ab, turned) / determinant;
    const double least = std::min({u, v, 1 - u - v});
    if (least > 1e-3) slow.clear = t;
    if (least > -1e-3) slow.any = std::min(slow.any, t);
  };
  const FaceList faces = subject.soup.face_list();
  for (Index f = 0; f < subject.soup.face_count(); ++f) {
    const IndexRange range = faces.corner_range(f);
    const Index* v = subject.soup.corners.data() + range.begin;
    if (range.size() == 4) {
      try_triangle(v[0], v[1], v[3]);
      try_triangle(v[2], v[3], v[1]);
    } else {
      for (Index k = 1; k + 1 < range.size(); ++k) try_triangle(v[0], v[k], v[k + 1]);
    }
  }
  return slow;
}

}  // namespace

std::int64_t affordable_sample(const Subject& subject) {
  return std::clamp<std::int64_t>(2'000'000'000 / (subject.faces() + 1), 32, 10'000);
}

std::int64_t wrong_hits(const Subject& subject, const Buffer<float>& xyz, const Packets& packets,
                        const std::vector<ray::HitPacket>& hits, std::int64_t sample) {
  std::int64_t wrong = 0;
  const std::size_t count = 8 * packets.size();
  const std::size_t step = std::max<std::size_t>(1, count / static_cast<std::size_t>(sample));
  for (std::size_t i = step / 2; i < count; i += step) {
    if (static_cast<int>(i % 8) >= packets[i / 8].count) continue;
    const ray::Hit& hit = hits[i / 8][i % 8];
    const Slow slow = try_all(subject, xyz, ray_of(packets[i / 8], i % 8));
    if (!hit.valid()) {
      wrong += slow.clear < 1e300 ? 1 : 0;
      continue;
    }
    const double slack = 2e-4 * (1 + std::abs(hit.t));
    const bool is_right =
        hit.t >= slow.any - slack && hit.t <= slow.clear + slack && slow.any < 1e300;
    wrong += is_right ? 0 : 1;
  }
  return wrong;
}

}  // namespace hedgerow::bench
