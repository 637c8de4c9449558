#include "hedgerow/query.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/shapes.h"
#include "support/meshes.h"
#include "support/numbers.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

TEST(Query, CountsTheSidesOfAFaceFromAnyHalfedge) {
  const Connectivity mesh = to_connectivity(reference_of(mixed_row()));
  const PolygonView view = mesh.polygons();
  EXPECT_EQ(degree(view, HalfedgeId(0)), 5);
  EXPECT_EQ(degree(view, HalfedgeId(4)), 5);
  EXPECT_EQ(degree(view, HalfedgeId(10)), 3);
}

TEST(Query, CountsTheSidesOfAHoleFromABoundaryHalfedge) {
  const Connectivity mesh = to_connectivity(reference_closed(reference_of(mixed_row())));
  EXPECT_EQ(degree(mesh.polygons(), HalfedgeId(12)), 8);
}

TEST(Query, CountsNoMissingFaceAsAdjacent) {
  const Connectivity mesh = to_connectivity(reference_of(mixed_row()));
  EXPECT_EQ(adjacent_face_count(mesh.polygons(), FaceId(0)), 1);
  EXPECT_EQ(adjacent_face_count(mesh.polygons(), FaceId(1)), 2);
}

TEST(Query, StartsEachLoopAtItsSmallestHalfedge) {
  const Connectivity mesh = to_connectivity(reference_of(hexagon_of_triangles()));
  const BoundaryLoops loops = boundary_loops(mesh);
  EXPECT_EQ(to_vector(loops.first), (Numbers{0, 6}));
  EXPECT_EQ(to_vector(loops.halfedges), (Numbers{0, 9, 13, 16, 8, 5}));
}

TEST(Query, FindsNoLoopOnAClosedSurface) {
  EXPECT_EQ(boundary_loops(to_connectivity(reference_of(tetrahedron()))).count(), 0);
}

TEST(Query, LabelsComponentsByTheirSmallestVertex) {
  const Connectivity mesh = to_connectivity(reference_of({{{5, 4, 2}, {1, 6, 3}}, 8}));
  const Components components = connected_components(mesh);
  EXPECT_EQ(components.count, 2);
  EXPECT_EQ(to_vector(components.label), (Numbers{-1, 1, 2, 1, 2, 2, 1, -1}));
}

TEST(Query, CountsAnEdgeOfThreeFacesOnce) {
  const Connectivity mesh = to_connectivity(reference_of(three_on_an_edge()));
  const EdgeCounts counts = count_edges(mesh, Execution::serial());
  EXPECT_EQ(counts, (EdgeCounts{7, 6, 1, 0}));
  EXPECT_EQ(count_nonmanifold_vertices(mesh), 0);
  const Summary s = summarise(mesh, Execution::serial());
  EXPECT_FALSE(s.is_manifold());
  EXPECT_FALSE(s.genus);
  EXPECT_EQ(s.valence->max, 4);
}

TEST(Query, CallsABowtieNonManifold) {
  const Connectivity mesh = to_connectivity(reference_of(bowtie()));
  EXPECT_EQ(count_nonmanifold_vertices(mesh), 1);
  EXPECT_FALSE(summarise(mesh, Execution::serial()).boundary_loops);
}

TEST(Query, KnowsTheGenusOfATorusAndOfASphere) {
  PlainFaces torus{{}, 16};
  for (std::int64_t y = 0; y < 4; ++y) {
    for (std::int64_t x = 0; x < 4; ++x) {
      const std::int64_t right = (x + 1) % 4;
      const std::int64_t up = (y + 1) % 4;
      torus.faces.push_back({4 * y + x, 4 * y + right, 4 * up + right, 4 * up + x});
    }
  }
  const Execution serial = Execution::serial();
  EXPECT_EQ(genus(to_connectivity(reference_of(torus)), serial), 1);
  EXPECT_EQ(euler_characteristic(to_connectivity(reference_of(torus)), serial), 0);
  EXPECT_EQ(genus(to_connectivity(reference_of(tetrahedron())), serial), 0);
  EXPECT_EQ(genus(to_connectivity(reference_of(hexagon_of_triangles())), serial), 0);
}

