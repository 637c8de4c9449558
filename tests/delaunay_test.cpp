// Flips to a Delaunay mesh, against slow forms of the tests.
#include "hedgerow/delaunay.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/triangulate.h"
#include "support/edit_mesh.h"
#include "support/edit_soundness.h"
#include "support/meshes.h"
#include "support/planar_checks.h"
#include "support/point_sets.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

struct Surface {
  EditMesh mesh;
  std::vector<float> xyz;
  [[nodiscard]] Positions positions() const {
    return {xyz.data(), static_cast<std::int64_t>(xyz.size() / 3)};
  }
};

float coordinate(double value) { return static_cast<float>(value); }

// Points that floats can hold, triangulated, and the triangulation spoilt by flips that leave no
// triangle flat or turned over.
Surface spoilt_plane(const std::vector<Point2>& wanted, std::uint64_t seed) {
  std::vector<Point2> points;
  Surface surface;
  for (const Point2& p : wanted) {
    points.push_back({coordinate(p[0]), coordinate(p[1])});
    surface.xyz.insert(surface.xyz.end(), {coordinate(p[0]), coordinate(p[1]), 0.0F});
  }
  const Result<Triangulation> made = triangulate(points, Execution::serial());
  surface.mesh = std::move(*EditMesh::of(made->mesh, Execution::serial()));
  std::mt19937_64 random(seed);
  const auto at = [&](VertexId v) { return points[static_cast<std::size_t>(v.value)]; };
  for (Index i = 0; i < 8 * surface.mesh.halfedge_count(); ++i) {
    const HalfedgeId h(
        static_cast<Index>(random() % static_cast<std::uint64_t>(surface.mesh.halfedge_count())));
    const EditView view = surface.mesh.view();
    const HalfedgeId o = view.opposite[h];
    const Point2 c = at(view.origin[view.prev(o)]);
    const Point2 d = at(view.origin[view.prev(h)]);
    const bool is_convex = kernels::orient2d(c, d, at(view.origin[h])) > 0 &&
                           kernels::orient2d(d, c, at(view.origin[o])) > 0;
    if (is_convex) static_cast<void>(surface.mesh.flip(h));
  }
  return surface;
}

// A sphere of n by 2 n quads, each cut along the same diagonal, squeezed.
Surface squeezed_sphere(Index n) {
  PlainFaces list;
  Surface surface;
  const Index around = 2 * n;
  list.vertex_count = (n - 1) * around + 2;
  const auto vertex = [&](Index i, Index j) -> std::int64_t {
    return i == 0 ? 0 : i == n ? list.vertex_count - 1 : 1 + (i - 1) * around + j % around;
  };
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < around; ++j) {
      if (i > 0) list.faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
      if (i == n - 1) continue;
      list.faces.push_back({vertex(i, j + 1), vertex(i + 1, j), vertex(i + 1, j + 1)});
    }
  }
  const auto push = [&](double theta, double phi) {
    surface.xyz.insert(surface.xyz.end(), {coordinate(4 * std::sin(theta) * std::cos(phi)),
                                           coordinate(std::sin(theta) * std::sin(phi)),
                                           coordinate(0.3 * std::cos(theta))});
  };
  push(0, 0);
  for (Index i = 1; i < n; ++i) {
    for (Index j = 0; j < around; ++j) {
      push(3.14159265 * static_cast<double>(i) / static_cast<double>(n),
           3.14159265 * static_cast<double>(j) / static_cast<double>(n));
    }
  }
  push(3.14159265, 0);
  surface.mesh = edit_mesh(list);
  return surface;
}

// The angle at the corner that h leaves, by the cosine.
double angle(const Surface& surface, HalfedgeId h) {
  const EditView view = surface.mesh.view();
  const auto point = [&](HalfedgeId g) { return surface.positions()[view.origin[g].value]; };
  const auto along = [&](HalfedgeId g, int k) {
    return static_cast<double>(point(g)[k]) - static_cast<double>(point(h)[k]);
  };
  double dot = 0;
  double next = 0;
  double prev = 0;
  for (int k = 0; k < 3; ++k) {
    dot += along(view.next(h), k) * along(view.prev(h), k);
    next += along(view.next(h), k) * along(view.next(h), k);
    prev += along(view.prev(h), k) * along(view.prev(h), k);
  }
  return std::acos(dot / std::sqrt(next * prev));
}

