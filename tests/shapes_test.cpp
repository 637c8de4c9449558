#include "hedgerow/shapes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace hedgerow::shapes {
namespace {

using Faces = std::vector<std::vector<Index>>;

Faces faces_of(const Soup& soup) {
  Faces faces;
  const FaceList list = soup.face_list();
  for (Index f = 0; f < soup.face_count(); ++f) {
    const IndexRange range = list.corner_range(f);
    faces.emplace_back(soup.corners.begin() + range.begin, soup.corners.begin() + range.end);
  }
  return faces;
}

// What a shape is, counted with maps from its faces alone.
struct Census {
  std::int64_t euler = 0;
  std::int64_t boundary_edges = 0;
  std::int64_t inconsistent_edges = 0;
  std::int64_t nonmanifold_edges = 0;
  std::int64_t components = 0;
  std::int64_t boundary_loops = 0;
  bool repeats_a_position = false;
  bool has_isolated_vertices = false;
  bool has_bad_faces = false;
};

std::int64_t count_sets(std::vector<Index> parent_of, const std::set<Index>& members,
                        const std::vector<std::pair<Index, Index>>& joins) {
  const auto root = [&](Index v) {
    while (parent_of[static_cast<std::size_t>(v)] != v) {
      Index& parent = parent_of[static_cast<std::size_t>(v)];
      parent = parent_of[static_cast<std::size_t>(parent)];
      v = parent;
    }
    return v;
  };
  for (const auto& [a, b] : joins) parent_of[static_cast<std::size_t>(root(a))] = root(b);
  return std::count_if(members.begin(), members.end(), [&](Index v) { return root(v) == v; });
}

Census census(const Soup& soup) {
  Census found;
  std::map<std::pair<Index, Index>, std::array<std::int64_t, 2>> edges;  // forwards, backwards
  std::set<Index> used;
  for (const std::vector<Index>& face : faces_of(soup)) {
    found.has_bad_faces |= std::set<Index>(face.begin(), face.end()).size() != face.size();
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k];
      const Index b = face[(k + 1) % face.size()];
      found.has_bad_faces |= a < 0 || a >= soup.vertex_count();
      used.insert(a);
      ++edges[std::minmax(a, b)][a < b ? 0 : 1];
    }
  }
  std::vector<std::pair<Index, Index>> joins;
  std::vector<std::pair<Index, Index>> boundary;
  std::set<Index> boundary_vertices;
  for (const auto& [ends, count] : edges) {
    joins.push_back(ends);
    const std::int64_t faces = count[0] + count[1];
    if (faces == 1) {
      boundary.push_back(ends);
      boundary_vertices.insert({ends.first, ends.second});
    }
    if (faces > 2) ++found.nonmanifold_edges;
    if (faces == 2 && count[0] != 1) ++found.inconsistent_edges;
  }
  std::vector<Index> alone(static_cast<std::size_t>(soup.vertex_count()));
  std::iota(alone.begin(), alone.end(), Index{0});
  found.components = count_sets(alone, used, joins);
  found.boundary_loops = count_sets(alone, boundary_vertices, boundary);
  found.boundary_edges = static_cast<std::int64_t>(boundary.size());
  found.euler = static_cast<std::int64_t>(used.size()) - static_cast<std::int64_t>(edges.size()) +
                soup.face_count();
  found.has_isolated_vertices = static_cast<Index>(used.size()) != soup.vertex_count();
  std::set<std::array<float, 3>> positions;
  for (Index v = 0; v < soup.vertex_count(); ++v) {
    const float* p = soup.positions()[v];
    found.repeats_a_position |= !positions.insert({p[0], p[1], p[2]}).second;
  }
  return found;
}

struct Expected {
  Shape shape;
  std::int64_t euler;
  std::int64_t boundary_loops;
  bool is_orientable;
};

class EveryShape : public ::testing::TestWithParam<Expected> {};

