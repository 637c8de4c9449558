// The parallel operations on plain threads.

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/build.h"
#include "hedgerow/corner_table.h"
#include "hedgerow/dcel.h"
#include "hedgerow/delaunay.h"
#include "hedgerow/directed_edge.h"
#include "hedgerow/normals.h"
#include "hedgerow/query.h"
#include "hedgerow/split_edge.h"
#include "hedgerow/triangulate.h"
#include "hedgerow/validate.h"
#include "support/plain_threads.h"

namespace hedgerow {
namespace {

struct Faces {
  std::vector<Index> corners;
  std::vector<Index> offsets;  // empty: triangles
  Index vertex_count = 0;

  [[nodiscard]] FaceList list() const {
    return offsets.empty() ? FaceList::triangles<Index>(corners, vertex_count)
                           : FaceList::polygons<Index>(corners, offsets, vertex_count);
  }
};

// n x n squares, each cut in two.
Faces grid(Index n) {
  Faces faces;
  faces.vertex_count = (n + 1) * (n + 1);
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const Index v = y * (n + 1) + x;
      const Index above = v + n + 1;
      faces.corners.insert(faces.corners.end(), {v, v + 1, above, v + 1, above + 1, above});
    }
  }
  return faces;
}

Faces quad_grid(Index n) {
  Faces faces;
  faces.vertex_count = (n + 1) * (n + 1);
  faces.offsets.push_back(0);
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const Index v = y * (n + 1) + x;
      faces.corners.insert(faces.corners.end(), {v, v + 1, v + n + 2, v + n + 1});
      faces.offsets.push_back(static_cast<Index>(faces.corners.size()));
    }
  }
  return faces;
}

// The same faces in random order, so that every block of vertices meets faces from everywhere.
Faces shuffled(const Faces& faces) {
  std::vector<std::array<Index, 3>> triangles(faces.corners.size() / 3);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    std::copy_n(faces.corners.data() + 3 * f, 3, triangles[f].begin());
  }
  std::shuffle(triangles.begin(), triangles.end(), std::mt19937(1));
  Faces result;
  result.vertex_count = faces.vertex_count;
  for (const auto& triangle : triangles) {
    result.corners.insert(result.corners.end(), triangle.begin(), triangle.end());
  }
  return result;
}

// Random corners: hardly an edge is manifold, and some faces are degenerate.
Faces tangle(Index face_count) {
  Faces faces;
  faces.vertex_count = face_count / 4;
  std::mt19937 random(2);
  std::uniform_int_distribution<Index> vertex(0, faces.vertex_count - 1);
  for (Index i = 0; i < 3 * face_count; ++i) faces.corners.push_back(vertex(random));
  return faces;
}

