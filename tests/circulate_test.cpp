#include "hedgerow/circulate.h"

#include <algorithm>
#include <map>
#include <ranges>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/connectivity.h"
#include "support/meshes.h"
#include "support/numbers.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"

namespace hedgerow::test {
namespace {

Numbers sorted(Numbers values) {
  std::sort(values.begin(), values.end());
  return values;
}

static_assert(std::ranges::forward_range<
              decltype(outgoing_halfedges(std::declval<const TriangleView&>(), VertexId()))>);
static_assert(
    std::ranges::view<decltype(neighbours(std::declval<const PolygonView&>(), VertexId()))>);

TEST(Circulate, TurnsClockwiseFromTheOpenEnd) {
  const Connectivity mesh = to_connectivity(reference_of(hexagon_of_triangles()));
  const TriangleView view = mesh.triangles();
  EXPECT_EQ(numbers(outgoing_halfedges(view, VertexId(0))), (Numbers{3, 0}));
  EXPECT_EQ(numbers(outgoing_halfedges(view, VertexId(3))), (Numbers{2, 4, 7, 15, 12, 11}));
}

TEST(Circulate, VisitsTheNeighbourBehindTheOpenEnd) {
  const Connectivity mesh = to_connectivity(reference_of(hexagon_of_triangles()));
  const TriangleView view = mesh.triangles();
  EXPECT_EQ(numbers(neighbours(view, VertexId(0))), (Numbers{1, 3, 2}));
  EXPECT_EQ(numbers(incident_faces(view, VertexId(0))), (Numbers{1, 0}));
}

TEST(Circulate, VisitsEveryFanOfABowtie) {
  const Connectivity mesh = to_connectivity(reference_of(bowtie()));
  const TriangleView view = mesh.triangles();
  EXPECT_EQ(numbers(outgoing_halfedges(view, VertexId(2))), (Numbers{2, 3}));
  EXPECT_EQ(numbers(neighbours(view, VertexId(2))), (Numbers{1, 0, 4, 3}));
}

TEST(Circulate, FindsNothingAtAnIsolatedVertex) {
  const Connectivity mesh = to_connectivity(reference_of(mixed_row()));
  const PolygonView view = mesh.polygons();
  EXPECT_TRUE(outgoing_halfedges(view, VertexId(8)).empty());
  EXPECT_TRUE(outgoing_halfedges<Rotation::counter_clockwise>(view, VertexId(8)).empty());
  EXPECT_TRUE(neighbours(view, VertexId(8)).empty());
  EXPECT_TRUE(incident_faces(view, VertexId(8)).empty());
}

TEST(Circulate, GoesRoundAFaceFromItsFirstHalfedge) {
  const Connectivity mesh = to_connectivity(reference_of(mixed_row()));
  const PolygonView view = mesh.polygons();
  EXPECT_EQ(numbers(halfedges(view, FaceId(1))), (Numbers{5, 6, 7, 8}));
  EXPECT_EQ(numbers(halfedges_from(view, HalfedgeId(7))), (Numbers{7, 8, 5, 6}));
  EXPECT_EQ(numbers(vertices(view, FaceId(1))), (Numbers{1, 5, 6, 2}));
  EXPECT_EQ(numbers(adjacent_faces(view, FaceId(1))), (Numbers{2, 0}));
}

TEST(Circulate, PassesAlongBothSidesOfADanglingEdge) {
  const Connectivity connectivity = to_connectivity(triangle_with_dangling_edge());
  const PolygonView view = connectivity.polygons();
  EXPECT_EQ(numbers(boundary_loop(view, HalfedgeId(3))), (Numbers{3, 6, 7, 4, 5}));
  EXPECT_EQ(sorted(numbers(neighbours(view, VertexId(0)))), (Numbers{1, 2, 3}));
  EXPECT_EQ(numbers(neighbours(view, VertexId(3))), (Numbers{0}));
  EXPECT_EQ(sorted(numbers(outgoing_halfedges<Rotation::counter_clockwise>(view, VertexId(0)))),
            (Numbers{0, 4, 6}));
}

// What the ranges must meet at each vertex, from the columns alone.
template <class View>
void expect_one_rings(const View& view, const ReferenceMesh& mesh) {
  std::map<Index, Numbers> leaving;
  std::map<Index, Numbers> faces;
  std::map<Index, Numbers> others;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index v = mesh.origin[at(h)];
    leaving[v].push_back(h);
    others[v].push_back(mesh.origin[at(mesh.next[at(h)])]);
    if (mesh.face[at(h)] != kInvalidIndex) faces[v].push_back(mesh.face[at(h)]);
    // An edge without a half-edge in the other direction is met from its end, too.
    if (mesh.opposite[at(h)] == kInvalidIndex) others[others[v].back()].push_back(v);
  }
  std::map<Index, Numbers> passed;
  for_each_neighbour(view, {0, view.halfedge_count()},
                     [&](VertexId v, VertexId u) { passed[v.value].push_back(u.value); });
  EXPECT_EQ(passed, others);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(sorted(numbers(outgoing_halfedges(view, VertexId(v)))), leaving[v]);
    EXPECT_EQ(sorted(numbers(incident_faces(view, VertexId(v)))), sorted(faces[v]));
    EXPECT_EQ(sorted(numbers(neighbours(view, VertexId(v)))), sorted(others[v]));
  }
}

