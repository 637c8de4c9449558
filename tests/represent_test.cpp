// Corner tables, directed edges, split edges and the DCEL: there and back, and every question.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/corner_table.h"
#include "hedgerow/dcel.h"
#include "hedgerow/directed_edge.h"
#include "hedgerow/split_edge.h"
#include "hedgerow/validate.h"
#include "support/meshes.h"
#include "support/random_faces.h"
#include "support/same_answers.h"
#include "support/same_columns.h"
#include "support/serial.h"

namespace hedgerow::test {
namespace {

/// What the tests below ask of a representation.
struct CornerTables {
  using View = CornerTableView;
  static constexpr bool kTrianglesOnly = true;
  static auto make(const Connectivity& mesh) { return build_corner_table(mesh, kSerial); }
  static auto back(const CornerTable& table) { return build_connectivity(table, kSerial); }
};
struct Directed {
  using View = DirectedEdgeView;
  static constexpr bool kTrianglesOnly = true;
  static auto make(const Connectivity& mesh) { return build_directed_edges(mesh, kSerial); }
  static auto back(const DirectedEdges& edges) { return build_connectivity(edges, kSerial); }
};
/// Numbers do not change where they were canonical.
Result<Connectivity> same_numbers(Result<NumberedMesh> numbered) {
  if (!numbered) return fail(numbered.error());
  for (std::size_t r = 0; r < numbered->halfedge_of_record.size(); ++r) {
    const Index h = numbered->halfedge_of_record[r].value;
    const auto number = static_cast<Index>(r);
    EXPECT_EQ(h, number < numbered->mesh.halfedge_count() ? number : kInvalidIndex);
  }
  return std::move(numbered->mesh);
}
struct Doubly {
  using View = DcelView;
  static constexpr bool kTrianglesOnly = false;
  static auto make(const Connectivity& mesh) { return build_dcel(mesh, kSerial); }
  static auto back(const Dcel& dcel) { return same_numbers(build_connectivity(dcel)); }
};
struct Split {
  using View = SplitEdgeView;
  static constexpr bool kTrianglesOnly = false;
  static auto make(const Connectivity& mesh) { return build_split_edges(mesh, kSerial); }
  static auto back(const SplitEdges& edges) { return same_numbers(build_connectivity(edges)); }
};

template <class Representation>
class Represent : public ::testing::Test {};
using All = ::testing::Types<CornerTables, Directed, Doubly, Split>;
TYPED_TEST_SUITE(Represent, All);

TYPED_TEST(Represent, ComesBackToTheLastByteAndAnswersAsTheReferenceMesh) {
  int held = 0;
  for (std::uint64_t seed = 0; seed < 1500 && !this->HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    const ReferenceMesh closed = reference_closed(open);
    for (const ReferenceMesh& mesh : {open, closed}) {
      const auto made = TypeParam::make(to_connectivity(mesh));
      ASSERT_EQ(made.has_value(), !TypeParam::kTrianglesOnly || mesh.is_all_triangles());
      if (!made) {
        EXPECT_EQ(made.error().code, ErrorCode::not_triangles);
        continue;
      }
      ++held;
      // Each has one of the two forms, and its half-edges have the same numbers.
      const ReferenceMesh& asked = TypeParam::kTrianglesOnly ? open : closed;
      std::vector<Index> same(static_cast<std::size_t>(asked.halfedge_count()));
      std::iota(same.begin(), same.end(), Index{0});
      expect_same_answers(typename TypeParam::View(*made), asked, same);
      const Result<Connectivity> back = TypeParam::back(*made);
      ASSERT_TRUE(back);
      expect_same_columns(*back, mesh);
    }
  }
  EXPECT_GT(held, 1000);
}

TYPED_TEST(Represent, TakesAMeshWithoutFaces) {
  for (const Index vertex_count : {0, 3}) {
    const ReferenceMesh empty = reference_mesh({}, vertex_count);
    const auto made = TypeParam::make(to_connectivity(empty));
    ASSERT_TRUE(made);
    const Result<Connectivity> back = TypeParam::back(*made);
    ASSERT_TRUE(back);
    expect_same_columns(*back, empty);
  }
}

TEST(CornerTables, FaceTheEdgeThatTheirNextCornerLeaves) {
  // Triangles 0 1 2 and 1 3 2: corners 0 and 4 face the edge between them.
  const auto table =
      build_corner_table(to_connectivity(reference_of({{{0, 1, 2}, {1, 3, 2}}, 4})), kSerial);
  ASSERT_TRUE(table);
  std::vector<Index> opposite;
  for (const CornerId c : table->opposite) opposite.push_back(c.value);
  EXPECT_EQ(opposite, (std::vector<Index>{4, -1, -1, -1, 0, -1}));
  // Round vertex 1, whose corners are 1 and 3.
  EXPECT_EQ(table->swing_right(CornerId(1)), CornerId(3));
  EXPECT_EQ(table->swing_left(CornerId(3)), CornerId(1));
  EXPECT_EQ(table->swing_right(CornerId(3)), CornerId());
  EXPECT_EQ(table->swing_left(CornerId(1)), CornerId());
}

TEST(CornerTables, RefuseColumnsOfDifferentLengths) {
  CornerTable table;
  table.vertex = Buffer<VertexId>(3, VertexId(0));
  const auto short_column = build_connectivity(table, kSerial);
  ASSERT_FALSE(short_column);
  EXPECT_EQ(short_column.error().code, ErrorCode::count_mismatch);
  EXPECT_EQ(short_column.error().value, 0);
  EXPECT_EQ(short_column.error().limit, 3);
  table.vertex = Buffer<VertexId>(4, VertexId(0));
  EXPECT_EQ(build_connectivity(table, kSerial).error().limit, 3);
  DirectedEdges edges;
  edges.edges = Buffer<DirectedEdge>(5, DirectedEdge{});
  EXPECT_EQ(build_connectivity(edges, kSerial).error().limit, 3);
}

TEST(CornerTables, NameTheFirstFaceThatIsNoTriangle) {
  const auto table = build_corner_table(to_connectivity(reference_of(mixed_row())), kSerial);
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, ErrorCode::not_triangles);
  EXPECT_EQ(table.error().element, 0);
  EXPECT_EQ(table.error().value, 5);
  EXPECT_EQ(table.error().count, 2);
  EXPECT_STREQ(name(table.error().code), "not-triangles");
}

TEST(CornerTables, RefuseADanglingEdge) {
  const auto table = build_corner_table(to_connectivity(triangle_with_dangling_edge()), kSerial);
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, ErrorCode::not_canonical);
}

