#include "hedgerow/build.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace hedgerow {
namespace {

using Corners = std::vector<Index>;

Result<BuildOutput> build_triangles(const Corners& corners, Index vertex_count,
                                    const Policies& policies = {}) {
  BuildOptions options;
  options.policies = policies;
  return build(FaceList::triangles<Index>(corners, vertex_count), options, Execution::serial());
}

Result<BuildOutput> build_polygons(const Corners& corners, const Corners& offsets,
                                   Index vertex_count, const Policies& policies = {}) {
  BuildOptions options;
  options.policies = policies;
  return build(FaceList::polygons<Index>(corners, offsets, vertex_count), options,
               Execution::serial());
}

Policies with(DefectKind kind, Action action) {
  Policies policies;
  policies[kind] = action;
  return policies;
}

Corners as_vector(std::span<const Index> values) { return {values.begin(), values.end()}; }

std::int64_t count_of(const BuildOutput& output, DefectKind kind) {
  return output.stats.defect_count[static_cast<std::size_t>(kind)];
}

const Corners kTetrahedron = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
const Corners kThreeOnAnEdge = {0, 1, 2, 1, 0, 3, 0, 1, 4};
const Corners kBowtie = {0, 1, 2, 0, 3, 4};
const Corners kDoubleWinding = {0, 1, 2, 0, 2, 1};

TEST(Build, PairsTwoTrianglesAcrossTheirEdge) {
  const auto output = build_triangles({0, 1, 2, 2, 1, 3}, 4);
  ASSERT_TRUE(output);
  EXPECT_EQ(as_vector(output->mesh.opposite()), (Corners{-1, 3, -1, 1, -1, -1}));
  EXPECT_EQ(output->stats.edge_count, 5);
  EXPECT_EQ(output->stats.boundary_edge_count, 4);
  EXPECT_TRUE(output->defects.empty());
}

TEST(Build, StartsTheRotationOfABoundaryVertexAtTheEndThatReachesAll) {
  // Vertex 1 has half-edges 1 (1 to 2) and 4 (1 to 3); only from 4 does next[opposite[.]] reach
  // both.
  const auto output = build_triangles({0, 1, 2, 2, 1, 3}, 4);
  ASSERT_TRUE(output);
  EXPECT_EQ(as_vector(output->mesh.outgoing()), (Corners{0, 1, 3, 5}));
  const TriangleView mesh = output->mesh.triangles();
  EXPECT_EQ(mesh.next(mesh.opposite[HalfedgeId(1)]), HalfedgeId(4));
}

TEST(Build, PairsAClosedMeshWithoutBoundary) {
  const auto output = build_triangles(kTetrahedron, 4);
  ASSERT_TRUE(output);
  EXPECT_EQ(std::ranges::count(output->mesh.opposite(), kInvalidIndex), 0);
  EXPECT_EQ(output->stats.edge_count, 6);
  EXPECT_EQ(as_vector(output->mesh.outgoing()), (Corners{0, 1, 2, 4}));
}

TEST(Build, CostsAtMost27BytesATriangle) {
  const auto output = build_triangles(kTetrahedron, 4);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->mesh.bytes(), (12 + 12 + 4) * sizeof(Index));
  EXPECT_FALSE(output->mesh.is_explicit());
}

TEST(Build, KeepsPolygonsAndStoresTheirColumns) {
  const auto output = build_polygons({0, 1, 2, 3, 3, 2, 4}, {0, 4, 7}, 5);
  ASSERT_TRUE(output);
  const PolygonView mesh = output->mesh.polygons();
  EXPECT_EQ(mesh.degree(FaceId(0)), 4);
  EXPECT_EQ(mesh.next(HalfedgeId(3)), HalfedgeId(0));
  EXPECT_EQ(mesh.prev(HalfedgeId(4)), HalfedgeId(6));
  EXPECT_EQ(mesh.opposite[HalfedgeId(2)], HalfedgeId(4));
  EXPECT_EQ(mesh.face(HalfedgeId(6)), FaceId(1));
}

