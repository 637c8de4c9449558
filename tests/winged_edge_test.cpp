#include "hedgerow/winged_edge.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/validate.h"
#include "support/meshes.h"
#include "support/random_faces.h"
#include "support/same_answers.h"
#include "support/same_columns.h"
#include "support/winged_cube.h"

namespace hedgerow::test {
namespace {

std::vector<WingedEdge> rows(const WingedEdgeTables& tables) {
  return {tables.edges.begin(), tables.edges.end()};
}
std::vector<EdgeId> ids(const Buffer<EdgeId>& column) { return {column.begin(), column.end()}; }

void expect_same_tables(const WingedEdgeTables& a, const WingedEdgeTables& b) {
  EXPECT_EQ(rows(a), rows(b));
  EXPECT_EQ(ids(a.vertex_edge), ids(b.vertex_edge));
  EXPECT_EQ(ids(a.face_edge), ids(b.face_edge));
  EXPECT_TRUE(std::ranges::equal(a.xyz, b.xyz));
}

WingedEdgeTables copy_of(const WingedEdgeTables& t) {
  return {Buffer<float>::copy_of(t.xyz.span()), Buffer<EdgeId>::copy_of(t.vertex_edge.span()),
          Buffer<EdgeId>::copy_of(t.face_edge.span()), Buffer<WingedEdge>::copy_of(t.edges.span())};
}

TEST(WingedEdge, TakesTheWorkedTableOfACubeToHalfedgesAndBack) {
  const WingedEdgeTables cube = winged_cube();
  EXPECT_TRUE(check_winged_edges(cube).empty());
  const auto converted = build_connectivity(cube);
  ASSERT_TRUE(converted);
  EXPECT_EQ(converted->mesh.halfedge_count(), 24);
  EXPECT_EQ(converted->mesh.face_count(), 6);
  EXPECT_TRUE(validate(converted->mesh, Execution::serial()).empty());
  const auto back = build_winged_edges(converted->mesh, converted->numbering,
                                       {cube.xyz.data(), cube.vertex_count()});
  ASSERT_TRUE(back);
  expect_same_tables(*back, cube);
}

TEST(WingedEdge, RefusesAVertexWithTwoFans) {
  const auto tables = build_winged_edges(to_connectivity(reference_of(bowtie())));
  ASSERT_FALSE(tables);
  EXPECT_EQ(tables.error().code, ErrorCode::nonmanifold_vertex);
  EXPECT_EQ(tables.error().element, 2);
  EXPECT_EQ(tables.error().value, 2);
}

// The same bowtie as tables: each triangle is sound, but no rotation from the edge of vertex 2
// meets the other one.
TEST(WingedEdge, RefusesTablesWithEdgesThatNoRotationMeets) {
  const auto one = build_winged_edges(to_connectivity(reference_of({{{0, 1, 2}, {3, 4, 5}}, 6})));
  ASSERT_TRUE(one);
  WingedEdgeTables tables = copy_of(*one);
  for (WingedEdge& edge : tables.edges) {
    if (edge.start.value == 3) edge.start = VertexId(2);
    if (edge.end.value == 3) edge.end = VertexId(2);
  }
  tables.vertex_edge[3] = EdgeId();
  EXPECT_TRUE(check_winged_edges(tables).empty());
  const auto converted = build_connectivity(tables);
  ASSERT_FALSE(converted);
  EXPECT_EQ(converted.error().code, ErrorCode::nonmanifold_vertex);
  EXPECT_EQ(converted.error().element, 2);
  EXPECT_EQ(converted.error().value, 2);
}

TEST(WingedEdge, RefusesPositionsOfAnotherNumberOfVertices) {
  const float xyz[3] = {};
  const auto tables =
      build_winged_edges(to_connectivity(reference_of(tetrahedron())), Positions{xyz, 1});
  ASSERT_FALSE(tables);
  EXPECT_EQ(tables.error().code, ErrorCode::count_mismatch);
}

TEST(WingedEdge, KeepsADanglingEdgeOfTheClosedForm) {
  const Connectivity mesh = to_connectivity(triangle_with_dangling_edge());
  const auto tables = build_winged_edges(mesh);
  ASSERT_TRUE(tables);
  EXPECT_EQ(tables->edge_count(), 4);
  EXPECT_TRUE(check_winged_edges(*tables).empty());
  const auto converted = build_connectivity(*tables);
  ASSERT_TRUE(converted);
  EXPECT_EQ(converted->mesh.form(), Form::closed);
  EXPECT_TRUE(validate(converted->mesh, Execution::serial()).empty());
  const auto back = build_winged_edges(converted->mesh, converted->numbering);
  ASSERT_TRUE(back);
  expect_same_tables(*back, *tables);
}

// Where to find the entry of a column; -1 is none.
Index* entry(WingedEdge& edge, WingedColumn column) {
  switch (column) {
    case WingedColumn::start:
      return &edge.start.value;
    case WingedColumn::end:
      return &edge.end.value;
    case WingedColumn::prev_cw:
      return &edge.prev_cw.value;
    case WingedColumn::next_cw:
      return &edge.next_cw.value;
    case WingedColumn::prev_ccw:
      return &edge.prev_ccw.value;
    case WingedColumn::next_ccw:
      return &edge.next_ccw.value;
    case WingedColumn::face_cw:
      return &edge.face_cw.value;
    default:
      return &edge.face_ccw.value;
  }
}

TEST(WingedEdgeCheck, NamesAnyWrongEntryOfTheCubeAndItsConsistentValue) {
  const WingedEdgeTables cube = winged_cube();
  for (Index row = 0; row < 12; ++row) {
    for (int c = 1; c <= 8; ++c) {
      const auto column = static_cast<WingedColumn>(c);
      for (const Index value : {-1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 99}) {
        WingedEdgeTables spoilt = copy_of(cube);
        Index* place = entry(spoilt.edges[static_cast<std::size_t>(row)], column);
        const Index expected = *place;
        if (value == expected) continue;
        *place = value;
        const std::vector<WingedFault> faults = check_winged_edges(spoilt);
        const std::vector<WingedFault> wanted = {
            {WingedTable::edges, row, column, value, expected}};
        EXPECT_EQ(faults, wanted) << "E" << row + 1 << ' ' << name(column) << ' ' << value;
      }
    }
  }
}

TEST(WingedEdgeCheck, NamesAnyWrongLinkOfAMeshWithBoundary) {
  const auto good = build_winged_edges(to_connectivity(reference_of(mixed_row())));
  ASSERT_TRUE(good);
  for (Index row = 0; row < good->edge_count(); ++row) {
    for (const WingedColumn column : {WingedColumn::prev_cw, WingedColumn::next_cw}) {
      for (Index value = -1; value < good->edge_count(); ++value) {
        WingedEdgeTables spoilt = copy_of(*good);
        Index* place = entry(spoilt.edges[static_cast<std::size_t>(row)], column);
        const Index expected = *place;
        if (value == expected) continue;
        *place = value;
        const std::vector<WingedFault> wanted = {
            {WingedTable::edges, row, column, value, expected}};
        EXPECT_EQ(check_winged_edges(spoilt), wanted) << row << ' ' << name(column) << value;
      }
    }
  }
}

TEST(WingedEdgeCheck, NamesAWrongEdgeOfAVertexAndOfAFace) {
  WingedEdgeTables cube = winged_cube();
  cube.vertex_edge[0] = EdgeId(4);  // V1 is on E1, E4 and E9
  cube.face_edge[5] = EdgeId(0);    // F6 has E2, E8, E10 and E11
  const std::vector<WingedFault> wanted = {{WingedTable::vertices, 0, WingedColumn::edge, 4, 0},
                                           {WingedTable::faces, 5, WingedColumn::edge, 0, 1}};
  EXPECT_EQ(check_winged_edges(cube), wanted);
  EXPECT_EQ(build_connectivity(cube).error().code, ErrorCode::inconsistent_table);
}

TEST(WingedEdgeCheck, EndsOnAnyNumbersAtAll) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    WingedEdgeTables tables = winged_cube();
    const int changes = 2 + random.below(12);
    for (int i = 0; i < changes; ++i) {
      WingedEdge& edge = tables.edges[random.below(std::size_t{12})];
      *entry(edge, static_cast<WingedColumn>(1 + random.below(8))) = random.below(Index{15}) - 2;
    }
    // Consistent or not: what is accepted is sound.
    const std::vector<WingedFault> faults = check_winged_edges(tables);
    const auto converted = build_connectivity(tables);
    if (!faults.empty()) {
      ASSERT_FALSE(converted);
      EXPECT_EQ(converted.error().code, ErrorCode::inconsistent_table);
    } else if (converted) {
      EXPECT_TRUE(validate(converted->mesh, Execution::serial()).empty());
    }
  }
}