constexpr Index kVertexHalfedge[7] = {0, 5, 1, 2, 8, 10, 14};

DcelHalfedge worked_record(std::size_t r) {
  const auto& row = kHexagonTable[r];
  return {VertexId(row[0]), HalfedgeId(row[1]), FaceId(row[2]), HalfedgeId(row[3]),
          HalfedgeId(row[4])};
}
Dcel worked_dcel() {
  Dcel dcel{Buffer<DcelHalfedge>(24), Buffer<HalfedgeId>(7), Buffer<HalfedgeId>(6), {}};
  for (std::size_t r = 0; r < 24; ++r) dcel.halfedges[r] = worked_record(r);
  for (std::size_t v = 0; v < 7; ++v) dcel.vertex_halfedge[v] = HalfedgeId(kVertexHalfedge[v]);
  for (Index f = 0; f < 6; ++f) {
    dcel.face_halfedge[static_cast<std::size_t>(f)] = HalfedgeId(3 * f);
  }
  return dcel;
}

TEST(Dcels, OfTheWorkedTrianglesAreTheWorkedTable) {
  const auto dcel = build_dcel(to_connectivity(reference_of(hexagon_of_triangles())), kSerial);
  ASSERT_TRUE(dcel);
  ASSERT_EQ(dcel->halfedge_count(), 24);
  // Boundary half-edges by what they are opposite to.
  std::vector<HalfedgeId> ours(24);
  for (Index r = 0; r < 24; ++r) {
    const auto i = static_cast<std::size_t>(r);
    ours[i] = r < 18 ? HalfedgeId(r)
                     : dcel->halfedges[static_cast<std::size_t>(kHexagonTable[i][1])].opposite;
  }
  const auto our = [&](HalfedgeId r) { return ours[static_cast<std::size_t>(r.value)]; };
  for (std::size_t r = 0; r < 24; ++r) {
    DcelHalfedge expected = worked_record(r);
    expected.opposite = our(expected.opposite);
    expected.next = our(expected.next);
    expected.prev = our(expected.prev);
    EXPECT_EQ(dcel->halfedges[static_cast<std::size_t>(ours[r].value)], expected) << "e" << r;
  }
  for (Index f = 0; f < 6; ++f) {
    EXPECT_EQ(dcel->face_halfedge[static_cast<std::size_t>(f)], HalfedgeId(3 * f));
  }
}