// Clockwise, each half-edge follows the one before it; counter-clockwise is the same fan backwards.
template <class View>
void expect_order(const View& view, const ReferenceMesh& mesh) {
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    Numbers clockwise;
    Numbers counter_clockwise;
    for (const Index start : mesh.fan_starts(v)) {
      Numbers fan = {start};
      while (true) {
        const Index opposite = mesh.opposite[at(fan.back())];
        if (opposite == kInvalidIndex || mesh.next[at(opposite)] == start) break;
        fan.push_back(mesh.next[at(opposite)]);
      }
      const bool is_closed = mesh.opposite[at(fan.back())] != kInvalidIndex;
      clockwise.insert(clockwise.end(), fan.begin(), fan.end());
      std::reverse(fan.begin() + is_closed, fan.end());
      counter_clockwise.insert(counter_clockwise.end(), fan.begin(), fan.end());
    }
    EXPECT_EQ(numbers(outgoing_halfedges(view, VertexId(v))), clockwise);
    EXPECT_EQ(numbers(outgoing_halfedges<Rotation::counter_clockwise>(view, VertexId(v))),
              counter_clockwise);
  }
}

template <class View>
void expect_face_rings(const View& view, const ReferenceMesh& mesh) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    Numbers sides;
    Numbers corners;
    Numbers across;
    for (Index h = mesh.first[at(f)]; h < mesh.first[at(f + 1)]; ++h) {
      sides.push_back(h);
      corners.push_back(mesh.origin[at(h)]);
      const Index opposite = mesh.opposite[at(h)];
      if (opposite != kInvalidIndex && mesh.face[at(opposite)] != kInvalidIndex) {
        across.push_back(mesh.face[at(opposite)]);
      }
    }
    EXPECT_EQ(numbers(halfedges(view, FaceId(f))), sides);
    EXPECT_EQ(numbers(vertices(view, FaceId(f))), corners);
    EXPECT_EQ(numbers(adjacent_faces(view, FaceId(f))), across);
  }
}

template <class View>
void expect_all(const View& view, const ReferenceMesh& mesh) {
  expect_one_rings(view, mesh);
  expect_order(view, mesh);
  expect_face_rings(view, mesh);
}

class CirculateOracle : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(CirculateOracle, MeetsWhatTheColumnsSayInBothFormsAndViews) {
  for (std::uint64_t i = 0; i < 250 && !HasFailure(); ++i) {
    const std::uint64_t seed = 250 * GetParam() + i;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh open = random_reference_mesh(seed);
    const Connectivity mesh = to_connectivity(open, /*store_all=*/true);
    expect_all(mesh.polygons(), open);
    if (mesh.is_implicit()) expect_all(mesh.triangles(), open);
    const ReferenceMesh closed = reference_closed(open);
    const Connectivity closed_mesh = to_connectivity(closed);
    expect_all(closed_mesh.polygons(), closed);
    // The hole is no neighbour: both forms agree in order, too.
    for (Index v = 0; v < open.vertex_count(); ++v) {
      const PolygonView a = mesh.polygons();
      const PolygonView b = closed_mesh.polygons();
      EXPECT_EQ(numbers(neighbours(a, VertexId(v))), numbers(neighbours(b, VertexId(v))));
      EXPECT_EQ(numbers(incident_faces(a, VertexId(v))), numbers(incident_faces(b, VertexId(v))));
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, CirculateOracle, ::testing::Range<std::uint64_t>(0, 8));

}  // namespace
}  // namespace hedgerow::test