TEST(Build, TakesAPolygonListOfTrianglesAsTriangles) {
  const auto output = build_polygons({0, 1, 2, 2, 1, 3}, {0, 3, 6}, 4);
  ASSERT_TRUE(output);
  EXPECT_TRUE(output->mesh.is_implicit());
}

TEST(Build, AcceptsNoFacesAndNoVertices) {
  const auto nothing = build_triangles({}, 0);
  ASSERT_TRUE(nothing);
  EXPECT_EQ(nothing->mesh.face_count(), 0);
  const auto points = build_triangles({}, 3);
  ASSERT_TRUE(points);
  EXPECT_EQ(count_of(*points, DefectKind::isolated_vertex), 3);
  EXPECT_EQ(as_vector(points->mesh.outgoing()), (Corners{-1, -1, -1}));
}

TEST(Build, IsNotNeededForAMeshWithoutElements) {
  const Connectivity nothing;
  EXPECT_EQ(nothing.visit([](const auto& mesh) { return mesh.halfedge_count(); }), 0);
}

TEST(Build, ListsTheSecondFanOfABowtie) {
  const auto output = build_triangles(kBowtie, 5);
  ASSERT_TRUE(output);
  ASSERT_EQ(output->mesh.fans().size(), 1U);
  EXPECT_EQ(output->mesh.fans()[0], (FanStart{VertexId(0), HalfedgeId(3)}));
  ASSERT_EQ(output->defects.size(), 1U);
  EXPECT_EQ(output->defects[0].kind, DefectKind::nonmanifold_vertex);
  EXPECT_EQ(output->defects[0].vertex, VertexId(0));
  EXPECT_EQ(output->defects[0].value, 2);
}

TEST(Build, CutsANonManifoldEdgeAndNamesIt) {
  const auto output = build_triangles(kThreeOnAnEdge, 5);
  ASSERT_TRUE(output);
  EXPECT_EQ(std::ranges::count(output->mesh.opposite(), kInvalidIndex), 9);
  ASSERT_EQ(output->defects.size(), 1U);
  const Defect defect = output->defects[0];
  EXPECT_EQ(defect, (Defect{DefectKind::nonmanifold_edge, FaceId(0), HalfedgeId(0), VertexId(0),
                            VertexId(1), 3}));
  EXPECT_EQ(output->stats.edge_count, 7);
  // The faces hang together across the edge, so its ends are manifold vertices with three fans.
  EXPECT_EQ(output->mesh.fans().size(), 4U);
}

TEST(Build, FailsOnANonManifoldEdgeIfAsked) {
  const auto output =
      build_triangles(kThreeOnAnEdge, 5, with(DefectKind::nonmanifold_edge, Action::fail));
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().code, ErrorCode::nonmanifold_edge);
  EXPECT_EQ(output.error().element, 0);
  EXPECT_EQ(output.error().value, 3);
  EXPECT_EQ(output.error().limit, 2);
}

TEST(Build, SkipsTheFacesThatAreTooMany) {
  const auto output =
      build_triangles(kThreeOnAnEdge, 5, with(DefectKind::nonmanifold_edge, Action::skip));
  ASSERT_TRUE(output);
  EXPECT_EQ(output->mesh.face_count(), 2);
  EXPECT_EQ(as_vector(output->faces_new_to_old.span()), (Corners{0, 1}));
  EXPECT_EQ(output->mesh.opposite()[0], 3);
}

TEST(Build, SplitsTheEndsOfANonManifoldEdge) {
  const auto output =
      build_triangles(kThreeOnAnEdge, 5, with(DefectKind::nonmanifold_edge, Action::split));
  ASSERT_TRUE(output);
  EXPECT_TRUE(output->mesh.fans().empty());
  EXPECT_EQ(output->mesh.vertex_count(), 9);
  EXPECT_EQ(as_vector(output->vertices_new_to_old.span()), (Corners{0, 1, 2, 3, 4, 0, 0, 1, 1}));
  EXPECT_EQ(output->stats.edge_count, 9);
}