TEST(Dcels, OfTheWorkedTableKeepItsNumbersAndComeBackAsTheTable) {
  const auto made = build_connectivity(worked_dcel());
  ASSERT_TRUE(made);
  EXPECT_TRUE(validate(made->mesh, kSerial).empty());
  const auto opened = open_boundary(made->mesh, kSerial);
  ASSERT_TRUE(opened);
  expect_same_columns(*opened, reference_of(hexagon_of_triangles()));
  const auto again = build_dcel(made->mesh, kSerial);
  ASSERT_TRUE(again);
  for (std::size_t r = 0; r < 24; ++r) EXPECT_EQ(again->halfedges[r], worked_record(r)) << "e" << r;
}

TEST(Dcels, MayHaveTheirRecordsInAnyOrder) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh mesh = reference_closed(random_reference_mesh(seed));
    const auto dcel = build_dcel(to_connectivity(mesh), kSerial);
    ASSERT_TRUE(dcel);
    const auto count = static_cast<std::size_t>(dcel->halfedge_count());
    std::vector<Index> moved_to(count);
    std::iota(moved_to.begin(), moved_to.end(), Index{0});
    Random random(seed);
    random.shuffle(moved_to);
    const auto moved = [&](HalfedgeId h) {
      return HalfedgeId(moved_to[static_cast<std::size_t>(h.value)]);
    };
    Dcel shuffled{Buffer<DcelHalfedge>(count),
                  Buffer<HalfedgeId>(dcel->vertex_halfedge.size()),
                  Buffer<HalfedgeId>(dcel->face_halfedge.size()),
                  {}};
    for (std::size_t h = 0; h < count; ++h) {
      const DcelHalfedge& r = dcel->halfedges[h];
      shuffled.halfedges[static_cast<std::size_t>(moved_to[h])] = {
          r.origin, moved(r.opposite), r.face, moved(r.next), moved(r.prev)};
    }
    for (std::size_t v = 0; v < shuffled.vertex_halfedge.size(); ++v) {
      const HalfedgeId h = dcel->vertex_halfedge[v];
      shuffled.vertex_halfedge[v] = h.valid() ? moved(h) : h;
    }
    for (std::size_t f = 0; f < shuffled.face_halfedge.size(); ++f) {
      shuffled.face_halfedge[f] = moved(dcel->face_halfedge[f]);
    }
    const auto made = build_connectivity(shuffled);
    ASSERT_TRUE(made);
    EXPECT_TRUE(validate(made->mesh, kSerial).empty());
    // The faces begin where they did, so that only boundary loops may begin elsewhere.
    std::vector<Index> number(count);
    for (std::size_t h = 0; h < count; ++h) {
      const Index r = moved_to[h];
      number[h] = made->halfedge_of_record[static_cast<std::size_t>(r)].value;
      if (mesh.face[h] >= 0) {
        EXPECT_EQ(number[h], static_cast<Index>(h));
      }
    }
    EXPECT_EQ(std::vector<Index>(made->mesh.origin().begin(),
                                 made->mesh.origin().begin() + mesh.first.back()),
              std::vector<Index>(mesh.origin.begin(), mesh.origin.begin() + mesh.first.back()));
    for (std::size_t h = 0; h < count; ++h) {
      EXPECT_EQ(made->mesh.opposite()[static_cast<std::size_t>(number[h])],
                number[static_cast<std::size_t>(mesh.opposite[h])]);
    }
    EXPECT_EQ(made->mesh.fans().size(), mesh.fans.size());
  }
}

