#include "hedgerow/nonmanifold_edge.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/meshes.h"
#include "support/random_faces.h"
#include "support/same_columns.h"
#include "support/serial.h"

namespace hedgerow::test {
namespace {

template <class Id>
std::vector<Index> numbers(std::span<const Id> ids) {
  std::vector<Index> out;
  for (const Id id : ids) out.push_back(id.value);
  return out;
}

std::vector<Index> cycle_column(const RadialCycles& cycles) {
  const auto column = cycles.column();
  return {column.data(), column.data() + column.size()};
}

/// The rows of vertices and faces, from the corners of the faces alone.
void expect_rows_of(const NonmanifoldEdges& edges, const ReferenceMesh& mesh) {
  ASSERT_EQ(edges.vertex_count(), mesh.vertex_count());
  ASSERT_EQ(edges.face_count(), mesh.face_count());
  const EdgeMap expected = edges_of(mesh);
  std::map<std::pair<Index, Index>, Index> number;
  std::vector<std::vector<Index>> vertex_edges(mesh.outgoing.size());
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const EdgeEnds& ends = edges.ends[static_cast<std::size_t>(e)];
    number[{ends.smaller.value, ends.larger.value}] = e;
    vertex_edges[static_cast<std::size_t>(ends.smaller.value)].push_back(e);
    vertex_edges[static_cast<std::size_t>(ends.larger.value)].push_back(e);
    std::vector<Index> uses;
    for (const EdgeUse& use : edges.uses[EdgeId(e)]) uses.push_back(use.corner.value);
    EXPECT_EQ(uses.front(), *std::min_element(uses.begin(), uses.end()));
    std::sort(uses.begin(), uses.end());
    EXPECT_EQ(uses, expected.at({ends.smaller.value, ends.larger.value}));
  }
  // As many edges as vertex pairs, so each pair is one edge.
  ASSERT_EQ(number.size(), expected.size());
  ASSERT_EQ(edges.edge_count(), static_cast<Index>(expected.size()));
  const std::vector<std::vector<Index>> faces = mesh.faces();
  std::vector<std::vector<Index>> vertex_faces(mesh.outgoing.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const FaceId id(static_cast<Index>(f));
    EXPECT_EQ(numbers(edges.face_vertices[id]), faces[f]);
    for (std::size_t k = 0; k < faces[f].size(); ++k) {
      const Index from = faces[f][k];
      const Index to = faces[f][(k + 1) % faces[f].size()];
      EXPECT_EQ(edges.edges_of(id)[k].value, (number.at(std::minmax(from, to))));
      EXPECT_EQ(edges.other_end(edges.edges_of(id)[k], VertexId(from)), VertexId(to));
      vertex_faces[static_cast<std::size_t>(from)].push_back(id.value);
    }
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(numbers(edges.vertex_edges[VertexId(v)]), vertex_edges[static_cast<std::size_t>(v)]);
    EXPECT_EQ(numbers(edges.vertex_faces[VertexId(v)]), vertex_faces[static_cast<std::size_t>(v)]);
  }
}

TEST(NonmanifoldEdges, ComeBackToTheLastByteWithTheirCycles) {
  int crowded = 0;
  for (std::uint64_t seed = 0; seed < 2000 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh reference = random_reference_mesh(seed);
    const Connectivity mesh = to_connectivity(reference);
    std::vector<float> xyz(3 * reference.outgoing.size());
    Random random(seed);
    for (float& x : xyz) x = static_cast<float>(random.below(9));
    const auto by_angle = build_radial(mesh, Positions{xyz.data(), mesh.vertex_count()}, kSerial);
    ASSERT_TRUE(by_angle);
    const RadialCycles by_id = build_radial(mesh, kSerial);
    for (const RadialCycles* cycles : {&by_id, &*by_angle}) {
      const auto edges = build_nonmanifold_edges(mesh, *cycles);
      ASSERT_TRUE(edges);
      expect_rows_of(*edges, reference);
      for (Index e = 0; e < edges->edge_count(); ++e) {
        const auto uses = edges->uses[EdgeId(e)];
        crowded += uses.size() > 2;
        std::vector<HalfedgeId> corners;
        for (const EdgeUse& use : uses) corners.push_back(use.corner);
        const auto expected = halfedges_round_edge(*cycles, corners.front());
        EXPECT_TRUE(std::ranges::equal(corners, expected));
      }
      const auto back = build_connectivity(*edges);
      ASSERT_TRUE(back);
      expect_same_columns(back->mesh, reference);
      EXPECT_EQ(cycle_column(back->cycles), cycle_column(*cycles));
    }
  }
  EXPECT_GT(crowded, 1000);
}

TEST(NonmanifoldEdges, OfThreeFacesOnAnEdgeAreOneEdgeWithThreeUses) {
  const Connectivity mesh = to_connectivity(reference_of(three_on_an_edge()));
  const auto edges = build_nonmanifold_edges(mesh, build_radial(mesh, kSerial));
  ASSERT_TRUE(edges);
  EXPECT_EQ(edges->edge_count(), 7);
  const auto uses = edges->uses[EdgeId(0)];
  ASSERT_EQ(uses.size(), 3U);
  EXPECT_EQ(uses[0], (EdgeUse{FaceId(0), HalfedgeId(0), HalfedgeId()}));
  EXPECT_EQ(uses[1], (EdgeUse{FaceId(1), HalfedgeId(3), HalfedgeId()}));
  EXPECT_EQ(uses[2], (EdgeUse{FaceId(2), HalfedgeId(6), HalfedgeId()}));
}

TEST(NonmanifoldEdges, HaveNoPlaceForHalfedgesWithoutAFace) {
  const Connectivity mesh = to_connectivity(reference_closed(reference_of(bowtie())));
  const auto edges = build_nonmanifold_edges(mesh, build_radial(mesh, kSerial));
  ASSERT_FALSE(edges);
  EXPECT_EQ(edges.error().code, ErrorCode::already_closed);
}

NonmanifoldEdges edges_of_two_triangles() {
  const Connectivity mesh = to_connectivity(reference_of({{{0, 1, 2}, {1, 3, 2}}, 4}));
  return std::move(*build_nonmanifold_edges(mesh, build_radial(mesh, kSerial)));
}
ErrorCode code_of(const NonmanifoldEdges& edges) {
  const auto made = build_connectivity(edges);
  return made ? ErrorCode{} : made.error().code;
}

TEST(NonmanifoldEdges, WithAWrongEntryAreRefusedByName) {
  NonmanifoldEdges edges = edges_of_two_triangles();
  edges.face_vertices.values[4] = VertexId(4);
  const auto out_of_range = build_connectivity(edges);
  ASSERT_FALSE(out_of_range);
  EXPECT_EQ(out_of_range.error().code, ErrorCode::index_out_of_range);
  EXPECT_EQ(out_of_range.error().element, 4);
  EXPECT_EQ(out_of_range.error().limit, 4);

  edges = edges_of_two_triangles();
  edges.face_vertices.first[1] = 2;
  EXPECT_EQ(code_of(edges), ErrorCode::too_few_corners);
  edges.face_vertices.first[1] = 7;
  EXPECT_EQ(code_of(edges), ErrorCode::bad_face_offsets);

  edges = edges_of_two_triangles();
  edges.uses.values[0].corner = HalfedgeId(6);
  EXPECT_EQ(code_of(edges), ErrorCode::index_out_of_range);
  edges.uses.values[0].corner = HalfedgeId();
  EXPECT_EQ(code_of(edges), ErrorCode::index_out_of_range);
  edges.uses.values[0].corner = edges.uses.values[1].corner;
  const auto twice = build_connectivity(edges);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().code, ErrorCode::inconsistent_table);
  EXPECT_EQ(twice.error().element, 0);
  EXPECT_EQ(twice.error().value, 0);

