#include "hedgerow/radial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "support/meshes.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

using Points = std::vector<float>;

Positions view_of(const Points& points) {
  return {points.data(), static_cast<std::int64_t>(points.size() / 3)};
}

std::vector<Index> values_of(const RadialCycles& cycles) {
  const Index* data = cycles.column().data();
  return {data, data + cycles.column().size()};
}

std::vector<Index> cycle_of(const RadialCycles& cycles, Index h) {
  std::vector<Index> cycle;
  for (const HalfedgeId g : halfedges_round_edge(cycles, HalfedgeId(h))) cycle.push_back(g.value);
  return cycle;
}

// What the cycles must be: the half-edges of each edge in ascending order.
std::vector<Index> reference_cycles(const EdgeMap& edges, std::size_t halfedge_count) {
  std::vector<Index> next(halfedge_count, kInvalidIndex);
  for (const auto& [ends, halfedges] : edges) {
    for (std::size_t i = 0; i < halfedges.size(); ++i) {
      next[static_cast<std::size_t>(halfedges[i])] = halfedges[(i + 1) % halfedges.size()];
    }
  }
  return next;
}

PlainFaces pages(Index count) {
  PlainFaces list{{}, count + 2};
  for (std::int64_t i = 0; i < count; ++i) {
    if (i % 3 == 0) {
      list.faces.push_back({1, 0, i + 2});
    } else {
      list.faces.push_back({0, 1, i + 2});
    }
  }
  return list;
}

TEST(Radial, GivesThreeFacesOnAnEdgeOneCycle) {
  const ReferenceMesh plain = reference_of(three_on_an_edge());
  const RadialCycles cycles = build_radial(to_connectivity(plain), Execution::serial());
  EXPECT_EQ(values_of(cycles), (std::vector<Index>{3, 1, 2, 6, 4, 5, 0, 7, 8}));
}

TEST(Radial, TurnsCounterClockwiseToAViewerWhoLooksFromTheSmallerVertexToTheLarger) {
  // The edge runs up the z axis, so the viewer at its foot sees x to the right and y downwards, or
  // y upwards and x to the left: counter-clockwise is from +y to +x, to -y, to -x.
  const Points points = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
  const PlainFaces faces = {{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 1, 5}}, 6};
  const Connectivity mesh = to_connectivity(reference_of(faces));
  const auto cycles = build_radial(mesh, view_of(points), Execution::serial());
  ASSERT_TRUE(cycles);
  EXPECT_EQ(cycle_of(*cycles, 6), (std::vector<Index>{0, 9, 6, 3}));
  std::vector<Index> met;
  const TriangleView view = mesh.triangles();
  for (const FaceId f : faces_round_edge(view, *cycles, HalfedgeId(9))) met.push_back(f.value);
  EXPECT_EQ(met, (std::vector<Index>{0, 3, 2, 1}));
}

TEST(Radial, LeavesBoundaryHalfedgesOfTheClosedFormOut) {
  for (const PlainFaces& faces : {three_on_an_edge(), mixed_row(), hexagon_of_triangles()}) {
    const ReferenceMesh open = reference_of(faces);
    const ReferenceMesh closed = reference_closed(open);
    std::vector<Index> expected =
        values_of(build_radial(to_connectivity(open), Execution::serial()));
    expected.resize(closed.origin.size(), kInvalidIndex);
    EXPECT_EQ(values_of(build_radial(to_connectivity(closed), Execution::serial())), expected);
  }
}

TEST(Radial, GroupsRandomFacesAsAMapDoes) {
  for (std::uint64_t seed = 0; seed < 30'000; ++seed) {
    const ReferenceMesh plain = random_reference_mesh(seed);
    const auto expected = reference_cycles(edges_of(plain), plain.origin.size());
    const RadialCycles cycles = build_radial(to_connectivity(plain), Execution::serial());
    ASSERT_EQ(values_of(cycles), expected) << "seed " << seed;
  }
}

TEST(Radial, FindsPairsBesideFacesThatWereCut) {
  // The first two faces pair on edge (0, 1); the copy of the first is cut from them.
  const std::vector<std::vector<Index>> faces = {{0, 1, 2}, {1, 0, 3}, {0, 1, 2}};
  const ReferenceMesh plain = reference_mesh(faces, 4, {false, false, true});
  ASSERT_EQ(plain.opposite[0], 3);
  const auto expected = reference_cycles(edges_of(plain), plain.origin.size());
  const RadialCycles cycles = build_radial(to_connectivity(plain), Execution::serial());
  EXPECT_EQ(values_of(cycles), expected);
  EXPECT_EQ(cycle_of(cycles, 3), (std::vector<Index>{0, 3, 6}));
}