TEST(Build, CutsAnInconsistentEdge) {
  const auto output = build_triangles({0, 1, 2, 0, 1, 3}, 4);
  ASSERT_TRUE(output);
  ASSERT_EQ(output->defects.size(), 1U);
  EXPECT_EQ(output->defects[0].kind, DefectKind::inconsistent_edge);
  EXPECT_EQ(output->mesh.opposite()[0], kInvalidIndex);
  const auto skipped =
      build_triangles({0, 1, 2, 0, 1, 3}, 4, with(DefectKind::inconsistent_edge, Action::skip));
  ASSERT_TRUE(skipped);
  EXPECT_EQ(as_vector(skipped->faces_new_to_old.span()), (Corners{0}));
}

TEST(Build, SplitsABowtieIntoTwoVertices) {
  const auto output =
      build_triangles(kBowtie, 5, with(DefectKind::nonmanifold_vertex, Action::split));
  ASSERT_TRUE(output);
  EXPECT_EQ(as_vector(output->mesh.origin()), (Corners{0, 1, 2, 5, 3, 4}));
  EXPECT_TRUE(output->mesh.fans().empty());
}

TEST(Build, SkipsAllFansOfABowtieButTheFirst) {
  const auto output =
      build_triangles(kBowtie, 5, with(DefectKind::nonmanifold_vertex, Action::skip));
  ASSERT_TRUE(output);
  EXPECT_EQ(as_vector(output->faces_new_to_old.span()), (Corners{0}));
}

TEST(Build, FindsDuplicateFacesInBothWindings) {
  const auto both = build_triangles(kDoubleWinding, 3);
  ASSERT_TRUE(both);
  ASSERT_EQ(count_of(*both, DefectKind::duplicate_face), 1);
  EXPECT_EQ(both->defects[0].face, FaceId(1));
  EXPECT_EQ(both->defects[0].value, 0);
  EXPECT_EQ(std::ranges::count(both->mesh.opposite(), kInvalidIndex), 0);
  const auto same = build_triangles({0, 1, 2, 5, 3, 4, 1, 2, 0, 2, 0, 1}, 6);
  ASSERT_TRUE(same);
  EXPECT_EQ(count_of(*same, DefectKind::duplicate_face), 2);
}

TEST(Build, FindsPolygonsWithTheSameVerticesInAnotherOrder) {
  const auto output = build_polygons({0, 1, 2, 3, 0, 2, 1, 3}, {0, 4, 8}, 4);
  ASSERT_TRUE(output);
  EXPECT_EQ(count_of(*output, DefectKind::duplicate_face), 1);
}

TEST(Build, AppliesEachPolicyToDuplicateFaces) {
  const auto apply = [](Action action) {
    return build_triangles(kDoubleWinding, 3, with(DefectKind::duplicate_face, action));
  };
  EXPECT_EQ(apply(Action::fail).error().code, ErrorCode::duplicate_face);
  EXPECT_EQ(apply(Action::skip)->mesh.face_count(), 1);
  EXPECT_EQ(std::ranges::count(apply(Action::cut)->mesh.opposite(), kInvalidIndex), 6);
  EXPECT_EQ(apply(Action::cut)->stats.edge_count, 3);
  EXPECT_EQ(apply(Action::split)->mesh.vertex_count(), 6);
  EXPECT_EQ(apply(Action::keep)->mesh.face_count(), 2);
}