TEST(Dcels, KeepADanglingEdge) {
  const Connectivity mesh = to_connectivity(triangle_with_dangling_edge());
  const auto dcel = build_dcel(mesh, kSerial);
  ASSERT_TRUE(dcel);
  const auto made = build_connectivity(*dcel);
  ASSERT_TRUE(made);
  EXPECT_TRUE(validate(made->mesh, kSerial).empty());
  EXPECT_EQ(made->mesh.halfedge_count(), mesh.halfedge_count());
  const auto again = build_dcel(made->mesh, kSerial);
  ASSERT_TRUE(again);
  for (std::size_t r = 0; r < dcel->halfedges.size(); ++r) {
    const auto h = static_cast<std::size_t>(made->halfedge_of_record[r].value);
    EXPECT_EQ(again->halfedges[h].origin, dcel->halfedges[r].origin);
    EXPECT_EQ(again->halfedges[h].face, dcel->halfedges[r].face);
  }
}

// Any one entry changed to any other value, in range or not, is found, or makes a sound mesh.
TEST(Dcels, NameAnEntryThatContradictsTheOthers) {
  int refused = 0;
  for (std::size_t r = 0; r < 24; ++r) {
    for (int column = 0; column < 5; ++column) {
      for (Index value = -2; value <= 24; ++value) {
        Dcel dcel = worked_dcel();
        DcelHalfedge& record = dcel.halfedges[r];
        Index* const entries[] = {&record.origin.value, &record.opposite.value, &record.face.value,
                                  &record.next.value, &record.prev.value};
        if (*entries[column] == value) continue;
        *entries[column] = value;
        const auto made = build_connectivity(dcel);
        ASSERT_FALSE(made) << "e" << r << " column " << column << " value " << value;
        ++refused;
        if (made.error().code == ErrorCode::index_out_of_range) {
          EXPECT_EQ(made.error().element, static_cast<Index>(r));
          EXPECT_EQ(made.error().value, value);
        } else {
          EXPECT_EQ(made.error().code, ErrorCode::inconsistent_table);
        }
      }
    }
  }
  EXPECT_EQ(refused, 24 * 5 * 26);
}

TEST(Dcels, RefuseAFaceWithoutRecordAndOneWithTwoCorners) {
  Dcel dcel = worked_dcel();
  dcel.face_halfedge[2] = HalfedgeId();
  EXPECT_EQ(build_connectivity(dcel).error().code, ErrorCode::index_out_of_range);
  dcel.face_halfedge[2] = HalfedgeId(0);
  EXPECT_EQ(build_connectivity(dcel).error().code, ErrorCode::inconsistent_table);
  // One edge as two half-edges of one face.
  Dcel two{Buffer<DcelHalfedge>(2), Buffer<HalfedgeId>(2), Buffer<HalfedgeId>(1), {}};
  two.halfedges[0] = {VertexId(0), HalfedgeId(1), FaceId(0), HalfedgeId(1), HalfedgeId(1)};
  two.halfedges[1] = {VertexId(1), HalfedgeId(0), FaceId(0), HalfedgeId(0), HalfedgeId(0)};
  two.vertex_halfedge[0] = two.face_halfedge[0] = HalfedgeId(0);
  two.vertex_halfedge[1] = HalfedgeId(1);
  const auto made = build_connectivity(two);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::too_few_corners);
  EXPECT_EQ(made.error().value, 2);
}

}  // namespace
}  // namespace hedgerow::test