TEST(Radial, RefusesPositionsThatAreTooFew) {
  const Connectivity mesh = to_connectivity(reference_of(tetrahedron()));
  const Points points(9);
  const auto cycles = build_radial(mesh, view_of(points), Execution::serial());
  ASSERT_FALSE(cycles);
  EXPECT_EQ(cycles.error().code, ErrorCode::count_mismatch);
}

// The angle of a face from its definition: the direction at a right angle to the edge, as a pair
// (quadrant, exact fraction), in 64-bit integers. For triangles with small integer coordinates.
struct Int3 {
  std::int64_t x = 0, y = 0, z = 0;
  friend Int3 operator-(Int3 a, Int3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Int3 operator*(std::int64_t s, Int3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend bool operator==(Int3, Int3) = default;
};
Int3 cross_of(Int3 a, Int3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
std::int64_t dot_of(Int3 a, Int3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Int3 point(const Points& points, Index v) {
  const auto i = static_cast<std::size_t>(3 * v);
  return {std::int64_t(points[i]), std::int64_t(points[i + 1]), std::int64_t(points[i + 2])};
}

struct Page {
  Index halfedge;
  Int3 out;  ///< the apex less its foot on the edge, times the square of the edge's length
};

// Cyclic order by angles in long double, where equal directions are told apart exactly.
std::vector<Index> brute_order(const ReferenceMesh& mesh, const Points& points,
                               std::pair<Index, Index> ends, std::vector<Index> halfedges) {
  const Int3 a = point(points, ends.first);
  const Int3 axis = a - point(points, ends.second);  // towards the viewer
  std::vector<Page> pages_round;
  std::vector<Index> order;
  for (const Index h : halfedges) {
    const Index apex =
        mesh.origin[static_cast<std::size_t>(mesh.prev[static_cast<std::size_t>(h)])];
    const Int3 w = point(points, apex) - a;
    const Int3 out = dot_of(axis, axis) * w - dot_of(axis, w) * axis;
    if (out == Int3{}) {
      order.push_back(h);
    } else {
      pages_round.push_back({h, out});
    }
  }
  if (pages_round.empty()) return order;
  const Int3 start = pages_round[0].out;
  const Int3 side = cross_of(axis, start);
  const auto length = std::sqrt(static_cast<long double>(dot_of(axis, axis)));
  const auto is_same = [](Int3 u, Int3 v) { return cross_of(u, v) == Int3{} && dot_of(u, v) > 0; };
  const auto angle = [&](Int3 u) {
    if (is_same(u, start)) return 0.0L;
    const auto turned = std::atan2(static_cast<long double>(dot_of(u, side)) / length,
                                   static_cast<long double>(dot_of(u, start)));
    return turned < 0 ? turned + 2 * 3.14159265358979323846264338327950288L : turned;
  };
  std::stable_sort(pages_round.begin(), pages_round.end(), [&](const Page& p, const Page& q) {
    return !is_same(p.out, q.out) && angle(p.out) < angle(q.out);
  });
  for (const Page& page : pages_round) order.push_back(page.halfedge);
  return order;
}

void expect_brute_order(const PlainFaces& faces, const Points& points, std::uint64_t seed) {
  const ReferenceMesh plain = reference_of(faces);
  const auto cycles = build_radial(to_connectivity(plain), view_of(points), Execution::serial());
  ASSERT_TRUE(cycles);
  for (const auto& [ends, halfedges] : edges_of(plain)) {
    std::vector<Index> order = brute_order(plain, points, ends, halfedges);
    std::rotate(order.begin(), std::min_element(order.begin(), order.end()), order.end());
    ASSERT_EQ(cycle_of(*cycles, halfedges[0]), order) << "seed " << seed;
  }
}

TEST(RadialAngle, SortsPagesOnSmallIntegersAsBruteForceDoes) {
  for (std::uint64_t seed = 0; seed < 4'000; ++seed) {
    Random random(seed);
    const Index count = 3 + random.below(12);
    const std::int64_t width = random.any_of<std::int64_t>({2, 3, 5, 40});
    Points points;
    for (Index i = 0; i < 3 * (count + 2); ++i) {
      points.push_back(static_cast<float>(random.below(width) - width / 2));
    }
    expect_brute_order(pages(count), points, seed);
  }
}

// Pages in one half-plane that no axis is at right angles to: in doubles the sign is noise.
TEST(RadialAngle, FindsTiesAmongLargeIntegers) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Points points;
    for (int i = 0; i < 6; ++i) points.push_back(static_cast<float>(random.below(1 << 20)));
    for (std::size_t k = 3; k < 6; ++k) points[k] *= 4096;  // areas of more than 53 bits
    std::vector<float> out;
    for (int i = 0; i < 3; ++i) out.push_back(static_cast<float>(random.below(1 << 20)));
    std::vector<Index> expected;
    for (Index page = 0; page < 7; ++page) {
      const auto times = static_cast<float>(1 + random.below(5));
      for (std::size_t k = 0; k < 3; ++k) points.push_back(points[k] + times * out[k]);
      expected.push_back(3 * page);
    }
    const Connectivity mesh = to_connectivity(reference_of(pages(7)));
    const auto cycles = build_radial(mesh, view_of(points), Execution::serial());
    ASSERT_TRUE(cycles);
    ASSERT_EQ(cycle_of(*cycles, 0), expected) << "seed " << seed;
  }
}

// Apexes at 2^k (1, 1) from an edge at (3, 1) or (1, 3): in doubles all of them have one direction.
TEST(RadialAngle, OrdersDirectionsThatDoublesCannotTellApart) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    std::vector<int> powers;
    for (int k = 52; k < 72; ++k) powers.push_back(k);
    random.shuffle(powers);
    const bool is_falling = random.one_in(2);
    const float x = is_falling ? 3 : 1;
    const float y = 4 - x;
    Points points = {x, y, 1, x, y, 0};
    std::vector<std::pair<int, Index>> expected;
    for (std::size_t i = 0; i < powers.size(); ++i) {
      const float far = std::ldexp(1.0F, powers[i]);
      points.insert(points.end(), {far, far, static_cast<float>(random.below(9))});
      expected.emplace_back(is_falling ? -powers[i] : powers[i], static_cast<Index>(3 * i));
    }
    std::sort(expected.begin(), expected.end());
    std::vector<Index> order;
    for (const auto& [power, h] : expected) order.push_back(h);
    std::rotate(order.begin(), std::find(order.begin(), order.end(), 0), order.end());
    const Connectivity mesh = to_connectivity(reference_of(pages(20)));
    const auto cycles = build_radial(mesh, view_of(points), Execution::serial());
    ASSERT_TRUE(cycles);
    ASSERT_EQ(cycle_of(*cycles, 0), order) << "seed " << seed;
  }
}