TEST(Build, RefusesAnIndexThatIsOutOfRange) {
  const auto output = build_triangles({0, 1, 2, 0, 7, 2, -5, 1, 2}, 3);
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().code, ErrorCode::index_out_of_range);
  EXPECT_EQ(output.error().element, 1);
  EXPECT_EQ(output.error().value, 7);
  EXPECT_EQ(output.error().limit, 3);
  EXPECT_EQ(output.error().count, 2);
}

TEST(Build, NamesAnIndexThatNoSignedIndexCanHold) {
  const std::vector<std::uint32_t> corners = {0, 1, 4'000'000'000U};
  const auto output =
      build(FaceList::triangles<std::uint32_t>(corners, 3), {}, Execution::serial());
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().value, 4'000'000'000);
}

TEST(Build, SkipsFacesThatConnectivityCannotHold) {
  Policies policies = with(DefectKind::out_of_range, Action::skip);
  const auto output =
      build_polygons({0, 1, 2, 0, 1, 9, 1, 2, 1, 2, 1, 0, 2}, {0, 3, 6, 8, 11, 13}, 3, policies);
  ASSERT_TRUE(output);
  EXPECT_EQ(as_vector(output->faces_new_to_old.span()), (Corners{0}));
  EXPECT_EQ(count_of(*output, DefectKind::out_of_range), 1);
  EXPECT_EQ(count_of(*output, DefectKind::too_few_corners), 2);
  EXPECT_EQ(count_of(*output, DefectKind::repeated_vertex), 1);
}

TEST(Build, SplitsAVertexThatAFaceRepeats) {
  const auto output =
      build_polygons({0, 1, 2, 0, 3}, {0, 5}, 4, with(DefectKind::repeated_vertex, Action::split));
  ASSERT_TRUE(output);
  EXPECT_EQ(as_vector(output->mesh.origin()), (Corners{0, 1, 2, 4, 3}));
  EXPECT_EQ(as_vector(output->vertices_new_to_old.span()), (Corners{0, 1, 2, 3, 0}));
}

TEST(Build, FindsARepeatedVertexInAPolygonOf100000Corners) {
  Corners polygon(100'000);
  std::iota(polygon.begin(), polygon.end(), 0);
  EXPECT_EQ(build_polygons(polygon, {0, 100'000}, 100'000)->mesh.face_count(), 1);
  polygon.back() = 77;
  const auto output = build_polygons(polygon, {0, 100'000}, 100'000);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->mesh.face_count(), 0);
  EXPECT_EQ(output->defects[0].vertex, VertexId(77));
}

TEST(Build, DropsIsolatedVerticesIfAsked) {
  const auto output =
      build_triangles({1, 3, 4}, 6, with(DefectKind::isolated_vertex, Action::skip));
  ASSERT_TRUE(output);
  EXPECT_EQ(as_vector(output->mesh.origin()), (Corners{0, 1, 2}));
  EXPECT_EQ(as_vector(output->vertices_new_to_old.span()), (Corners{1, 3, 4}));
}

TEST(Build, RefusesAPolicyThatHasNoMeaning) {
  const auto output =
      build_triangles(kTetrahedron, 4, with(DefectKind::out_of_range, Action::split));
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().code, ErrorCode::unsupported_policy);
}

TEST(Build, RefusesCountsThatDoNotFitBeforeLookingAtTheFaces) {
  FaceList faces;
  faces.corners = &faces;
  faces.stride_bytes = 3 * sizeof(Index);
  faces.face_count = static_cast<std::int64_t>(kMaxCount / 3) + 1;
  const auto output = build(faces, {}, Execution::serial());
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().code, ErrorCode::too_many_elements);
}

TEST(Build, RefusesOffsetsThatDecrease) {
  const auto output = build_polygons({0, 1, 2, 0, 2, 3}, {0, 4, 3}, 4);
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().code, ErrorCode::bad_face_offsets);
  EXPECT_EQ(output.error().element, 1);
}