  edges = edges_of_two_triangles();
  edges.uses.values.truncate(5);
  EXPECT_EQ(code_of(edges), ErrorCode::count_mismatch);
  edges = edges_of_two_triangles();
  std::swap(edges.uses.first[1], edges.uses.first[2]);
  EXPECT_EQ(code_of(edges), ErrorCode::count_mismatch);
}

// Half-edges 1 and 5 are joined, and no others.
TEST(NonmanifoldEdges, WithAJoinThatIsNotAnsweredAreRefusedByName) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (Index joined = -1; joined < 6; ++joined) {
      NonmanifoldEdges edges = edges_of_two_triangles();
      if (edges.uses.values[i].joined.value == joined) continue;
      edges.uses.values[i].joined = HalfedgeId(joined);
      EXPECT_EQ(code_of(edges), ErrorCode::inconsistent_table) << i << ' ' << joined;
    }
  }
  // Both ways, but along different edges.
  NonmanifoldEdges edges = edges_of_two_triangles();
  for (EdgeUse& use : edges.uses.values) {
    if (use.corner.value == 0) use.joined = HalfedgeId(3);
    if (use.corner.value == 3) use.joined = HalfedgeId(0);
  }
  EXPECT_EQ(code_of(edges), ErrorCode::inconsistent_table);
}

}  // namespace
}  // namespace hedgerow::test
