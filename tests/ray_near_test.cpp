#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/normals.h"
#include "hedgerow/ray/near.h"
#include "hedgerow/ray/scene.h"
#include "hedgerow/ray/surface.h"
#include "support/allocations.h"
#include "support/ray_cases.h"

namespace hedgerow {
namespace {

using ray::NearbySearch;
using ray::SurfacePoint;
using ray::Vec3;
using ray::VertexDistance;
using test::RayMesh;

/// Neighbours of every vertex from the faces alone.
std::vector<std::set<Index>> slow_neighbours(const Soup& soup) {
  std::vector<std::set<Index>> near(static_cast<std::size_t>(soup.vertex_count()));
  const FaceList faces = soup.face_list();
  for (Index f = 0; f < soup.face_count(); ++f) {
    const IndexRange range = faces.corner_range(f);
    for (Index c = range.begin; c < range.end; ++c) {
      const Index a = soup.corners[static_cast<std::size_t>(c)];
      const Index next = c + 1 < range.end ? c + 1 : range.begin;
      const Index b = soup.corners[static_cast<std::size_t>(next)];
      near[static_cast<std::size_t>(a)].insert(b);
      near[static_cast<std::size_t>(b)].insert(a);
    }
  }
  return near;
}

float edge_length(const Soup& soup, Index a, Index b) {
  const float* p = soup.positions()[a];
  const float* q = soup.positions()[b];
  const float x = q[0] - p[0];
  const float y = q[1] - p[1];
  const float z = q[2] - p[2];
  return std::sqrt(x * x + y * y + z * z);
}

/// Points met by rays, with everything that the tests ask about them.
std::vector<SurfacePoint> points_on(const RayMesh& subject, int count, unsigned seed) {
  const auto device = ray::Device::create();
  const auto scene = ray::Scene::build(
      *device, subject.mesh, ray::PaddedPositions::of(subject.soup.xyz), {}, Execution::serial());
  std::vector<SurfacePoint> points;
  for (const ray::Ray& ray : test::random_rays(subject.soup, count, seed)) {
    const ray::Hit hit = scene->intersect(ray);
    if (hit.valid()) points.push_back(scene->primitives().point(hit));
  }
  return points;
}

TEST(RaySurface, NamesHalfedgesOfTheFaceThatWasMet) {
  for (const RayMesh& subject : test::ray_meshes()) {
    subject.mesh.visit([&](const auto& view) {
      for (const SurfacePoint& point : points_on(subject, 500, 31)) {
        const FaceId face = ray::face_of(view, point);
        for (const HalfedgeId h : point.corners) EXPECT_EQ(view.face(h), face) << subject.name;
        const HalfedgeId edge = ray::nearest_halfedge(view, point);
        EXPECT_EQ(view.face(edge), face);
        const std::size_t nearest = ray::nearest_corner(point);
        for (const float weight : point.weights) EXPECT_GE(point.weights[nearest], weight);
        EXPECT_EQ(ray::nearest_vertex(view, point), view.origin[point.corners[nearest]]);
      }
    });
  }
}

TEST(RaySurface, FindsTheEdgeThatThePointIsNextTo) {
  const RayMesh subject("icosphere", std::move(test::ray_meshes()[0].soup));
  const TriangleView view = subject.mesh.triangles();
  for (Index f = 0; f < view.face_count(); f += 11) {
    for (Index k = 0; k < 3; ++k) {
      SurfacePoint point{{HalfedgeId(3 * f), HalfedgeId(3 * f + 1), HalfedgeId(3 * f + 2)}, {}};
      point.weights[static_cast<std::size_t>(k)] = 0.5F;
      point.weights[static_cast<std::size_t>((k + 1) % 3)] = 0.49F;
      point.weights[static_cast<std::size_t>((k + 2) % 3)] = 0.01F;
      EXPECT_EQ(ray::nearest_halfedge(view, point), HalfedgeId(3 * f + k));
      EXPECT_EQ(ray::nearest_corner(point), static_cast<std::size_t>(k));
    }
  }
}

TEST(RaySurface, InterpolatesNormalsLikeDoubles) {
  for (const RayMesh& subject : test::ray_meshes()) {
    Buffer<float> normals(subject.soup.xyz.size());
    Workspace workspace;
    const std::int64_t count = subject.soup.vertex_count();
    ASSERT_TRUE(gather_vertex_normals(subject.mesh, subject.soup.positions(),
                                      {normals.data(), count}, {}, Execution::serial(), workspace));
    const Positions values{normals.data(), count};
    subject.mesh.visit([&](const auto& view) {
      for (const SurfacePoint& point : points_on(subject, 500, 32)) {
        std::array<double, 3> sum{};
        for (std::size_t k = 0; k < 3; ++k) {
          const float* normal = values[view.origin[point.corners[k]].value];
          for (std::size_t axis = 0; axis < 3; ++axis) {
            sum[axis] += static_cast<double>(point.weights[k]) * static_cast<double>(normal[axis]);
          }
        }
        const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
        const Vec3 normal = ray::interpolate_normal(view, point, values);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_NEAR(normal[axis], sum[axis] / length, 1e-5) << subject.name;
        }
      }
    });
  }
}

TEST(RaySurface, HasNoNormalWhereTheNormalsCancel) {
  const RayMesh subject("icosphere", std::move(test::ray_meshes()[0].soup));
  Buffer<float> normals(subject.soup.xyz.size(), 0.0F);
  const SurfacePoint point{{HalfedgeId(0), HalfedgeId(1), HalfedgeId(2)}, {0.2F, 0.3F, 0.5F}};
  EXPECT_EQ(ray::interpolate_normal(subject.mesh.triangles(), point,
                                    {normals.data(), subject.soup.vertex_count()}),
            Vec3{});
}

TEST(RayNear, FindsTheRingsThatABreadthFirstSearchFinds) {
  for (const RayMesh& subject : test::ray_meshes()) {
    const auto near = slow_neighbours(subject.soup);
    NearbySearch search;
    subject.mesh.visit([&](const auto& view) {
      for (const SurfacePoint& point : points_on(subject, 60, 33)) {
        const VertexId start = ray::nearest_vertex(view, point);
        std::set<Index> inside = {start.value};
        for (int rings = 0; rings <= 4; ++rings) {
          const auto found = search.k_ring(view, start, rings);
          ASSERT_EQ(found.front(), start);
          std::set<Index> distinct;
          for (const VertexId v : found) distinct.insert(v.value);
          EXPECT_EQ(distinct.size(), found.size());
          EXPECT_EQ(distinct, inside) << subject.name << ' ' << rings;
          std::set<Index> wider = inside;
          for (const Index v : inside) {
            wider.insert(near[static_cast<std::size_t>(v)].begin(),
                         near[static_cast<std::size_t>(v)].end());
          }
          inside = std::move(wider);
        }
      }
    });
  }
}

/// Distances from the corners on by going over all edges until nothing changes any more.
std::map<Index, float> slow_ball(const Soup& soup, const std::vector<std::set<Index>>& near,
                                 std::map<Index, float> distance, float radius) {
  for (bool changes = true; changes;) {
    changes = false;
    const std::map<Index, float> before = distance;
    for (const auto& [v, reached] : before) {
      for (const Index u : near[static_cast<std::size_t>(v)]) {
        const float there = reached + edge_length(soup, v, u);
        const auto known = distance.find(u);
        if (there <= radius && (known == distance.end() || there < known->second)) {
          distance[u] = there;
          changes = true;
        }
      }
    }
  }
  return distance;
}

TEST(RayNear, MeasuresGeodesicBallsAsRelaxingAllEdgesDoes) {
  for (const RayMesh& subject : test::ray_meshes()) {
    const auto near = slow_neighbours(subject.soup);
    const auto radius = static_cast<float>(0.15 * test::diagonal_of(subject.soup));
    NearbySearch search;
    subject.mesh.visit([&](const auto& view) {
      for (const SurfacePoint& point : points_on(subject, 25, 34)) {
        Vec3 at{};
        for (std::size_t k = 0; k < 3; ++k) {
          const float* corner = subject.soup.positions()[view.origin[point.corners[k]].value];
          for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += point.weights[k] * corner[axis];
        }
        std::map<Index, float> start;
        for (const HalfedgeId h : point.corners) {
          const float* corner = subject.soup.positions()[view.origin[h].value];
          const float x = corner[0] - at[0];
          const float y = corner[1] - at[1];
          const float z = corner[2] - at[2];
          const float distance = std::sqrt(x * x + y * y + z * z);
          if (distance <= radius) start[view.origin[h].value] = distance;
        }
        const auto expected = slow_ball(subject.soup, near, start, radius);
        const auto ball = search.geodesic_ball(view, subject.soup.positions(), point, radius);
        EXPECT_EQ(ball.size(), expected.size()) << subject.name;
        EXPECT_TRUE(std::ranges::is_sorted(ball, {}, &VertexDistance::distance));
        for (const VertexDistance& found : ball) {
          const auto known = expected.find(found.vertex.value);
          ASSERT_NE(known, expected.end());
          EXPECT_EQ(found.distance, known->second) << subject.name;
        }
      }
    });
  }
}

TEST(RayNear, IsEmptyInABallThatReachesNoCorner) {
  const RayMesh subject("icosphere", std::move(test::ray_meshes()[0].soup));
  NearbySearch search;
  const SurfacePoint point{{HalfedgeId(0), HalfedgeId(1), HalfedgeId(2)}, {0.4F, 0.3F, 0.3F}};
  const TriangleView view = subject.mesh.triangles();
  EXPECT_TRUE(search.geodesic_ball(view, subject.soup.positions(), point, 1e-6F).empty());
  EXPECT_TRUE(search
                  .geodesic_ball(view, subject.soup.positions(), point,
                                 std::numeric_limits<float>::quiet_NaN())
                  .empty());
  const auto all = search.geodesic_ball(view, subject.soup.positions(), point, 1e6F);
  EXPECT_EQ(std::ssize(all), subject.soup.vertex_count());
}

TEST(RayNear, AllocatesNothingTheSecondTime) {
  const RayMesh subject("gyroid", std::move(test::ray_meshes()[1].soup));
  const auto points = points_on(subject, 200, 35);
  const TriangleView view = subject.mesh.triangles();
  const auto radius = static_cast<float>(0.1 * test::diagonal_of(subject.soup));
  NearbySearch search;
  std::array<VertexId, 50> steps;
  const auto run = [&] {
    std::size_t sum = 0;
    for (const SurfacePoint& point : points) {
      const VertexId start = ray::nearest_vertex(view, point);
      sum += search.k_ring(view, start, 2).size();
      sum += search.geodesic_ball(view, subject.soup.positions(), point, radius).size();
      sum += ray::edge_walk(view, subject.soup.positions(), start, {1, 0, 0}, steps);
    }
    return sum;
  };
  const std::size_t first = run();
  const int allocations = test::allocation_count();
  EXPECT_EQ(run(), first);
  EXPECT_EQ(test::allocation_count(), allocations);
}

TEST(RayNear, WalksAlongTheEdgesThatTurnLeast) {
  for (const RayMesh& subject : test::ray_meshes()) {
    const auto near = slow_neighbours(subject.soup);
    subject.mesh.visit([&](const auto& view) {
      for (const SurfacePoint& point : points_on(subject, 50, 36)) {
        const Vec3 way = {0.3F, -0.8F, 0.1F};
        const VertexId start = ray::nearest_vertex(view, point);
        std::array<VertexId, 50> out;
        const std::size_t steps = ray::edge_walk(view, subject.soup.positions(), start, way, out);
        Index at = start.value;
        for (std::size_t step = 0; step < steps; ++step) {
          const auto cosine = [&](Index u) {
            const float* p = subject.soup.positions()[at];
            const float* q = subject.soup.positions()[u];
            return ((q[0] - p[0]) * way[0] + (q[1] - p[1]) * way[1] + (q[2] - p[2]) * way[2]) /
                   edge_length(subject.soup, at, u);
          };
          const auto& choices = near[static_cast<std::size_t>(at)];
          ASSERT_TRUE(choices.contains(out[step].value)) << subject.name;
          for (const Index u : choices) EXPECT_GE(cosine(out[step].value), cosine(u));
          EXPECT_GT(cosine(out[step].value), 0);
          at = out[step].value;
        }
        if (steps == out.size()) continue;
        for (const Index u : near[static_cast<std::size_t>(at)]) {
          const float* p = subject.soup.positions()[at];
          const float* q = subject.soup.positions()[u];
          EXPECT_LE((q[0] - p[0]) * way[0] + (q[1] - p[1]) * way[1] + (q[2] - p[2]) * way[2], 0);
        }
      }
    });
  }
}

}  // namespace
}  // namespace hedgerow
