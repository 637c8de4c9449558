#include "support/normal_meshes.h"

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "hedgerow/build.h"

namespace hedgerow::test {

namespace {

Buffer<float> buffer_of(const std::vector<float>& values) { return Buffer<float>::copy_of(values); }
Buffer<Index> buffer_of(const std::vector<Index>& values) { return Buffer<Index>::copy_of(values); }

}  // namespace

Soup make_soup(const std::vector<float>& xyz, const std::vector<std::vector<Index>>& faces,
               bool polygons) {
  std::vector<Index> corners;
  std::vector<Index> offsets = {0};
  for (const auto& face : faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    offsets.push_back(static_cast<Index>(corners.size()));
    polygons |= face.size() != 3;
  }
  if (!polygons) offsets.clear();
  return {buffer_of(xyz), buffer_of(corners), buffer_of(offsets)};
}

Soup copy_of(const Soup& soup) {
  return {Buffer<float>::copy_of(soup.xyz.span()), Buffer<Index>::copy_of(soup.corners.span()),
          Buffer<Index>::copy_of(soup.offsets.span())};
}

Soup cube_of_quads() {
  return make_soup(
      {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1},
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

Soup wavy_grid(Index n) {
  std::vector<float> xyz;
  std::vector<std::vector<Index>> faces;
  for (Index y = 0; y <= n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const auto fx = static_cast<float>(x);
      const auto fy = static_cast<float>(y);
      xyz.insert(xyz.end(), {std::cos(fx * 6.2831853f / static_cast<float>(n)) * (3 + 0.1f * fy),
                             std::sin(fx * 6.2831853f / static_cast<float>(n)) * (3 + 0.1f * fy),
                             fy * 0.2f + std::sin(fx * 1.7f) * 0.05f});
    }
  }
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const Index a = y * n + x;
      const Index b = y * n + (x + 1) % n;
      faces.push_back({a, b, b + n});
      faces.push_back({a, b + n, a + n});
    }
  }
  return make_soup(xyz, faces);
}

Soup wavy_fan(Index n) {
  std::vector<float> xyz = {0, 0, 1};
  for (Index i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n);
    xyz.insert(xyz.end(), {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                           static_cast<float>(0.2 * std::sin(5 * angle))});
  }
  std::vector<std::vector<Index>> faces(static_cast<std::size_t>(n));
  std::vector<Index> order(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  std::mt19937_64 random(7);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  for (Index i = 0; i < n; ++i) {
    std::vector<Index> face = {0, 1 + i, 1 + (i + 1) % n};
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random() % 3), face.end());
    faces[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])] = face;
  }
  return make_soup(xyz, faces);
}

Soup sphere(int levels, float centre) {
  std::vector<std::array<double, 3>> points = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                               {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  std::vector<std::vector<Index>> faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                           {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
      const auto [place, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<Index>(points.size()));
      if (is_new) {
        const auto& p = points[static_cast<std::size_t>(a)];
        const auto& q = points[static_cast<std::size_t>(b)];
        std::array<double, 3> m = {p[0] + q[0], p[1] + q[1], p[2] + q[2]};
        const double length = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
        for (double& c : m) c /= length;
        points.push_back(m);
      }
      return place->second;
    };
    std::vector<std::vector<Index>> finer;
    for (const auto& f : faces) {
      const Index a = middle(f[0], f[1]);
      const Index b = middle(f[1], f[2]);
      const Index c = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {a, f[1], b}, {c, b, f[2]}, {a, b, c}});
    }
    faces = std::move(finer);
  }
  std::vector<float> xyz;
  for (const auto& p : points) {
    for (const double c : p) xyz.push_back(static_cast<float>(c) + centre);
  }
  return make_soup(xyz, faces);
}

Soup random_soup(std::uint64_t seed, Index vertex_count, Index face_count, Index max_degree) {
  std::mt19937_64 random(seed);
  const auto below = [&](Index n) {
    return static_cast<Index>(random() % static_cast<std::uint64_t>(n));
  };
  std::vector<float> xyz;
  for (Index v = 0; v < vertex_count; ++v) {
    // Some points coincide, so that some faces have no area.
    const auto old = static_cast<std::size_t>(v > 0 && random() % 5 == 0 ? v - 1 : v);
    for (std::size_t k = 0; k < 3; ++k) {
      const float fresh = static_cast<float>(below(1 << 20)) * 0x1p-18f;
      xyz.push_back(old == static_cast<std::size_t>(v) ? fresh : xyz[3 * old + k]);
    }
  }
  std::vector<std::vector<Index>> faces;
  while (static_cast<Index>(faces.size()) < face_count) {
    const Index degree = 3 + below(max_degree - 2);
    std::vector<Index> face;
    const Index start = below(vertex_count - 1);  // the last vertex stays isolated
    while (static_cast<Index>(face.size()) < degree) {
      const Index v = (start + below(2 * max_degree)) % (vertex_count - 1);
      if (std::find(face.begin(), face.end(), v) == face.end()) face.push_back(v);
    }
    faces.push_back(face);
  }
  return make_soup(xyz, faces);
}

Connectivity mesh_of(const Soup& soup) {
  auto built = build(soup.face_list(), BuildOptions{}, Execution::serial());
  if (!built) {
    ADD_FAILURE() << "the mesh cannot be built: " << name(built.error().code);
    return {};
  }
  EXPECT_TRUE(built->faces_new_to_old.empty());
  return std::move(built->mesh);
}

}  // namespace hedgerow::test