class WingedEdgeOracle : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(WingedEdgeOracle, ComesBackToTheLastByteInBothForms) {
  int held = 0;
  for (std::uint64_t i = 0; i < 500 && !HasFailure(); ++i) {
    const std::uint64_t seed = 500 * GetParam() + i;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    for (const ReferenceMesh& mesh : {open, reference_closed(open)}) {
      const auto tables = build_winged_edges(to_connectivity(mesh));
      ASSERT_EQ(tables.has_value(), mesh.fans.empty());
      if (!tables) {
        EXPECT_EQ(tables.error().code, ErrorCode::nonmanifold_vertex);
        EXPECT_EQ(tables.error().element, mesh.fans.front().vertex.value);
        continue;
      }
      ++held;
      EXPECT_TRUE(check_winged_edges(*tables).empty());
      const auto converted = build_connectivity(*tables);
      ASSERT_TRUE(converted);
      // Without boundary half-edges the forms do not differ, and the default one is meant.
      const bool has_boundary = mesh.halfedge_count() > open.halfedge_count();
      expect_same_columns(converted->mesh, has_boundary ? mesh : open);
      const auto back = build_winged_edges(converted->mesh, converted->numbering);
      ASSERT_TRUE(back);
      expect_same_tables(*back, *tables);
    }
  }
  EXPECT_GT(held, 100);
}

TEST_P(WingedEdgeOracle, AnswersAsTheReferenceMesh) {
  for (std::uint64_t i = 0; i < 250 && !HasFailure(); ++i) {
    const std::uint64_t seed = 250 * GetParam() + i;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    if (!open.fans.empty()) continue;
    for (const ReferenceMesh& mesh : {open, reference_closed(open)}) {
      const auto tables = build_winged_edges(to_connectivity(mesh));
      ASSERT_TRUE(tables);
      const auto converted = build_connectivity(*tables);
      ASSERT_TRUE(converted);
      // Sides by their half-edges and back.
      std::vector<Index> side_of(static_cast<std::size_t>(mesh.halfedge_count()));
      const auto& halfedge_of = converted->numbering.halfedge_of_side;
      for (std::size_t s = 0; s < halfedge_of.size(); ++s) {
        if (!halfedge_of[s].valid()) continue;
        side_of[static_cast<std::size_t>(halfedge_of[s].value)] = static_cast<Index>(s);
      }
      expect_same_answers(WingedEdgeView(*tables), mesh, side_of);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, WingedEdgeOracle, ::testing::Range<std::uint64_t>(0, 8));

}  // namespace
}  // namespace hedgerow::test