// Every run of faces joins a part, and only the trees of all runs together join everything.
TEST(Query, LabelsComponentsTheSameForEveryThreadCount) {
  const Soup grid = *shapes::grid(60, 40);
  const Soup gyroid = *shapes::generate(shapes::Shape::gyroid, 20'000);
  const Soup fan = *shapes::fan(5000);
  for (const Soup* soup : {&grid, &gyroid, &fan}) {
    for (const Soup& faces : {shapes::shuffled(*soup, 1), shapes::shuffled(*soup, 2)}) {
      const auto output = build(faces.face_list(), {}, Execution::serial());
      ASSERT_TRUE(output);
      const Components serial = connected_components(output->mesh);
      for (const int count : kThreadCounts) {
        Threads threads(count);
        for (const Index grain : {1, 100}) {
          const Components parallel = connected_components(output->mesh, threads.execution(grain));
          EXPECT_EQ(to_vector(parallel.label), to_vector(serial.label)) << count;
          EXPECT_EQ(parallel.count, serial.count) << count;
        }
      }
    }
  }
}

TEST(Query, LabelsInMemoryOfTheCallerOrNotAtAll) {
  const auto output = build(shapes::grid(30, 20)->face_list(), {}, Execution::serial());
  ASSERT_TRUE(output);
  const Connectivity& mesh = output->mesh;
  const auto vertex_count = static_cast<std::size_t>(mesh.vertex_count());
  const Components expected = connected_components(mesh);
  Threads threads(4);
  const Execution four_runs = threads.execution(100);
  std::vector<Index> labels(vertex_count, -7);

  std::array<std::byte, 64> little{};
  Workspace fixed(little);
  const auto too_little = connected_components(mesh, labels, four_runs, fixed);
  ASSERT_FALSE(too_little);
  EXPECT_EQ(too_little.error().code, ErrorCode::scratch_too_small);
  EXPECT_GT(too_little.error().limit, 3 * static_cast<std::int64_t>(vertex_count * sizeof(Index)));
  const auto too_few =
      connected_components(mesh, std::span(labels).first(vertex_count - 1), four_runs, fixed);
  ASSERT_FALSE(too_few);
  EXPECT_EQ(too_few.error().code, ErrorCode::count_mismatch);
  EXPECT_EQ(labels, std::vector<Index>(vertex_count, -7));

  std::vector<std::byte> enough(static_cast<std::size_t>(too_little.error().limit) + 63);
  Workspace exact(enough);
  const auto count = connected_components(mesh, labels, four_runs, exact);
  ASSERT_TRUE(count);
  EXPECT_EQ(*count, expected.count);
  EXPECT_EQ(labels, to_vector(expected.label));
}

// Faces in an order that hangs each root below the next: were walks to the root not cut short, they
// would be as long as the path, and this test would not end. The last face keeps the numbers of the
// vertices from showing that all are connected.
TEST(Query, LabelsALongPathFromItsEnd) {
  constexpr Index kCount = 400'000;
  std::vector<Index> corners;
  for (Index f = kCount - 3; f >= 0; --f) corners.insert(corners.end(), {f, f + 1, f + 2});
  corners.insert(corners.end(), {kCount, kCount + 1, kCount + 2});
  const auto faces = FaceList::triangles<Index>(corners, kCount + 3);
  const auto output = build(faces, {}, Execution::serial());
  ASSERT_TRUE(output);
  const Components components = connected_components(output->mesh);
  EXPECT_EQ(components.count, 2);
  Numbers expected(at(kCount), 0);
  expected.insert(expected.end(), 3, kCount);
  EXPECT_EQ(to_vector(components.label), expected);
}

TEST(Query, CountsFacesOfExactlyZeroArea) {
  const std::vector<float> xyz = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0};
  const Connectivity mesh = to_connectivity(reference_of({{{0, 1, 2}, {0, 1, 3}}, 4}));
  const auto count = count_zero_area_faces(mesh, {xyz.data(), 4}, Execution::serial());
  ASSERT_TRUE(count);
  EXPECT_EQ(*count, 1);
  const auto few = count_zero_area_faces(mesh, {xyz.data(), 3}, Execution::serial());
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().code, ErrorCode::count_mismatch);
  const auto uneven = count_zero_area_faces(mesh, {xyz.data(), 4, 14}, Execution::serial());
  ASSERT_FALSE(uneven);
  EXPECT_EQ(uneven.error().code, ErrorCode::bad_stride);
  const auto absent = count_zero_area_faces(mesh, {nullptr, 4}, Execution::serial());
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::null_pointer);
}

TEST(Query, CountsDegenerateFacesOnlyWhereTheyWereDropped) {
  BuildStats stats;
  stats.defect_count[static_cast<std::size_t>(DefectKind::too_few_corners)] = 2;
  stats.defect_count[static_cast<std::size_t>(DefectKind::repeated_vertex)] = 3;
  Policies policies;
  EXPECT_EQ(count_degenerate_faces(stats, policies), 5);
  policies[DefectKind::repeated_vertex] = Action::split;
  EXPECT_EQ(count_degenerate_faces(stats, policies), 2);
}

