// Edges are carried along from level to level instead of being looked up: edge e of a level gives
// vertex V + e and the edges 2 e and 2 e + 1 of the next one, so no map is needed.

#include <array>
#include <cmath>
#include <vector>

#include "counts.h"
#include "hedgerow/shapes.h"

namespace hedgerow::shapes {

namespace {

struct Edge {
  Index from;
  Index to;
};

// edges[k] joins vertices[k] and vertices[k + 1].
struct Triangle {
  std::array<Index, 3> vertices;
  std::array<Index, 3> edges;
};

struct Level {
  Index vertex_count = 0;
  std::vector<Edge> edges;
  std::vector<Triangle> triangles;
};

constexpr std::array<std::array<Index, 3>, 20> kIcosahedron = {
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

Level icosahedron() {
  Level level;
  level.vertex_count = 12;
  for (const auto& vertices : kIcosahedron) {
    Triangle triangle{vertices, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      const Index from = vertices[k];
      const Index to = vertices[(k + 1) % 3];
      std::size_t e = 0;
      while (e < level.edges.size() && (level.edges[e].from != to || level.edges[e].to != from)) {
        ++e;
      }
      if (e == level.edges.size()) level.edges.push_back({from, to});
      triangle.edges[k] = static_cast<Index>(e);
    }
    level.triangles.push_back(triangle);
  }
  return level;
}

Level refined(const Level& coarse) {
  const auto edge_count = static_cast<Index>(coarse.edges.size());
  Level fine;
  fine.vertex_count = coarse.vertex_count + edge_count;
  fine.edges.reserve(4 * coarse.edges.size());
  fine.triangles.reserve(4 * coarse.triangles.size());
  for (Index e = 0; e < edge_count; ++e) {
    const Edge edge = coarse.edges[static_cast<std::size_t>(e)];
    fine.edges.push_back({edge.from, coarse.vertex_count + e});
    fine.edges.push_back({coarse.vertex_count + e, edge.to});
  }
  for (const Triangle& t : coarse.triangles) {
    const auto inner = static_cast<Index>(fine.edges.size());
    std::array<Index, 3> middle{};
    for (std::size_t k = 0; k < 3; ++k) middle[k] = coarse.vertex_count + t.edges[k];
    // The half of edge k at `vertex`.
    const auto half = [&](std::size_t k, Index vertex) {
      const Index e = t.edges[k];
      return coarse.edges[static_cast<std::size_t>(e)].from == vertex ? 2 * e : 2 * e + 1;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t before = (k + 2) % 3;
      const Index v = t.vertices[k];
      fine.edges.push_back({middle[k], middle[before]});
      fine.triangles.push_back({{v, middle[k], middle[before]},
                                {half(k, v), inner + static_cast<Index>(k), half(before, v)}});
    }
    // Edge `inner + k` joins middles k - 1 and k.
    fine.triangles.push_back({middle, {inner + 1, inner + 2, inner}});
  }
  return fine;
}

void put_on_sphere(float* xyz, double x, double y, double z) {
  const double scale = 1 / std::sqrt(x * x + y * y + z * z);
  xyz[0] = static_cast<float>(x * scale);
  xyz[1] = static_cast<float>(y * scale);
  xyz[2] = static_cast<float>(z * scale);
}

void fill_icosahedron(float* xyz) {
  const double t = (1 + std::sqrt(5.0)) / 2;
  const std::array<std::array<double, 3>, 12> points = {{{-1, t, 0},
                                                         {1, t, 0},
                                                         {-1, -t, 0},
                                                         {1, -t, 0},
                                                         {0, -1, t},
                                                         {0, 1, t},
                                                         {0, -1, -t},
                                                         {0, 1, -t},
                                                         {t, 0, -1},
                                                         {t, 0, 1},
                                                         {-t, 0, -1},
                                                         {-t, 0, 1}}};
  for (const auto& p : points) {
    put_on_sphere(xyz, p[0], p[1], p[2]);
    xyz += 3;
  }
}

void fill_middles(const Level& level, float* xyz) {
  float* out = xyz + 3 * static_cast<std::size_t>(level.vertex_count);
  for (const Edge& edge : level.edges) {
    const float* a = xyz + 3 * static_cast<std::size_t>(edge.from);
    const float* b = xyz + 3 * static_cast<std::size_t>(edge.to);
    put_on_sphere(out, static_cast<double>(a[0]) + static_cast<double>(b[0]),
                  static_cast<double>(a[1]) + static_cast<double>(b[1]),
                  static_cast<double>(a[2]) + static_cast<double>(b[2]));
    out += 3;
  }
}

}  // namespace

Result<Soup> icosphere(std::int64_t level) {
  if (auto ok = at_least(0, level); !ok) return fail(ok.error());
  std::int64_t triangles = 20;
  for (std::int64_t i = 0; i < level && triangles <= kMaxCount; ++i) {
    triangles = saturating_product(triangles, 4);
  }
  Result<Soup> soup = make_triangles(triangles / 2 + 2, triangles);
  if (!soup) return soup;
  Level mesh = icosahedron();
  fill_icosahedron(soup->xyz.data());
  for (std::int64_t i = 0; i < level; ++i) {
    fill_middles(mesh, soup->xyz.data());
    mesh = refined(mesh);
  }
  TriangleWriter out(*soup);
  for (const Triangle& t : mesh.triangles) out.add(t.vertices[0], t.vertices[1], t.vertices[2]);
  return soup;
}

}  // namespace hedgerow::shapes