TEST_P(EveryShape, HasTheTopologyOfItsName) {
  const Expected expected = GetParam();
  for (const std::int64_t size : {1, 5, 60, 700, 4000}) {
    SCOPED_TRACE(size);
    const Result<Soup> soup = generate(expected.shape, size);
    ASSERT_TRUE(soup);
    const Census found = census(*soup);
    EXPECT_EQ(found.euler, expected.euler);
    EXPECT_EQ(found.boundary_loops, expected.boundary_loops);
    EXPECT_EQ(found.inconsistent_edges == 0, expected.is_orientable);
    EXPECT_EQ(found.nonmanifold_edges, 0);
    EXPECT_EQ(found.components, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, EveryShape,
    ::testing::Values(Expected{Shape::grid, 1, 1, true}, Expected{Shape::quad_grid, 1, 1, true},
                      Expected{Shape::torus, 0, 0, true}, Expected{Shape::icosphere, 2, 0, true},
                      Expected{Shape::fan, 1, 1, true}, Expected{Shape::strip, 1, 1, true},
                      Expected{Shape::mobius, 0, 1, false}, Expected{Shape::klein, 0, 0, false},
                      Expected{Shape::terrain, 1, 1, true}),
    [](const auto& instance) {
      std::string word = name(instance.param.shape);
      std::replace(word.begin(), word.end(), '-', '_');
      return word;
    });

TEST(Shapes, UseEveryVertexOnceAndRepeatNone) {
  for (const Shape shape : kShapes) {
    for (const std::int64_t size : {1, 300, 5000}) {
      SCOPED_TRACE(std::string(name(shape)) + " " + std::to_string(size));
      const Result<Soup> soup = generate(shape, size);
      ASSERT_TRUE(soup);
      const Census found = census(*soup);
      EXPECT_FALSE(found.has_bad_faces);
      EXPECT_FALSE(found.has_isolated_vertices);
      EXPECT_FALSE(found.repeats_a_position);
    }
  }
}

TEST(Shapes, HaveAboutAsManyTrianglesAsAskedFor) {
  for (const Shape shape : kShapes) {
    SCOPED_TRACE(name(shape));
    const std::int64_t wanted = 60'000;
    const Result<Soup> soup = generate(shape, wanted);
    ASSERT_TRUE(soup);
    const std::int64_t triangles =
        soup->offsets.empty() ? soup->face_count() : 2 * soup->face_count();
    const std::int64_t tolerance = shape == Shape::icosphere ? wanted / 2 : wanted / 20;
    EXPECT_NEAR(static_cast<double>(triangles), static_cast<double>(wanted),
                static_cast<double>(tolerance));
  }
}

TEST(Shapes, AreFoundByTheirNames) {
  for (const Shape shape : kShapes) EXPECT_EQ(shape_named(name(shape)), shape);
  EXPECT_EQ(shape_named("cube"), std::nullopt);
  EXPECT_EQ(shape_named(""), std::nullopt);
}

TEST(Shapes, RefuseWhatIsTooSmall) {
  const std::array<Result<Soup>, 9> refused = {grid(0, 5),   quad_grid(5, -1), torus(2, 3),
                                               torus(3, 2),  icosphere(-1),    fan(0),
                                               mobius(2, 1), klein(3, 2),      gyroid(3)};
  for (const Result<Soup>& soup : refused) {
    ASSERT_FALSE(soup);
    EXPECT_EQ(soup.error().code, ErrorCode::count_mismatch);
    EXPECT_LT(soup.error().value, soup.error().limit);
  }
  EXPECT_FALSE(fan(2, FanEnds::closed));
  EXPECT_FALSE(generate(Shape::grid, 0));
}

TEST(Shapes, RefuseWhatNoIndexCanCount) {
  constexpr std::int64_t kHuge = std::int64_t{1} << 62;
  const std::array<Result<Soup>, 9> refused = {
      grid(kHuge, 3),   quad_grid(3, kHuge), torus(kHuge, kHuge),   icosphere(60), fan(kHuge),
      mobius(kHuge, 1), klein(3, kHuge),     terrain(kHuge, kHuge), gyroid(kHuge)};
  for (const Result<Soup>& soup : refused) {
    ASSERT_FALSE(soup);
    EXPECT_EQ(soup.error().code, ErrorCode::too_many_elements);
    EXPECT_GT(soup.error().value, soup.error().limit);
  }
  EXPECT_FALSE(strip(kHuge));
}

TEST(Grid, RunsRowByRow) {
  const Result<Soup> soup = grid(2, 1);
  ASSERT_TRUE(soup);
  EXPECT_EQ(faces_of(*soup), (Faces{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}));
  const Result<Soup> quads = quad_grid(2, 1);
  ASSERT_TRUE(quads);
  EXPECT_EQ(faces_of(*quads), (Faces{{0, 1, 4, 3}, {1, 2, 5, 4}}));
}

TEST(Fan, TurnsRoundItsFirstVertex) {
  const Result<Soup> open = fan(3);
  const Result<Soup> closed = fan(3, FanEnds::closed);
  ASSERT_TRUE(open && closed);
  EXPECT_EQ(faces_of(*open), (Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  EXPECT_EQ(faces_of(*closed), (Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}));
}

// Six times the volume below a closed surface: positive if its faces look outwards.
double signed_volume(const Soup& soup) {
  double sum = 0;
  for (const std::vector<Index>& face : faces_of(soup)) {
    const float* a = soup.positions()[face[0]];
    const float* b = soup.positions()[face[1]];
    const float* c = soup.positions()[face[2]];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const std::size_t m = (k + 2) % 3;
      sum += static_cast<double>(a[k]) * (static_cast<double>(b[l]) * static_cast<double>(c[m]) -
                                          static_cast<double>(b[m]) * static_cast<double>(c[l]));
    }
  }
  return sum;
}

TEST(Icosphere, LooksOutwardsAndNearsTheVolumeOfABall) {
  const Result<Soup> soup = icosphere(5);
  ASSERT_TRUE(soup);
  EXPECT_EQ(soup->face_count(), 20 * 1024);
  EXPECT_NEAR(signed_volume(*soup) / 6, 4.18879, 0.01);
}

TEST(Torus, LooksOutwardsAndNearsItsVolume) {
  const Result<Soup> soup = torus(96, 48);
  ASSERT_TRUE(soup);
  // 2 pi^2 R r^2 with R = 1 and r = 0.4.
  EXPECT_NEAR(signed_volume(*soup) / 6, 3.15827, 0.03);
}

TEST(Mobius, HasItsInconsistentEdgesOnTheSeamAlone) {
  const Result<Soup> band = mobius(20, 4);
  const Result<Soup> bottle = klein(20, 5);
  ASSERT_TRUE(band && bottle);
  EXPECT_EQ(census(*band).inconsistent_edges, 4);
  EXPECT_EQ(census(*bottle).inconsistent_edges, 5);
}

TEST(Gyroid, IsAnOrientedManifoldWithIrregularValences) {
  const Result<Soup> soup = gyroid(20);
  ASSERT_TRUE(soup);
  const Census found = census(*soup);
  EXPECT_EQ(found.nonmanifold_edges, 0);
  EXPECT_EQ(found.inconsistent_edges, 0);
  EXPECT_GT(found.boundary_loops, 1);
  EXPECT_LT(found.euler, 0);
  std::map<Index, int> corners;
  for (const Index v : soup->corners) ++corners[v];
  std::set<int> valences;
  for (const auto& [v, count] : corners) valences.insert(count);
  EXPECT_GE(valences.size(), 5U);
}

TEST(Terrain, DependsOnItsSeed) {
  const Result<Soup> one = terrain(20, 10, 1);
  const Result<Soup> again = terrain(20, 10, 1);
  const Result<Soup> two = terrain(20, 10, 2);
  ASSERT_TRUE(one && again && two);
  EXPECT_TRUE(std::ranges::equal(one->xyz, again->xyz));
  EXPECT_FALSE(std::ranges::equal(one->xyz, two->xyz));
}

// Faces by the positions of their corners, whatever their numbers.
std::multiset<std::vector<std::array<float, 3>>> placed_faces(const Soup& soup) {
  std::multiset<std::vector<std::array<float, 3>>> placed;
  for (const std::vector<Index>& face : faces_of(soup)) {
    std::vector<std::array<float, 3>> points;
    for (const Index v : face) {
      const float* p = soup.positions()[v];
      points.push_back({p[0], p[1], p[2]});
    }
    placed.insert(points);
  }
  return placed;
}

TEST(Shuffled, KeepsTheSurfaceAndChangesTheOrder) {
  for (const Shape shape : {Shape::grid, Shape::quad_grid, Shape::gyroid}) {
    SCOPED_TRACE(name(shape));
    const Result<Soup> soup = generate(shape, 1000);
    ASSERT_TRUE(soup);
    const Soup one = shuffled(*soup, 7);
    EXPECT_EQ(placed_faces(one), placed_faces(*soup));
    EXPECT_FALSE(std::ranges::equal(one.corners, soup->corners));
    EXPECT_TRUE(std::ranges::equal(one.corners, shuffled(*soup, 7).corners));
    EXPECT_FALSE(std::ranges::equal(one.corners, shuffled(*soup, 8).corners));
  }
}

}  // namespace
}  // namespace hedgerow::shapes
