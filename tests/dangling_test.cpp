#include "hedgerow/dangling.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/dcel.h"
#include "hedgerow/split_edge.h"
#include "hedgerow/validate.h"
#include "hedgerow/winged_edge.h"
#include "support/meshes.h"
#include "support/numbers.h"
#include "support/random_faces.h"
#include "support/same_answers.h"
#include "support/same_columns.h"
#include "support/serial.h"

namespace hedgerow::test {
namespace {

EdgeVertices edge(Index a, Index b) { return {VertexId(a), VertexId(b)}; }

/// The columns of a mesh in the closed form, with `prev` beside them.
ReferenceMesh closed_columns_of(const Connectivity& mesh) {
  const PolygonView view = mesh.polygons();
  const auto list = [](const auto& column) {
    return std::vector<Index>(column.data(), column.data() + column.size());
  };
  ReferenceMesh out;
  out.form = Form::closed;
  out.origin = list(view.origin);
  out.opposite = list(view.opposite);
  out.next = list(view.next_of);
  out.face = list(view.face_of);
  out.first = list(view.first_of);
  out.outgoing = list(view.outgoing);
  out.fans.assign(view.fans.begin(), view.fans.end());
  out.prev.resize(out.next.size());
  for (std::size_t h = 0; h < out.next.size(); ++h) {
    out.prev[at(out.next[h])] = static_cast<Index>(h);
  }
  return out;
}

using Rotations = std::vector<std::vector<Index>>;
/// The half-edges that leave v, fan by fan, clockwise.
Rotations rotations(const ReferenceMesh& mesh, Index v) {
  Rotations fans;
  for (const Index start : mesh.fan_starts(v)) {
    fans.emplace_back();
    Index h = start;
    do {
      fans.back().push_back(h);
      h = mesh.next[at(mesh.opposite[at(h)])];
    } while (h != start);
  }
  return fans;
}

/// The rotations that the contract asks for: the new half-edges of v at the end of its first open
/// fan, or a last fan of their own.
Rotations with_star(const ReferenceMesh& closed, Index v, const std::vector<Index>& star) {
  Rotations fans = rotations(closed, v);
  if (star.empty()) return fans;
  const auto open = std::find_if(fans.begin(), fans.end(), [&](const std::vector<Index>& fan) {
    return closed.face[at(fan.front())] < 0;
  });
  if (open == fans.end()) {
    fans.push_back(star);
  } else {
    open->insert(open->end(), star.begin(), star.end());
  }
  return fans;
}

std::vector<EdgeVertices> random_edges(Random& random, Index vertex_count) {
  std::vector<EdgeVertices> edges;
  for (Index i = random.below(Index{12}); i > 0 && vertex_count > 1; --i) {
    const Index a = random.below(vertex_count);
    const Index b = (a + 1 + random.below(vertex_count - 1)) % vertex_count;
    edges.push_back(edge(a, b));
    if (random.one_in(4)) edges.push_back(edge(b, a));
    if (random.one_in(6)) edges.push_back(edge(a, b));
  }
  return edges;
}

TEST(DanglingEdges, LieAtEachVertexWhereTheContractSays) {
  Index added = 0;
  for (std::uint64_t seed = 0; seed < 3000 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    const ReferenceMesh closed = reference_closed(open);
    Random random(seed);
    const std::vector<EdgeVertices> edges = random_edges(random, open.vertex_count());
    const auto output =
        add_dangling_edges(to_connectivity(seed % 2 == 0 ? open : closed), edges, kSerial);
    ASSERT_TRUE(output);
    EXPECT_TRUE(validate(output->mesh, kSerial).empty());
    const ReferenceMesh mesh = closed_columns_of(output->mesh);

    std::map<std::pair<Index, Index>, bool> is_there;
    for (std::size_t h = 0; h < closed.origin.size(); ++h) {
      is_there[{closed.origin[h], closed.origin[at(closed.next[h])]}] = true;
    }
    std::vector<std::vector<Index>> stars(open.outgoing.size());
    std::vector<EdgeVertices> made;
    Index next_number = closed.halfedge_count();
    for (const auto [from, to] : edges) {
      if (is_there[{from.value, to.value}]) continue;
      is_there[{from.value, to.value}] = is_there[{to.value, from.value}] = true;
      stars[at(from.value)].push_back(next_number++);
      stars[at(to.value)].push_back(next_number++);
      made.push_back({from, to});
    }
    EXPECT_EQ(output->added_count, static_cast<Index>(made.size()));
    EXPECT_EQ(output->mesh.halfedge_count(), next_number);
    EXPECT_EQ(dangling_edges(output->mesh), made);
    added += output->added_count;
    for (Index v = 0; v < open.vertex_count(); ++v) {
      EXPECT_EQ(rotations(mesh, v), with_star(closed, v, stars[at(v)])) << "vertex " << v;
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Index h = output->halfedge_of_edge[i].value;
      EXPECT_EQ(mesh.origin[at(h)], edges[i].from.value);
      EXPECT_EQ(mesh.origin[at(mesh.next[at(h)])], edges[i].to.value);
    }
    std::vector<Index> same(mesh.origin.size());
    for (std::size_t h = 0; h < same.size(); ++h) same[h] = static_cast<Index>(h);
    expect_same_answers(output->mesh.polygons(), mesh, same);

    const auto back = remove_dangling_edges(output->mesh);
    ASSERT_TRUE(back);
    expect_same_columns(*back, closed);
    const auto opened = open_boundary(*back, kSerial);
    ASSERT_TRUE(opened);
    expect_same_columns(*opened, open);
  }
  EXPECT_GT(added, 5000);
}

TEST(DanglingEdges, AreCountedInComponentsAndPassedByBoundaryLoops) {
  for (std::uint64_t seed = 0; seed < 500 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    Random random(seed);
    const auto output = add_dangling_edges(to_connectivity(open),
                                           random_edges(random, open.vertex_count()), kSerial);
    ASSERT_TRUE(output);
    const ReferenceMesh mesh = closed_columns_of(output->mesh);
    const Components components = connected_components(output->mesh);
    EXPECT_EQ(std::vector<Index>(components.label.begin(), components.label.end()),
              reference_components(mesh));
    // Each half-edge without a face is in one loop.
    std::set<Index> met;
    Index loops = 0;
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      if (mesh.face[at(h)] >= 0 || met.contains(h)) continue;
      ++loops;
      for (Index g = h; met.insert(g).second;) g = mesh.next[at(g)];
    }
    EXPECT_EQ(boundary_loops(output->mesh).count(), loops);
  }
}

TEST(DanglingEdges, ComeBackThroughRecords) {
  int held = 0;
  for (std::uint64_t seed = 0; seed < 500 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    Random random(seed);
    const auto output = add_dangling_edges(to_connectivity(open),
                                           random_edges(random, open.vertex_count()), kSerial);
    ASSERT_TRUE(output);
    const ReferenceMesh mesh = closed_columns_of(output->mesh);
    const auto dcel = build_dcel(output->mesh, kSerial);
    ASSERT_TRUE(dcel);
    const auto from_dcel = build_connectivity(*dcel);
    ASSERT_TRUE(from_dcel);
    expect_same_columns(from_dcel->mesh, mesh);
    const auto ends = build_split_edges(output->mesh, kSerial);
    ASSERT_TRUE(ends);
    const auto from_ends = build_connectivity(*ends);
    ASSERT_TRUE(from_ends);
    expect_same_columns(from_ends->mesh, mesh);
    if (!mesh.fans.empty()) continue;
    // Numbers of boundary half-edges may change through the tables, the edges not.
    ++held;
    const auto tables = build_winged_edges(output->mesh);
    ASSERT_TRUE(tables);
    const auto from_tables = build_connectivity(*tables);
    ASSERT_TRUE(from_tables);
    EXPECT_TRUE(validate(from_tables->mesh, kSerial).empty());
    if (from_tables->mesh.form() == Form::open) continue;
    EXPECT_EQ(dangling_edges(from_tables->mesh).size(), dangling_edges(output->mesh).size());
  }
  EXPECT_GT(held, 100);
}

TEST(DanglingEdges, AloneAreALoopRoundEachTree) {
  // A path 0 1 2 and an edge 3 4; vertex 5 stays alone.
  const std::vector<EdgeVertices> edges = {edge(0, 1), edge(2, 1), edge(3, 4)};
  const auto output = add_dangling_edges(to_connectivity(reference_mesh({}, 6)), edges, kSerial);
  ASSERT_TRUE(output);
  EXPECT_TRUE(validate(output->mesh, kSerial).empty());
  EXPECT_EQ(output->mesh.face_count(), 0);
  EXPECT_EQ(boundary_loops(output->mesh).count(), 2);
  const PolygonView view = output->mesh.polygons();
  EXPECT_EQ(valence(view, VertexId(1)), 2);
  EXPECT_EQ(valence(view, VertexId(5)), 0);
  EXPECT_TRUE(is_boundary(view, VertexId(0)));
}

TEST(DanglingEdges, ThatAreThereAlreadyAreNamedAndNotDoubled) {
  const std::vector<EdgeVertices> edges = {edge(1, 0), edge(0, 3), edge(3, 0), edge(0, 3)};
  const auto output =
      add_dangling_edges(to_connectivity(reference_of({{{0, 1, 2}}, 4})), edges, kSerial);
  ASSERT_TRUE(output);
  EXPECT_EQ(output->added_count, 1);
  const PolygonView view = output->mesh.polygons();
  EXPECT_EQ(output->halfedge_of_edge[0], view.opposite[HalfedgeId(0)]);
  EXPECT_EQ(output->halfedge_of_edge[1], HalfedgeId(6));
  EXPECT_EQ(output->halfedge_of_edge[2], HalfedgeId(7));
  EXPECT_EQ(output->halfedge_of_edge[3], HalfedgeId(6));
}

TEST(DanglingEdges, WithWrongVerticesAreRefusedByName) {
  const Connectivity mesh = to_connectivity(reference_of({{{0, 1, 2}}, 4}));
  const auto far =
      add_dangling_edges(mesh, std::vector{edge(0, 3), edge(1, 4), edge(-1, 2)}, kSerial);
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error().code, ErrorCode::index_out_of_range);
  EXPECT_EQ(far.error().element, 1);
  EXPECT_EQ(far.error().value, 4);
  EXPECT_EQ(far.error().limit, 4);
  EXPECT_EQ(far.error().count, 2);
  const auto loop = add_dangling_edges(mesh, std::vector{edge(0, 3), edge(2, 2)}, kSerial);
  ASSERT_FALSE(loop);
  EXPECT_EQ(loop.error().code, ErrorCode::repeated_vertex);
  EXPECT_EQ(loop.error().element, 1);
  EXPECT_EQ(loop.error().value, 2);
}

}  // namespace
}  // namespace hedgerow::test
