#include "hedgerow/boundary.h"

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "support/meshes.h"
#include "support/numbers.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"
#include "support/same_columns.h"

namespace hedgerow::test {
namespace {

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
  for (int e = 18; e < 24; ++e) name_of[mesh.opposite[HalfedgeId(kHexagonTable[e][1])].value] = e;
  ASSERT_EQ(name_of.size(), 25U);
  for (const auto& [number, e] : name_of) {
    if (e < 0) continue;
    const HalfedgeId h(number);
    EXPECT_EQ(mesh.origin[h].value, kHexagonTable[e][0]) << "e" << e;
    EXPECT_EQ(name_of.at(mesh.opposite[h].value), kHexagonTable[e][1]) << "e" << e;
    EXPECT_EQ(mesh.face(h).value, kHexagonTable[e][2]) << "e" << e;
    EXPECT_EQ(name_of.at(mesh.next(h).value), kHexagonTable[e][3]) << "e" << e;
    EXPECT_EQ(name_of.at(mesh.prev(h).value), kHexagonTable[e][4]) << "e" << e;
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
  expect_same_columns(*opened, open);
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
    expect_same_columns(*closed, reference_closed(open));
    const auto opened = open_boundary(*closed, execution);
    ASSERT_TRUE(opened);
    expect_same_columns(*opened, open);
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, BoundaryOracle, ::testing::Range<std::uint64_t>(0, 8));

}  // namespace
}  // namespace hedgerow::test
