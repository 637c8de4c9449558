#include "hedgerow/adjacency.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/query.h"
#include "hedgerow/validate.h"
#include "support/meshes.h"
#include "support/numbers.h"
#include "support/random_faces.h"
#include "support/same_columns.h"
#include "support/serial.h"

namespace hedgerow::test {
namespace {

/// Everything that can be asked without a vertex, beside the view of the whole mesh.
template <Topology Mesh>
void expect_same_answers(const AdjacencyView& adjacency, const Mesh& mesh) {
  ASSERT_EQ(adjacency.halfedge_count(), mesh.halfedge_count());
  ASSERT_EQ(adjacency.face_count(), mesh.face_count());
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    const HalfedgeId h(i);
    EXPECT_EQ(adjacency.opposite[h], mesh.opposite[h]);
    EXPECT_EQ(adjacency.next(h), mesh.next(h));
    EXPECT_EQ(adjacency.prev(h), mesh.prev(h));
    EXPECT_EQ(adjacency.face(h), mesh.face(h));
    EXPECT_EQ(degree(adjacency, h), degree(mesh, h));
    EXPECT_EQ(is_boundary(adjacency, h), is_boundary(mesh, h));
    EXPECT_EQ(is_boundary_edge(adjacency, h), is_boundary_edge(mesh, h));
    EXPECT_EQ(numbers(halfedges_from(adjacency, h)), numbers(halfedges_from(mesh, h)));
    if (is_boundary(mesh, h)) {
      EXPECT_EQ(numbers(boundary_loop(adjacency, h)), numbers(boundary_loop(mesh, h)));
    }
  }
  for (Index i = 0; i < mesh.face_count(); ++i) {
    const FaceId f(i);
    EXPECT_EQ(numbers(halfedges(adjacency, f)), numbers(halfedges(mesh, f)));
    EXPECT_EQ(numbers(adjacent_faces(adjacency, f)), numbers(adjacent_faces(mesh, f)));
    EXPECT_EQ(adjacent_face_count(adjacency, f), adjacent_face_count(mesh, f));
    EXPECT_EQ(is_boundary(adjacency, f), is_boundary(mesh, f));
  }
}

/// What it says in all, from the columns of the mesh by maps.
void expect_summary(const AdjacencySummary& summary, const ReferenceMesh& mesh) {
  Index fans = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    fans += static_cast<Index>(mesh.fan_starts(v).size());
  }
  EXPECT_EQ(summary.vertices, fans);
  EXPECT_EQ(summary.faces, mesh.face_count());
  Index edges = 0;
  std::map<Index, Index> group;  // of each half-edge
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    edges += mesh.opposite[at(h)] < h;
    group[h] = h;
  }
  EXPECT_EQ(summary.edges, edges);
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (auto& [h, g] : group) {
      for (const Index other : {mesh.next[at(h)], mesh.opposite[at(h)]}) {
        if (other < 0) continue;
        const Index smallest = std::min(g, group[other]);
        is_changed |= smallest != g || smallest != group[other];
        g = group[other] = smallest;
      }
    }
  }
  const auto roots =
      std::count_if(group.begin(), group.end(), [](const auto& p) { return p.first == p.second; });
  EXPECT_EQ(summary.components, roots);
  EXPECT_EQ(summary.boundary_loops, boundary_loops(to_connectivity(mesh)).count());
}

TEST(Adjacencies, AnswerAsTheMeshAndComeBackWithOrbitsForVertices) {
  for (std::uint64_t seed = 0; seed < 1500 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    for (const ReferenceMesh& mesh : {open, reference_closed(open)}) {
      const Connectivity core = to_connectivity(mesh);
      const Adjacency adjacency = build_adjacency(core, kSerial);
      core.visit([&](const auto& view) { expect_same_answers(AdjacencyView(adjacency), view); });
      const AdjacencySummary summary = summarise(adjacency);
      expect_summary(summary, mesh);
      const auto back = build_connectivity(adjacency);
      ASSERT_TRUE(back);
      EXPECT_TRUE(validate(*back, kSerial).empty());
      EXPECT_EQ(back->form(), mesh.form);
      EXPECT_EQ(back->vertex_count(), summary.vertices);
      EXPECT_TRUE(back->fans().empty());
      EXPECT_TRUE(std::ranges::equal(back->opposite(), mesh.opposite));
      // Each orbit is of one vertex, and orbits are numbered as they are met.
      std::map<Index, Index> vertex_of;
      for (std::size_t h = 0; h < mesh.origin.size(); ++h) {
        const Index orbit = back->origin()[h];
        EXPECT_LE(orbit, static_cast<Index>(vertex_of.size()));
        EXPECT_EQ(vertex_of.emplace(orbit, mesh.origin[h]).first->second, mesh.origin[h]);
      }
      // Numbered so, and with one fan each, they come back to the last byte.
      const auto again = build_connectivity(build_adjacency(*back, kSerial));
      ASSERT_TRUE(again);
      EXPECT_TRUE(std::ranges::equal(again->origin(), back->origin()));
      EXPECT_TRUE(std::ranges::equal(again->opposite(), back->opposite()));
      EXPECT_TRUE(std::ranges::equal(again->outgoing(), back->outgoing()));
      EXPECT_EQ(again->is_implicit(), back->is_implicit());
    }
  }
}

TEST(Adjacencies, OfATorusHaveItsGenus) {
  PlainFaces torus{{}, 16};
  for (std::int64_t y = 0; y < 4; ++y) {
    for (std::int64_t x = 0; x < 4; ++x) {
      const auto v = [](std::int64_t i, std::int64_t j) { return 4 * (j % 4) + i % 4; };
      torus.faces.push_back({v(x, y), v(x + 1, y), v(x + 1, y + 1), v(x, y + 1)});
    }
  }
  const AdjacencySummary summary =
      summarise(build_adjacency(to_connectivity(reference_of(torus)), kSerial));
  EXPECT_EQ(summary.euler(), 0);
  EXPECT_EQ(summary.genus(), 1);
}

// Of two triangles side by side; any entry changed to any number.
TEST(Adjacencies, ThatContradictThemselvesAreRefusedOrSound) {
  for (const bool is_closed : {false, true}) {
    const ReferenceMesh open = reference_of({{{0, 1, 2}, {1, 3, 2}}, 4});
    const Connectivity mesh = to_connectivity(is_closed ? reference_closed(open) : open);
    const Index count = mesh.halfedge_count();
    for (Index r = 0; r < count; ++r) {
      for (int column = 0; column < 4; ++column) {
        for (Index value = -2; value <= count; ++value) {
          Adjacency adjacency = build_adjacency(mesh, kSerial);
          AdjacencyRecord& record = adjacency.halfedges[at(r)];
          Index* const entries[] = {&record.opposite.value, &record.face.value, &record.next.value,
                                    &record.prev.value};
          if (*entries[column] == value) continue;
          *entries[column] = value;
          const auto made = build_connectivity(adjacency);
          ASSERT_FALSE(made) << r << " column " << column << " value " << value;
          const ErrorCode code = made.error().code;
          EXPECT_TRUE(code == ErrorCode::index_out_of_range ||
                      code == ErrorCode::inconsistent_table);
        }
      }
    }
  }
}

}  // namespace
}  // namespace hedgerow::test