Faces faces_of(int kind) {
  switch (kind) {
    case 0:
      return grid(120);
    case 1:
      return quad_grid(120);
    case 2:
      return shuffled(grid(120));
    default:
      return tangle(20'000);
  }
}

template <class T>
void expect_same(std::span<T> a, std::span<T> b) {
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
}

void expect_same(const Connectivity& a, const Connectivity& b) {
  expect_same(a.origin(), b.origin());
  expect_same(a.opposite(), b.opposite());
  expect_same(a.outgoing(), b.outgoing());
  expect_same(a.fans(), b.fans());
}

class Races : public ::testing::TestWithParam<int> {
 protected:
  const Faces faces_ = faces_of(GetParam());
};

class BuildRaces : public ::testing::TestWithParam<std::tuple<int, BuildStrategy, Action>> {};

TEST_P(BuildRaces, LeaveNoTraceInTheResult) {
  const auto [kind, strategy, action] = GetParam();
  const Faces faces = faces_of(kind);
  BuildOptions options;
  options.strategy = strategy;
  options.policies[DefectKind::nonmanifold_edge] = action;
  options.policies[DefectKind::inconsistent_edge] = action;
  const auto serial = build(faces.list(), options, Execution::serial());
  const auto parallel = build(faces.list(), options, plain_threads());
  ASSERT_TRUE(serial && parallel);
  expect_same(parallel->mesh, serial->mesh);
  expect_same(std::as_const(parallel->defects).span(), std::as_const(serial->defects).span());
}

INSTANTIATE_TEST_SUITE_P(InputsAndStrategies, BuildRaces,
                         ::testing::Combine(::testing::Range(0, 4),
                                            ::testing::Values(BuildStrategy::window,
                                                              BuildStrategy::partition),
                                            ::testing::Values(Action::cut, Action::split)));

TEST_P(Races, LeaveNoTraceInMaterialisedColumns) {
  auto serial = build(faces_.list(), {}, Execution::serial());
  auto parallel = build(faces_.list(), {}, Execution::serial());
  ASSERT_TRUE(serial && parallel);
  serial->mesh.materialise(Execution::serial());
  parallel->mesh.materialise(plain_threads().with_grain(64));
  const PolygonView a = serial->mesh.polygons();
  const PolygonView b = parallel->mesh.polygons();
  for (HalfedgeId h(0); h.value < a.halfedge_count(); ++h.value) {
    ASSERT_EQ(a.next(h), b.next(h));
    ASSERT_EQ(a.face(h), b.face(h));
  }
}

TEST_P(Races, LeaveNoTraceInTheBoundaryForms) {
  const auto built = build(faces_.list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  const auto serial = close_boundary(built->mesh, Execution::serial());
  const auto parallel = close_boundary(built->mesh, plain_threads());
  ASSERT_TRUE(serial && parallel);
  expect_same(*parallel, *serial);
  const auto opened = open_boundary(*parallel, plain_threads());
  ASSERT_TRUE(opened);
  expect_same(*opened, built->mesh);
}

// Backward links are written by the half-edges that they lead to.
TEST_P(Races, LeaveNoTraceInRecords) {
  const auto built = build(faces_.list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  const Execution threads = plain_threads().with_grain(64);
  const auto dcel = build_dcel(built->mesh, Execution::serial());
  const auto dcel_of_threads = build_dcel(built->mesh, threads);
  ASSERT_TRUE(dcel && dcel_of_threads);
  expect_same(dcel_of_threads->halfedges.span(), dcel->halfedges.span());
  const auto ends = build_split_edges(built->mesh, Execution::serial());
  const auto ends_of_threads = build_split_edges(built->mesh, threads);
  ASSERT_TRUE(ends && ends_of_threads);
  expect_same(ends_of_threads->ends.span(), ends->ends.span());
  if (!built->mesh.is_triangle_mesh()) return;
  const auto corners = build_corner_table(built->mesh, threads);
  ASSERT_TRUE(corners);
  const auto back = build_connectivity(*corners, threads);
  ASSERT_TRUE(back);
  expect_same(*back, built->mesh);
  const auto edges = build_directed_edges(built->mesh, threads);
  ASSERT_TRUE(edges);
  const auto mesh = build_connectivity(*edges, threads);
  ASSERT_TRUE(mesh);
  expect_same(*mesh, built->mesh);
}

TEST_P(Races, LeaveNoTraceInValidationAndCounts) {
  const auto built = build(faces_.list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  EXPECT_TRUE(validate(built->mesh, plain_threads()).empty());
  EXPECT_EQ(count_edges(built->mesh, plain_threads()),
            count_edges(built->mesh, Execution::serial()));
}

TEST_P(Races, LeaveNoTraceInComponents) {
  const auto built = build(faces_.list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  const Components alone = connected_components(built->mesh);
  const Components together = connected_components(built->mesh, plain_threads().with_grain(500));
  EXPECT_EQ(together.count, alone.count);
  expect_same(together.label.span(), alone.label.span());
}

TEST_P(Races, LeaveNoTraceInNormals) {
  const auto built = build(faces_.list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  const Connectivity& mesh = built->mesh;
  const auto vertex_count = static_cast<std::size_t>(mesh.vertex_count());
  std::vector<float> xyz(3 * vertex_count);
  std::mt19937 random(3);
  for (float& x : xyz) x = static_cast<float>(random() % 1000);
  const Positions positions{xyz.data(), mesh.vertex_count()};
  const auto face_count = static_cast<std::size_t>(mesh.face_count());

  using Normals = std::array<std::vector<float>, 3>;
  const auto compute = [&](const Execution& execution) {
    Normals normals = {std::vector<float>(3 * face_count), std::vector<float>(3 * vertex_count),
                       std::vector<float>(3 * vertex_count)};
    Workspace workspace;
    const NormalOptions options{.weight = NormalWeight::angle};
    EXPECT_TRUE(
        face_normals(mesh, positions, {normals[0].data(), mesh.face_count()}, options, execution));
    EXPECT_TRUE(gather_vertex_normals(mesh, positions, {normals[1].data(), mesh.vertex_count()},
                                      options, execution, workspace));
    EXPECT_TRUE(scatter_vertex_normals(face_list(mesh), positions,
                                       {normals[2].data(), mesh.vertex_count()}, options, execution,
                                       workspace));
    return normals;
  };
  const Normals serial = compute(Execution::serial());
  EXPECT_EQ(compute(plain_threads()), serial);
  EXPECT_EQ(compute(plain_threads().with_grain(64)), serial);
  EXPECT_EQ(serial[1], serial[2]);
}

INSTANTIATE_TEST_SUITE_P(Inputs, Races, ::testing::Range(0, 4));

TEST(PlanarRaces, TriangulatesAsOneThreadDoes) {
  std::mt19937 random(4);
  std::vector<Point2> points(20'000);
  for (Point2& p : points) {
    p = {static_cast<double>(random() % 1000), static_cast<double>(random() % 1000)};
  }
  const auto serial = triangulate(points, Execution::serial());
  const auto shared = triangulate(points, plain_threads().with_grain(500));
  ASSERT_TRUE(serial && shared);
  expect_same(serial->mesh, shared->mesh);
  expect_same(serial->same_as.span(), shared->same_as.span());
}

TEST(PlanarRaces, FlipsAsOneThreadDoes) {
  const auto built = build(grid(120).list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  std::mt19937 random(5);
  std::vector<float> xyz(3 * static_cast<std::size_t>(built->mesh.vertex_count()));
  for (std::size_t v = 0; v < xyz.size() / 3; ++v) {
    xyz[3 * v] = static_cast<float>(v % 121);
    xyz[3 * v + 1] = static_cast<float>(v / 121);
    xyz[3 * v + 2] = static_cast<float>(random() % 3);
  }
  const Positions positions{xyz.data(), built->mesh.vertex_count()};
  const auto flipped = [&](const Execution& execution) {
    Result<EditMesh> mesh = EditMesh::of(built->mesh, Execution::serial());
    const auto report = flip_to_delaunay(*mesh, positions, {}, execution);
    EXPECT_TRUE(report.has_value());
    EXPECT_GT(report->flips, 1000);
    EXPECT_EQ(report->left, 0);
    return std::move(mesh->compact()->mesh);
  };
  expect_same(flipped(Execution::serial()), flipped(plain_threads().with_grain(100)));
}

}  // namespace
}  // namespace hedgerow
