#include "support/ray_cases.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "hedgerow/shapes.h"

namespace hedgerow::test {
namespace {

using Point = std::array<double, 3>;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point at(const Soup& soup, Index v) {
  const float* xyz = soup.positions()[v];
  return {xyz[0], xyz[1], xyz[2]};
}

struct Box {
  Point low{1e300, 1e300, 1e300};
  Point high{-1e300, -1e300, -1e300};
};
Box box_of(const Soup& soup) {
  Box box;
  for (Index v = 0; v < soup.vertex_count(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], at(soup, v)[axis]);
      box.high[axis] = std::max(box.high[axis], at(soup, v)[axis]);
    }
  }
  return box;
}

// Fractions by division: the distributions of the standard differ between libraries.
double fraction(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) / 0x1p53; }
Point point_in(const Box& box, double margin, std::mt19937_64& random) {
  Point point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = box.high[axis] - box.low[axis];
    point[axis] = box.low[axis] + size * (fraction(random) * (1 + 2 * margin) - margin);
  }
  return point;
}

}  // namespace

RayMesh::RayMesh(std::string called, Soup&& faces)
    : name(std::move(called)), soup(std::move(faces)) {
  BuildOptions options;
  options.borrow_corners = true;
  mesh = std::move(build(soup.face_list(), options, Execution::serial())->mesh);
}

Soup mixed_plane(Index rows) {
  const Index columns = 6;
  std::vector<float> xyz;
  for (Index y = 0; y <= 2 * rows; ++y) {
    for (Index x = 0; x <= columns; ++x) {
      const auto fx = static_cast<float>(x);
      const auto fy = static_cast<float>(y);
      for (const float c : {fx, fy, 0.25F * fx - 0.5F * fy}) xyz.push_back(c);
    }
  }
  std::vector<Index> corners;
  std::vector<Index> offsets = {0};
  const auto face = [&](std::initializer_list<Index> vertices) {
    corners.insert(corners.end(), vertices);
    offsets.push_back(static_cast<Index>(corners.size()));
  };
  for (Index row = 0; row < rows; ++row) {
    const auto v = [&](Index x, Index y) { return (2 * row + y) * (columns + 1) + x; };
    for (const Index y : {0, 1}) {
      face({v(0, y), v(1, y), v(1, y + 1)});
      face({v(0, y), v(1, y + 1), v(0, y + 1)});
      face({v(1, y), v(2, y), v(2, y + 1), v(1, y + 1)});
      face({v(2, y), v(3, y), v(4, y), v(4, y + 1), v(3, y + 1), v(2, y + 1)});
    }
    face({v(4, 0), v(5, 0), v(6, 0), v(6, 1), v(5, 1), v(5, 2), v(4, 2), v(4, 1)});
    face({v(5, 1), v(6, 1), v(6, 2), v(5, 2)});
  }
  return {Buffer<float>::copy_of(xyz), Buffer<Index>::copy_of(corners),
          Buffer<Index>::copy_of(offsets)};
}

Result<ray::Scene> scene_of(const RayMesh& subject, const ray::SceneOptions& options,
                            const Execution& execution) {
  return ray::Scene::build(*ray::Device::create(), subject.mesh,
                           ray::PaddedPositions::of(subject.soup.xyz), options, execution);
}

std::vector<RayMesh> ray_meshes() {
  std::vector<RayMesh> meshes;
  meshes.emplace_back("icosphere", *shapes::icosphere(3));
  meshes.emplace_back("gyroid", *shapes::gyroid(12));
  meshes.emplace_back("terrain", *shapes::terrain(40, 30));
  meshes.emplace_back("quads", *shapes::quad_grid(40, 25));
  meshes.emplace_back("mixed", mixed_plane(12));
  return meshes;
}

std::vector<FaceTriangle> triangles_of(const Soup& soup) {
  std::vector<FaceTriangle> triangles;
  const FaceList faces = soup.face_list();
  for (Index f = 0; f < soup.face_count(); ++f) {
    const IndexRange range = faces.corner_range(f);
    const Index* v = soup.corners.data() + range.begin;
    const FaceId face(f);
    switch (range.size()) {
      case 4:
        triangles.push_back({face, {v[0], v[1], v[3]}});
        triangles.push_back({face, {v[2], v[3], v[1]}});
        break;
      case 8:  // the L of `mixed_plane`, round its reflex corner
        for (Index k = 0; k < 8; ++k) {
          if (k != 3 && k != 4) triangles.push_back({face, {v[4], v[k], v[(k + 1) % 8]}});
        }
        break;
      default:
        for (Index k = 1; k + 1 < range.size(); ++k) {
          triangles.push_back({face, {v[0], v[k], v[k + 1]}});
        }
    }
  }
  return triangles;
}

