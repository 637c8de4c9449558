#include "hedgerow/boundary.h"

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "support/meshes.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"

namespace hedgerow::test {
namespace {

using Numbers = std::vector<Index>;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
Numbers to_vector(std::span<const Index> values) { return {values.begin(), values.end()}; }
Numbers to_vector(const Index* data, Index size) { return {data, data + size}; }

void expect_columns(const Connectivity& mesh, const ReferenceMesh& expected) {
  EXPECT_EQ(mesh.form(), expected.form);
  EXPECT_EQ(to_vector(mesh.origin()), expected.origin);
  EXPECT_EQ(to_vector(mesh.opposite()), expected.opposite);
  EXPECT_EQ(to_vector(mesh.outgoing()), expected.outgoing);
  EXPECT_EQ(std::vector<FanStart>(mesh.fans().begin(), mesh.fans().end()), expected.fans);
  EXPECT_EQ(mesh.is_triangle_mesh(), expected.is_all_triangles());
  EXPECT_EQ(mesh.face_count(), expected.face_count());
  if (!mesh.is_explicit()) return;
  const PolygonView view = mesh.polygons();
  EXPECT_EQ(to_vector(view.next_of.data(), view.next_of.size()), expected.next);
  EXPECT_EQ(to_vector(view.face_of.data(), view.face_of.size()), expected.face);
  EXPECT_EQ(to_vector(view.first_of.data(), view.first_of.size()), expected.first);
}

// origin, opposite, face, next and prev of e0 .. e23, vertices from 1, -1 for no face.
constexpr int kTable[24][5] = {
    {1, 18, 0, 1, 2},   {3, 11, 0, 2, 0},   {4, 3, 0, 0, 1},     {1, 2, 1, 4, 5},
    {4, 6, 1, 5, 3},    {2, 19, 1, 3, 4},   {2, 4, 2, 7, 8},     {4, 17, 2, 8, 6},
    {5, 20, 2, 6, 7},   {3, 21, 3, 10, 11}, {6, 12, 3, 11, 9},   {4, 1, 3, 9, 10},
    {4, 10, 4, 13, 14}, {6, 22, 4, 14, 12}, {7, 15, 4, 12, 13},  {4, 14, 5, 16, 17},
    {7, 23, 5, 17, 15}, {5, 7, 5, 15, 16},  {3, 0, -1, 19, 21},  {1, 5, -1, 20, 18},
    {2, 8, -1, 23, 19}, {6, 9, -1, 18, 22}, {7, 13, -1, 21, 23}, {5, 16, -1, 22, 20}};
constexpr int kFirst[6] = {0, 3, 6, 9, 12, 15};

TEST(CloseBoundary, GivesTheWorkedTableOfSixTriangles) {
  const PlainFaces plain = hexagon_of_triangles();
  Numbers corners;
  for (const auto& face : plain.faces) corners.insert(corners.end(), face.begin(), face.end());
  const auto built =
      build(FaceList::triangles<Index>(corners, 7), BuildOptions{}, Execution::serial());
  ASSERT_TRUE(built);
  const auto closed = close_boundary(built->mesh, Execution::serial());
  ASSERT_TRUE(closed);
  const PolygonView mesh = closed->polygons();
  ASSERT_EQ(mesh.halfedge_count(), 24);

  // e18 .. e23 up to renumbering: a boundary half-edge of the table is the one with its opposite.
  std::map<Index, int> name_of = {{kInvalidIndex, -1}};
  for (int e = 0; e < 18; ++e) name_of[e] = e;
  for (int e = 18; e < 24; ++e) name_of[mesh.opposite[HalfedgeId(kTable[e][1])].value] = e;
  ASSERT_EQ(name_of.size(), 25U);
  for (const auto& [number, e] : name_of) {
    if (e < 0) continue;
    const HalfedgeId h(number);
    EXPECT_EQ(mesh.origin[h].value + 1, kTable[e][0]) << "e" << e;
    EXPECT_EQ(name_of.at(mesh.opposite[h].value), kTable[e][1]) << "e" << e;
    EXPECT_EQ(mesh.face(h).value, kTable[e][2]) << "e" << e;
    EXPECT_EQ(name_of.at(mesh.next(h).value), kTable[e][3]) << "e" << e;
    EXPECT_EQ(name_of.at(mesh.prev(h).value), kTable[e][4]) << "e" << e;
  }
  for (Index f = 0; f < 6; ++f) EXPECT_EQ(mesh.first(FaceId(f)).value, kFirst[f]);
  for (Index v = 0; v < 7; ++v) {
    EXPECT_EQ(mesh.origin[mesh.outgoing[VertexId(v)]], VertexId(v));
    EXPECT_EQ(mesh.face(mesh.outgoing[VertexId(v)]).valid(), v == 3);
  }
}

TEST(CloseBoundary, NumbersALoopInARow) {
  const auto closed =
      close_boundary(to_connectivity(reference_of(hexagon_of_triangles())), Execution::serial());
  ASSERT_TRUE(closed);
  const PolygonView mesh = closed->polygons();
  for (Index h = 18; h < 24; ++h) EXPECT_EQ(mesh.next(HalfedgeId(h)).value, h < 23 ? h + 1 : 18);
  EXPECT_EQ(mesh.opposite[HalfedgeId(18)], HalfedgeId(0));
}

TEST(CloseBoundary, LeadsEachFanOfABowtieToItself) {
  const auto closed = close_boundary(to_connectivity(reference_of(bowtie())), Execution::serial());
  ASSERT_TRUE(closed);
  const PolygonView mesh = closed->polygons();
  for (Index h = 6; h < 12; ++h) {
    EXPECT_EQ(mesh.next(HalfedgeId(h)).value < 9, h < 9) << "each triangle has a hole of its own";
  }
}

TEST(CloseBoundary, AddsNothingToAClosedSurface) {
  const auto closed =
      close_boundary(to_connectivity(reference_of(tetrahedron())), Execution::serial());
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->halfedge_count(), 12);
  EXPECT_EQ(closed->form(), Form::closed);
}

TEST(CloseBoundary, RefusesAMeshThatIsClosed) {
  const auto closed =
      close_boundary(to_connectivity(reference_of(tetrahedron())), Execution::serial());
  const auto again = close_boundary(*closed, Execution::serial());
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::already_closed);
}