// By powers of two, and by a power of three: as exact, but products no longer fit a double.
TEST(RadialAngle, KeepsTheOrderWhenEverythingIsScaled) {
  constexpr std::array kScales = {0x1p-149F, 0x1p124F, 59'049.0F};
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const PlainFaces faces = pages(9);
    Points points;
    for (int i = 0; i < 33; ++i) points.push_back(static_cast<float>(random.below(9) - 4));
    Points scaled = points;
    for (float& x : scaled) x *= kScales[seed % 3];
    const Connectivity mesh = to_connectivity(reference_of(faces));
    const auto cycles = build_radial(mesh, view_of(points), Execution::serial());
    const auto same = build_radial(mesh, view_of(scaled), Execution::serial());
    ASSERT_TRUE(cycles && same);
    ASSERT_EQ(values_of(*cycles), values_of(*same)) << "seed " << seed;
  }
}

TEST(RadialAngle, TakesTheSideOfAPolygonFromItsArea) {
  // A dart that is concave at its second corner, and whose third corner so lies on the other side.
  const Points points = {0, 0, 0, 4, 0, 0, 3, -2, 0, 8, 4, 0, 2, 0, 3, 2, 0, -3};
  const PlainFaces faces = {{{0, 1, 2, 3}, {0, 1, 4}, {0, 1, 5}}, 6};
  const PlainFaces triangles = {{{0, 1, 3}, {0, 1, 4}, {0, 1, 5}}, 6};
  const auto order = [&](const PlainFaces& list) {
    const Connectivity mesh = to_connectivity(reference_of(list));
    const auto cycles = build_radial(mesh, view_of(points), Execution::serial());
    std::vector<Index> met;
    mesh.visit([&](const auto& view) {
      for (const FaceId f : faces_round_edge(view, *cycles, HalfedgeId(0))) met.push_back(f.value);
    });
    return met;
  };
  EXPECT_EQ(order(faces), order(triangles));
}