double diagonal_of(const Soup& soup) {
  const Box box = box_of(soup);
  const Point size = minus(box.high, box.low);
  return std::sqrt(dot(size, size));
}

std::vector<ray::Ray> random_rays(const Soup& soup, int count, unsigned seed) {
  const Box box = box_of(soup);
  const double diagonal = diagonal_of(soup);
  std::mt19937_64 random(seed);
  std::vector<ray::Ray> rays;
  while (std::ssize(rays) < count) {
    const Point target = point_in(box, 0.15, random);
    Point way;
    for (double& c : way) c = 2 * fraction(random) - 1;
    const double length = std::sqrt(dot(way, way));
    if (length > 1 || length < 0.1) continue;
    ray::Ray ray;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ray.direction[axis] = static_cast<float>(way[axis]);
      ray.origin[axis] = static_cast<float>(target[axis] - way[axis] / length * diagonal);
    }
    rays.push_back(ray);
  }
  return rays;
}

std::vector<ray::Vec3> random_points(const Soup& soup, int count, unsigned seed) {
  const Box box = box_of(soup);
  std::mt19937_64 random(seed);
  std::vector<ray::Vec3> points;
  for (int i = 0; i < count; ++i) {
    const Point point = point_in(box, 0.3, random);
    points.push_back(
        {static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2])});
  }
  return points;
}

std::vector<SlowHit> slow_hits(const Soup& soup, const std::vector<FaceTriangle>& triangles,
                               const ray::Ray& ray) {
  constexpr double kOutside = -1e-4;
  const Point origin = {ray.origin[0], ray.origin[1], ray.origin[2]};
  const Point way = {ray.direction[0], ray.direction[1], ray.direction[2]};
  std::vector<SlowHit> hits;
  for (const FaceTriangle& triangle : triangles) {
    // Solve origin + t way = a + u (b - a) + v (c - a) by Cramer's rule.
    const Point a = at(soup, triangle.vertices[0]);
    const Point ab = minus(at(soup, triangle.vertices[1]), a);
    const Point ac = minus(at(soup, triangle.vertices[2]), a);
    const Point normal = cross(ab, ac);
    const double determinant = -dot(way, normal);
    if (determinant == 0) continue;
    const Point offset = minus(origin, a);
    const Point turned = cross(offset, way);
    const double t = dot(offset, normal) / determinant;
    const double u = dot(ac, turned) / determinant;
    const double v = -dot(ab, turned) / determinant;
    const double margin = std::min({u, v, 1 - u - v});
    if (margin < kOutside || t < ray.near || t > ray.far) continue;
    hits.push_back({t, triangle.face, margin});
  }
  std::ranges::sort(hits, {}, &SlowHit::t);
  return hits;
}

double slow_squared_distance(const std::array<Point, 3>& corners, const Point& from) {
  const auto& [a, b, c] = corners;
  double least = 1e300;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point along = minus(corners[(k + 1) % 3], corners[k]);
    const double length = dot(along, along);
    const double share =
        length > 0 ? std::clamp(dot(along, minus(from, corners[k])) / length, 0.0, 1.0) : 0;
    Point offset = minus(from, corners[k]);
    for (std::size_t axis = 0; axis < 3; ++axis) offset[axis] -= share * along[axis];
    least = std::min(least, dot(offset, offset));
  }
  const Point normal = cross(minus(b, a), minus(c, a));
  const double area = dot(normal, normal);
  if (area == 0) return least;
  bool is_inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point side = cross(minus(corners[(k + 1) % 3], corners[k]), minus(from, corners[k]));
    is_inside = is_inside && dot(side, normal) >= 0;
  }
  const double height = dot(minus(from, a), normal);
  return is_inside ? std::min(least, height * height / area) : least;
}

}  // namespace hedgerow::test