Index edges_over_180_degrees(const Surface& surface) {
  const EditView view = surface.mesh.view();
  Index count = 0;
  for (HalfedgeId h(0); h.value < view.halfedge_count(); ++h.value) {
    const HalfedgeId o = view.opposite[h];
    if (!view.face(h).valid() || !view.face(o).valid() || o < h) continue;
    const double sum = angle(surface, view.prev(h)) + angle(surface, view.prev(o));
    count += sum > 3.14159265358979 + 1e-6 ? 1 : 0;
  }
  return count;
}

DelaunayReport flip(Surface& surface, const DelaunayOptions& options,
                    const Execution& execution = Execution::serial()) {
  const auto report = flip_to_delaunay(surface.mesh, surface.positions(), options, execution);
  EXPECT_TRUE(report.has_value());
  return report.value_or(DelaunayReport{});
}

constexpr DelaunayOrder kOrders[] = {DelaunayOrder::rounds, DelaunayOrder::queue};

TEST(Delaunay, TurnsTheOneEdgeThatFails) {
  for (const DelaunayOrder order : kOrders) {
    for (const DelaunayTest test : {DelaunayTest::angle_sum, DelaunayTest::in_circle}) {
      Surface surface{edit_mesh({{{0, 1, 2}, {1, 3, 2}}, 4}),
                      {-1, 0, 0, 0, -4, 0, 0, 4, 0, 1, 0, 0}};
      const DelaunayReport report = flip(surface, {.test = test, .order = order});
      EXPECT_EQ(report.flips, 1);
      EXPECT_EQ(report.left, 0);
      EXPECT_TRUE(surface.mesh.find(VertexId(0), VertexId(3)).valid());
    }
  }
}

TEST(Delaunay, LeavesCocircularPointsAsTheyAre) {
  for (const DelaunayTest test : {DelaunayTest::angle_sum, DelaunayTest::in_circle}) {
    Surface surface{edit_mesh({{{0, 1, 2}, {1, 3, 2}}, 4}), {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}};
    EXPECT_EQ(flip(surface, {.test = test}).flips, 0);
  }
}

TEST(Delaunay, EmptiesEveryCircleInThePlane) {
  for (const DelaunayOrder order : kOrders) {
    for (const Spread spread : {Spread::uniform, Spread::clusters, Spread::grid, Spread::tenths,
                                Spread::small_whole, Spread::circle, Spread::repeated}) {
      for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Surface surface = spoilt_plane(points_of(spread, 80, seed), seed);
        const DelaunayReport report =
            flip(surface, {.test = DelaunayTest::in_circle, .order = order});
        EXPECT_EQ(report.left, 0);
        EXPECT_EQ(find_fault(surface.mesh), "");
        std::vector<Point2> points;
        for (std::size_t i = 0; i < surface.xyz.size(); i += 3) {
          points.push_back({surface.xyz[i], surface.xyz[i + 1]});
        }
        const Result<Compacted> compact = surface.mesh.compact();
        ASSERT_TRUE(compact.has_value());
        const PlanarCheck check(points, compact->mesh);
        EXPECT_EQ(check.every_circle_is_empty(), "");
        EXPECT_EQ(check.covers_the_hull(), "");
      }
    }
  }
}

TEST(Delaunay, LeavesNoEdgeOver180DegreesOnASurface) {
  for (const DelaunayOrder order : kOrders) {
    Surface surface = squeezed_sphere(24);
    ASSERT_GT(edges_over_180_degrees(surface), 100);
    const DelaunayReport report = flip(surface, {.order = order});
    EXPECT_GT(report.flips, 100);
    EXPECT_EQ(report.left, 0);
    EXPECT_FALSE(report.is_cut_short);
    EXPECT_EQ(edges_over_180_degrees(surface), 0);
    EXPECT_EQ(find_fault(surface.mesh), "");
  }
}

TEST(Delaunay, IsUndoneFromTheLastRecordToTheFirst) {
  for (const DelaunayOrder order : kOrders) {
    Surface surface = squeezed_sphere(12);
    const EditState before = state_of(surface.mesh);
    std::vector<Change> record;
    ASSERT_GT(flip(surface, {.order = order, .record = &record}).flips, 10);
    ASSERT_NE(state_of(surface.mesh), before);
    for (; !record.empty(); record.pop_back()) ASSERT_TRUE(surface.mesh.undo(record.back()));
    EXPECT_EQ(state_of(surface.mesh), before);
  }
}

TEST(Delaunay, IsTheSameForEveryThreadCountWithAndWithoutRecord) {
  Surface serial = squeezed_sphere(20);
  const DelaunayReport expected = flip(serial, {});
  for (const int threads : kThreadCounts) {
    Threads arena(threads);
    for (const bool is_recording : {false, true}) {
      Surface surface = squeezed_sphere(20);
      std::vector<Change> record;
      DelaunayOptions options;
      if (is_recording) options.record = &record;
      const DelaunayReport report = flip(surface, options, arena.execution(7));
      EXPECT_EQ(report.rounds, expected.rounds);
      EXPECT_EQ(report.flips, expected.flips);
      EXPECT_EQ(state_of(surface.mesh), state_of(serial.mesh));
    }
  }
}