TEST(OpenBoundary, RefusesAMeshThatIsOpen) {
  const auto opened = open_boundary(to_connectivity(reference_of(bowtie())), Execution::serial());
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::already_open);
}

TEST(OpenBoundary, RefusesADanglingEdge) {
  const auto opened =
      open_boundary(to_connectivity(triangle_with_dangling_edge()), Execution::serial());
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::not_canonical);
  EXPECT_EQ(opened.error().element, 6);
}

// A bowtie whose two fans lie on one rotation, as a mesh whose holes touch may be stored.
TEST(OpenBoundary, CutsARotationWithTwoBoundaryHalfedgesIntoTwoFans) {
  const ReferenceMesh open = reference_of(bowtie());
  ReferenceMesh closed = reference_closed(open);
  // The half-edges that enter vertex 2 along the holes change places in `next`.
  Numbers entering;
  for (Index h = 6; h < 12; ++h) {
    if (closed.origin[at(closed.next[at(h)])] == 2) entering.push_back(h);
  }
  ASSERT_EQ(entering.size(), 2U);
  std::swap(closed.next[at(entering[0])], closed.next[at(entering[1])]);
  closed.fans.clear();
  const auto opened = open_boundary(to_connectivity(closed), Execution::serial());
  ASSERT_TRUE(opened);
  expect_columns(*opened, open);
}

class BoundaryOracle : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(BoundaryOracle, AgreesOnRandomMeshesAndComesBackToTheLastByte) {
  for (std::uint64_t i = 0; i < 500 && !HasFailure(); ++i) {
    const std::uint64_t seed = 500 * GetParam() + i;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    const Connectivity mesh = to_connectivity(open, /*store_all=*/seed % 2 == 0);
    const Execution execution =
        seed % 3 == 0 ? Execution::serial() : Execution::current_arena().with_grain(2);
    const auto closed = close_boundary(mesh, execution);
    ASSERT_TRUE(closed);
    expect_columns(*closed, reference_closed(open));
    const auto opened = open_boundary(*closed, execution);
    ASSERT_TRUE(opened);
    expect_columns(*opened, open);
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, BoundaryOracle, ::testing::Range<std::uint64_t>(0, 8));

}  // namespace
}  // namespace hedgerow::test