TEST(RadialAngle, SortsTenThousandFacesRoundOneEdge) {
  constexpr Index kCount = 10'000;
  Random random(1);
  std::vector<std::pair<double, Index>> angles;
  Points points = {0, 0, 0, 0, 0, 1};
  for (Index i = 0; i < kCount; ++i) {
    const double angle = 6.28 * static_cast<double>(random.below(1 << 22)) / (1 << 22);
    angles.emplace_back(-angle, i);
    for (const double x : {std::cos(angle), std::sin(angle), 0.5}) {
      points.push_back(static_cast<float>(x));
    }
  }
  const PlainFaces faces = pages(kCount);
  const Connectivity mesh = to_connectivity(reference_of(faces));
  const auto cycles = build_radial(mesh, view_of(points), Execution::serial());
  ASSERT_TRUE(cycles);
  const std::vector<Index> cycle = cycle_of(*cycles, 0);
  ASSERT_EQ(cycle.size(), angles.size());
  // Angles as rounding left them: falling but for neighbours closer than floats can be.
  std::size_t turns = 0;
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    const double here = angles[static_cast<std::size_t>(cycle[i] / 3)].first;
    const double after = angles[static_cast<std::size_t>(cycle[(i + 1) % cycle.size()] / 3)].first;
    turns += after < here - 1e-6;
  }
  EXPECT_EQ(turns, 1U);
}

TEST(Radial, IsTheSameForEveryScheduleWithAndWithoutPositions) {
  constexpr Index kVertices = 3'000;
  Random random(7);
  Points points;
  for (Index i = 0; i < 3 * kVertices; ++i) points.push_back(static_cast<float>(random.below(20)));
  std::vector<Index> corners;
  for (int i = 0; i < 40'000; ++i) {
    const Index a = random.below(kVertices);
    const Index b = a / 100 * 100 + random.below(Index{100});
    const Index c = random.one_in(9) ? (a + 1) % kVertices : 17;
    if (a != b && b != c && c != a) corners.insert(corners.end(), {a, b, c});
  }
  const auto built = build(FaceList::triangles<Index>(corners, kVertices), {}, Execution::serial());
  ASSERT_TRUE(built);
  const Connectivity& mesh = built->mesh;
  const auto ids = values_of(build_radial(mesh, Execution::serial()));
  const auto angles = values_of(*build_radial(mesh, view_of(points), Execution::serial()));
  const auto patches =
      manifold_patches(mesh, build_radial(mesh, Execution::serial()), Execution::serial());
  EXPECT_NE(ids, angles);
  for (const int count : kThreadCounts) {
    Threads threads(count);
    for (const Index grain : {0, 1, 1'000}) {
      const Execution execution = threads.execution(grain);
      const RadialCycles cycles = build_radial(mesh, execution);
      EXPECT_EQ(values_of(cycles), ids);
      EXPECT_EQ(values_of(*build_radial(mesh, view_of(points), execution)), angles);
      if (grain == 1) continue;  // a tree a half-edge
      const Patches same = manifold_patches(mesh, cycles, execution);
      EXPECT_TRUE(std::equal(same.label.begin(), same.label.end(), patches.label.begin()));
      EXPECT_EQ(same.count, patches.count);
    }
  }
}

TEST(Radial, ListsTheFansOfAVertex) {
  for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
    const ReferenceMesh plain = random_reference_mesh(seed);
    const Connectivity mesh = to_connectivity(plain);
    mesh.visit([&](const auto& view) {
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        std::vector<Index> starts;
        for (const HalfedgeId h : fan_starts(view, VertexId(v))) starts.push_back(h.value);
        ASSERT_EQ(starts, plain.fan_starts(v)) << "seed " << seed;
      }
    });
  }
}

TEST(Patches, AreTheFacesThatEdgesWithTwoFacesJoin) {
  for (std::uint64_t seed = 0; seed < 5'000; ++seed) {
    const ReferenceMesh plain = random_reference_mesh(seed);
    std::vector<Index> label;
    for (Index f = 0; f < plain.face_count(); ++f) label.push_back(f);
    const EdgeMap edges = edges_of(plain);
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [ends, halfedges] : edges) {
        if (halfedges.size() != 2) continue;
        auto& a =
            label[static_cast<std::size_t>(plain.face[static_cast<std::size_t>(halfedges[0])])];
        auto& b =
            label[static_cast<std::size_t>(plain.face[static_cast<std::size_t>(halfedges[1])])];
        changed |= a != b;
        a = b = std::min(a, b);
      }
    }
    const Connectivity mesh = to_connectivity(plain);
    const Patches patches =
        manifold_patches(mesh, build_radial(mesh, Execution::serial()), Execution::serial());
    ASSERT_EQ(std::vector<Index>(patches.label.begin(), patches.label.end()), label)
        << "seed " << seed;
    const std::set<Index> distinct(label.begin(), label.end());
    ASSERT_EQ(patches.count, static_cast<Index>(distinct.size()));
  }
}

}  // namespace
}  // namespace hedgerow::test