TEST(Delaunay, LeavesEdgesAtCoordinatesThatAreNotFinite) {
  for (const DelaunayOrder order : kOrders) {
    for (const DelaunayTest test : {DelaunayTest::angle_sum, DelaunayTest::in_circle}) {
      Surface surface = spoilt_plane(points_of(Spread::uniform, 60, 4), 4);
      surface.xyz[3 * 30] = std::numeric_limits<float>::quiet_NaN();
      surface.xyz[3 * 31 + 1] = std::numeric_limits<float>::infinity();
      const DelaunayReport report = flip(surface, {.test = test, .order = order});
      EXPECT_GT(report.undefined, 0);
      EXPECT_EQ(report.left, 0);
      EXPECT_EQ(find_fault(surface.mesh), "");
    }
  }
}

TEST(Delaunay, CountsEdgesThatCannotBeFlipped) {
  // A flat tetrahedron: its long edges fail, and every other edge is there already.
  for (const DelaunayOrder order : kOrders) {
    Surface surface{edit_mesh(tetrahedron()), {0, 0, 0, 9, 0, 0, 4, 1, 0, 5, -1, 0}};
    const DelaunayReport report = flip(surface, {.order = order});
    EXPECT_EQ(report.flips, 0);
    EXPECT_GT(report.left, 0);
    EXPECT_EQ(find_fault(surface.mesh), "");
  }
}

TEST(Delaunay, StopsAtTheMostFlipsThatAreAllowed) {
  for (const DelaunayOrder order : kOrders) {
    Surface surface = squeezed_sphere(12);
    const DelaunayReport report = flip(surface, {.order = order, .max_flips = 5});
    EXPECT_EQ(report.flips, 5);
    EXPECT_TRUE(report.is_cut_short);
    EXPECT_GT(report.left, 0);
    EXPECT_EQ(find_fault(surface.mesh), "");
  }
}

TEST(Delaunay, LeavesPolygonsAlone) {
  Surface surface{edit_mesh({{{0, 1, 2}, {1, 3, 4, 2}}, 5}),
                  {-1, 0, 0, 0, -4, 0, 0, 4, 0, 1, -1, 0, 1, 1, 0}};
  EXPECT_EQ(flip(surface, {}).flips, 0);
}

// A fan of many triangles, and on each a flat one whose edge to the fan fails: every flip adds an
// edge to the middle of the fan, and none may walk round it.
TEST(Delaunay, IsNotQuadraticAtAVertexOfManyTriangles) {
  constexpr Index kCount = 100'000;
  std::vector<Index> corners;
  Surface surface{{}, {0, -coordinate(kCount), 0}};
  const auto push = [&](Index x, double y) {
    surface.xyz.insert(surface.xyz.end(),
                       {coordinate(static_cast<double>(x - kCount)), coordinate(y), 0.0F});
  };
  push(0, 0);
  for (Index i = 0; i < kCount; ++i) {
    push(2 * i + 1, 0x1p-20);
    push(2 * i + 2, 0);
    const Index left = 2 * i + 1;
    corners.insert(corners.end(), {0, left + 2, left, left, left + 2, left + 1});
  }
  const auto faces = FaceList::triangles<Index>(corners, 2 * kCount + 2);
  const auto built = build(faces, {}, Execution::serial());
  ASSERT_TRUE(built.has_value());
  for (const DelaunayOrder order : kOrders) {
    surface.mesh = std::move(*EditMesh::of(built->mesh, Execution::serial()));
    const DelaunayReport report = flip(surface, {.order = order});
    EXPECT_GE(report.flips, kCount);
    EXPECT_EQ(report.left, 0);
    EXPECT_FALSE(report.is_cut_short);
  }
}

TEST(Delaunay, AsksForAPositionForEachVertex) {
  Surface surface = squeezed_sphere(4);
  Positions few = surface.positions();
  few.count -= 1;
  const EditState before = state_of(surface.mesh);
  const auto report = flip_to_delaunay(surface.mesh, few, {}, Execution::serial());
  ASSERT_FALSE(report.has_value());
  EXPECT_EQ(report.error().code, ErrorCode::count_mismatch);
  EXPECT_EQ(state_of(surface.mesh), before);
}

}  // namespace
}  // namespace hedgerow::test