template <class Integer>
Corners opposites_from(std::size_t record) {
  // Each triangle is followed by `record - 3` numbers that are none of our business.
  std::vector<Integer> values;
  for (std::size_t i = 0; i < kTetrahedron.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) values.push_back(static_cast<Integer>(kTetrahedron[i + k]));
    values.resize(values.size() + record - 3, Integer{99});
  }
  FaceList faces = FaceList::triangles<Integer>(values, 4);
  faces.face_count = 4;
  faces.stride_bytes = record * sizeof(Integer);
  return as_vector(build(faces, {}, Execution::serial())->mesh.opposite());
}

TEST(Build, ReadsEveryIndexFormatAndStride) {
  const Corners expected = as_vector(build_triangles(kTetrahedron, 4)->mesh.opposite());
  for (const std::size_t record : {3U, 4U, 7U}) {
    EXPECT_EQ(opposites_from<std::uint16_t>(record), expected);
    EXPECT_EQ(opposites_from<std::int32_t>(record), expected);
    EXPECT_EQ(opposites_from<std::uint32_t>(record), expected);
    EXPECT_EQ(opposites_from<std::int64_t>(record), expected);
  }
}

TEST(Build, ViewsTheIndexBufferWhenItMayBorrow) {
  BuildOptions options;
  options.borrow_corners = true;
  const auto output =
      build(FaceList::triangles<Index>(kTetrahedron, 4), options, Execution::serial());
  ASSERT_TRUE(output);
  EXPECT_EQ(output->mesh.origin().data(), kTetrahedron.data());
  EXPECT_TRUE(output->mesh.borrows_origin());
}

TEST(Build, TakesOverABufferWithoutCopyingIt) {
  Buffer<Index> corners = Buffer<Index>::copy_of(kTetrahedron);
  const Index* address = corners.data();
  const auto output = build(std::move(corners), {}, 4, {}, Execution::serial());
  ASSERT_TRUE(output);
  EXPECT_EQ(output->mesh.origin().data(), address);
  EXPECT_FALSE(output->mesh.borrows_origin());
}

TEST(Build, LeavesTheBufferAloneWhenItFails) {
  Buffer<Index> corners = Buffer<Index>::copy_of(std::vector<Index>{0, 1, 5});
  ASSERT_FALSE(build(std::move(corners), {}, 3, {}, Execution::serial()));
  EXPECT_EQ(as_vector(corners.span()), (Corners{0, 1, 5}));  // NOLINT(bugprone-use-after-move)
}

Corners fan_of(Index triangles, Index hub) {
  Corners corners;
  for (Index i = 0; i < triangles; ++i) {
    const Index a = i < hub ? i : i + 1;
    const Index b = i + 1 < hub ? i + 1 : i + 2;
    corners.insert(corners.end(), {hub, a, b});
  }
  return corners;
}

double steps_per_triangle(Index triangles, Index hub, BuildStrategy strategy) {
  const Corners corners = fan_of(triangles, hub);
  BuildOptions options;
  options.strategy = strategy;
  const auto output =
      build(FaceList::triangles<Index>(corners, triangles + 2), options, Execution::serial());
  EXPECT_EQ(output->stats.boundary_edge_count, triangles + 2);
  EXPECT_EQ(output->stats.edge_count, 2 * triangles + 1);
  return static_cast<double>(output->stats.step_count) / static_cast<double>(triangles);
}

TEST(Build, TakesLinearlyManyStepsOnAFanOfAMillionTriangles) {
  for (const auto strategy : {BuildStrategy::window, BuildStrategy::partition}) {
    for (const Index hub : {Index{0}, Index{500}}) {
      const double few = steps_per_triangle(1'000, hub, strategy);
      const double many = steps_per_triangle(1'000'000, hub, strategy);
      EXPECT_LT(many, 1.5 * few) << few << " steps a triangle at 1,000, " << many
                                 << " at 1,000,000";
      EXPECT_GT(few, 3);
    }
  }
}

}  // namespace
}  // namespace hedgerow