template <class View>
void expect_boundary_flags(const View& view, const ReferenceMesh& open) {
  std::vector<bool> on_boundary(at(open.vertex_count()), false);
  for (Index h = 0; h < open.halfedge_count(); ++h) {
    const bool is_open = open.opposite[at(h)] == kInvalidIndex;
    EXPECT_EQ(is_boundary_edge(view, HalfedgeId(h)), is_open);
    if (!is_open) continue;
    on_boundary[at(open.origin[at(h)])] = true;
    on_boundary[at(open.origin[at(open.next[at(h)])])] = true;
  }
  for (Index v = 0; v < open.vertex_count(); ++v) {
    EXPECT_EQ(is_boundary(view, VertexId(v)), on_boundary[at(v)]);
  }
  for (Index f = 0; f < open.face_count(); ++f) {
    Index paired = 0;
    for (Index h = open.first[at(f)]; h < open.first[at(f + 1)]; ++h) {
      paired += open.opposite[at(h)] != kInvalidIndex;
    }
    EXPECT_EQ(adjacent_face_count(view, FaceId(f)), paired);
    EXPECT_EQ(is_boundary(view, FaceId(f)), paired < view.degree(FaceId(f)));
  }
}

void expect_summary(const Summary& s, const ReferenceSummary& expected) {
  const EdgeCounts edges{expected.edges, expected.boundary_edges, expected.nonmanifold_edges,
                         expected.inconsistent_edges};
  EXPECT_EQ(s.edge_counts, edges);
  EXPECT_EQ(s.isolated_vertices, expected.isolated_vertices);
  EXPECT_EQ(s.nonmanifold_vertices, expected.nonmanifold_vertices);
  EXPECT_EQ(s.duplicate_faces, expected.duplicate_faces);
  EXPECT_EQ(s.components, expected.components);
  EXPECT_EQ(s.euler, expected.euler);
  EXPECT_EQ(s.boundary_loops, expected.boundary_loops);
  EXPECT_EQ(s.genus, expected.genus);
  ASSERT_EQ(s.valence.has_value(), expected.valence_max > 0);
  if (!s.valence) return;
  EXPECT_EQ(s.valence->min, expected.valence_min);
  EXPECT_EQ(s.valence->max, expected.valence_max);
  const auto used = static_cast<double>(s.vertices - s.isolated_vertices);
  EXPECT_DOUBLE_EQ(s.valence->mean * used, 2.0 * static_cast<double>(expected.edges));
}

// Loops of the closed form are those of the default form seen from the other side.
void expect_loops(const BoundaryLoops& open, const BoundaryLoops& closed,
                  const ReferenceMesh& closed_mesh) {
  ASSERT_EQ(to_vector(open.first), to_vector(closed.first));
  for (Index i = 0; i < open.count(); ++i) {
    Numbers across;
    for (Index k = closed.first[at(i)]; k < closed.first[at(i + 1)]; ++k) {
      across.push_back(closed_mesh.opposite[at(closed.halfedges[at(k)])]);
    }
    // The smallest half-edge begins both; the others come in the opposite order.
    std::reverse(across.begin() + 1, across.end());
    const Numbers sides(open.halfedges.begin() + open.first[at(i)],
                        open.halfedges.begin() + open.first[at(i + 1)]);
    EXPECT_EQ(sides, across);
    EXPECT_EQ(sides[0], *std::min_element(sides.begin(), sides.end()));
  }
}

class QueryOracle : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(QueryOracle, AgreesOnRandomMeshesInBothFormsAndViews) {
  const Execution parallel = Execution::current_arena().with_grain(3);
  Threads eight(8);
  for (std::uint64_t i = 0; i < 250 && !HasFailure(); ++i) {
    const std::uint64_t seed = 250 * GetParam() + i;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    const ReferenceMesh closed = reference_closed(open);
    const Connectivity mesh = to_connectivity(open);
    const Connectivity closed_mesh = to_connectivity(closed);
    mesh.visit([&](const auto& view) { expect_boundary_flags(view, open); });
    expect_boundary_flags(closed_mesh.polygons(), open);
    const ReferenceSummary expected = reference_summary(open);
    expect_summary(summarise(mesh, Execution::serial()), expected);
    expect_summary(summarise(mesh, parallel), expected);
    expect_summary(summarise(mesh, eight.execution(3)), expected);
    expect_summary(summarise(closed_mesh, parallel), expected);
    const Numbers labels = reference_components(open);
    for (const Execution& execution : {Execution::serial(), parallel, eight.execution(3)}) {
      EXPECT_EQ(to_vector(connected_components(mesh, execution).label), labels);
      EXPECT_EQ(to_vector(connected_components(closed_mesh, execution).label), labels);
    }
    expect_loops(boundary_loops(mesh), boundary_loops(closed_mesh), closed);
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, QueryOracle, ::testing::Range<std::uint64_t>(0, 8));

}  // namespace
}  // namespace hedgerow::test
