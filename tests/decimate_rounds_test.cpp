// Decimation in parallel rounds: the same conditions as for a queue, and as good a result.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/decimate.h"
#include "hedgerow/digest.h"
#include "hedgerow/query.h"
#include "hedgerow/shapes.h"
#include "hedgerow/validate.h"
#include "support/decimated.h"
#include "support/meshes.h"
#include "support/plain_build.h"
#include "support/random_faces.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

DecimateOptions rounds(std::int64_t faces, Index part_vertices) {
  DecimateOptions options;
  options.faces = faces;
  options.order = DecimateOrder::rounds;
  options.part_vertices = part_vertices;
  return options;
}
TEST(DecimateRounds, LeaveAsManyFacesAsAsked) {
  for (const Soup& soup : {*shapes::torus(48, 24), *shapes::terrain(40, 40), *shapes::icosphere(4),
                           *shapes::gyroid(10)}) {
    const Connectivity mesh = built(soup);
    const Connectivity closed = std::move(*close_boundary(mesh, Execution::serial()));
    for (const Connectivity* form : {&mesh, &closed}) {
      const std::int64_t faces = mesh.face_count() / 8;
      const DecimateOutput output = decimated(*form, soup.positions(), rounds(faces, 200));
      EXPECT_EQ(output.end, DecimateEnd::faces);
      EXPECT_LE(output.mesh.face_count(), faces);
      EXPECT_GE(output.mesh.face_count(), faces - 1);
      EXPECT_EQ(output.mesh.form(), form->form());
      EXPECT_GT(output.rounds, 1);
      EXPECT_GT(output.accepted, output.collapses / 2);
      EXPECT_EQ(mesh.vertex_count() - output.collapses, output.mesh.vertex_count());
      const auto violations = validate(output.mesh, Execution::serial());
      ASSERT_TRUE(violations.empty()) << violations.front().relation;
      EXPECT_EQ(euler_characteristic(output.mesh, Execution::serial()),
                euler_characteristic(mesh, Execution::serial()));
      EXPECT_EQ(boundary_loops(output.mesh).count(), boundary_loops(mesh).count());
    }
  }
}

TEST(DecimateRounds, GiveTheSameBitsOnAllThreads) {
  for (const Soup& soup : {*shapes::terrain(60, 60), *shapes::gyroid(10)}) {
    const Connectivity mesh = built(soup);
    const DecimateOptions options = rounds(mesh.face_count() / 10, 150);
    const DecimateOutput expected = decimated(mesh, soup.positions(), options);
    for (const int count : kThreadCounts) {
      Threads threads(count);
      const auto found = decimate(mesh, soup.positions(), options, threads.execution(7));
      ASSERT_TRUE(found);
      EXPECT_EQ(digest(found->mesh, Execution::serial()),
                digest(expected.mesh, Execution::serial()));
      EXPECT_TRUE(std::equal(found->positions.begin(), found->positions.end(),
                             expected.positions.begin(), expected.positions.end()));
      EXPECT_EQ(found->rounds, expected.rounds);
      EXPECT_EQ(found->candidates, expected.candidates);
      EXPECT_EQ(found->accepted, expected.accepted);
      EXPECT_EQ(found->postponed, expected.postponed);
    }
  }
}

// One part is a queue that stops now and then, and is sorted to a sixteenth like any other.
TEST(DecimateRounds, CostNotMuchMoreThanAQueue) {
  for (const Soup& soup : {*shapes::terrain(100, 100), *shapes::gyroid(16)}) {
    const Connectivity mesh = built(soup);
    const std::int64_t faces = mesh.face_count() / 10;
    DecimateOptions one_queue;
    one_queue.faces = faces;
    const DecimateOutput queue = decimated(mesh, soup.positions(), one_queue);
    ASSERT_GT(queue.total_cost, 0);
    for (const Index part_vertices : {500, 2000}) {
      const DecimateOutput output = decimated(mesh, soup.positions(), rounds(faces, part_vertices));
      EXPECT_LT(output.total_cost, 1.1 * queue.total_cost) << part_vertices;
      EXPECT_LT(output.largest_cost, 1.5 * queue.largest_cost) << part_vertices;
    }
  }
}

TEST(DecimateRounds, AcceptNineOfTenCandidates) {
  const Soup soup = *shapes::terrain(160, 160);
  const DecimateOutput output =
      decimated(built(soup), soup.positions(), rounds(soup.face_count() / 10, 4096));
  EXPECT_GT(output.candidates, 10'000);
  EXPECT_GE(10 * output.accepted, 9 * output.candidates);
  EXPECT_GT(output.postponed, 0);
  EXPECT_LE(output.accepted + output.postponed, output.candidates);
}

TEST(DecimateRounds, KeepASphereRound) {
  const Soup soup = *shapes::icosphere(5);
  const DecimateOutput output =
      decimated(built(soup), soup.positions(), rounds(soup.face_count() / 20, 1000));
  for (std::size_t i = 0; i < output.positions.size(); i += 3) {
    EXPECT_NEAR(std::hypot(output.positions[i], output.positions[i + 1], output.positions[i + 2]),
                1, 0.01);
  }
}

TEST(DecimateRounds, StopWhereItCostsTooMuch) {
  const Soup soup = *shapes::terrain(40, 40);
  const Connectivity mesh = built(soup);
  DecimateOptions options = rounds(0, 300);
  options.max_cost = decimated(mesh, soup.positions(), rounds(800, 300)).largest_cost / 4;
  const DecimateOutput held = decimated(mesh, soup.positions(), options);
  EXPECT_EQ(held.end, DecimateEnd::max_cost);
  EXPECT_LE(held.largest_cost, options.max_cost);
  EXPECT_GT(held.accepted, 0);
  EXPECT_GT(held.mesh.face_count(), 800);
  options.max_cost = -1;
  EXPECT_EQ(decimated(mesh, soup.positions(), options).collapses, 0);
}

// Each new number is of one old element, in the old order; and a half-edge stays in its face.
template <class Id>
void expect_all_once(const std::vector<Id>& map, Index count, bool is_ascending) {
  std::vector<Index> found;
  for (const Id id : map) {
    if (id.valid()) found.push_back(id.value);
  }
  if (!is_ascending) std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i], static_cast<Index>(i));
}
TEST(DecimateRounds, SayWhereEverythingWent) {
  const Soup soup = *shapes::torus(60, 40);
  const Connectivity mesh = built(soup);
  const DecimateOutput output =
      decimated(mesh, soup.positions(), rounds(mesh.face_count() / 20, 300));
  const CompactMaps& maps = output.maps;
  ASSERT_EQ(maps.vertices.size(), static_cast<std::size_t>(mesh.vertex_count()));
  ASSERT_EQ(maps.halfedges.size(), static_cast<std::size_t>(mesh.halfedge_count()));
  ASSERT_EQ(maps.faces.size(), static_cast<std::size_t>(mesh.face_count()));
  expect_all_once(maps.vertices, output.mesh.vertex_count(), true);
  expect_all_once(maps.halfedges, output.mesh.halfedge_count(), false);
  expect_all_once(maps.faces, output.mesh.face_count(), true);
  for (std::size_t h = 0; h < maps.halfedges.size(); ++h) {
    if (maps.halfedges[h].valid()) {
      EXPECT_EQ(maps.halfedges[h].value / 3, maps.faces[h / 3].value);
    }
  }
}

TEST(DecimateRounds, EndAtWhatCannotBeCollapsed) {
  const auto built = build_plain(tetrahedron());
  const std::vector<float> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const DecimateOutput output = decimated(built->mesh, {xyz.data(), 4}, rounds(0, 1));
  EXPECT_EQ(output.end, DecimateEnd::refused);
  EXPECT_EQ(output.mesh.face_count(), 4);
  EXPECT_EQ(decimated(built->mesh, {xyz.data(), 4}, rounds(9, 1)).collapses, 0);
  EXPECT_EQ(decimated(Connectivity{}, {}, rounds(0, 1)).mesh.face_count(), 0);
}

TEST(DecimateRounds, TakePolygonsAndAnythingElse) {
  Random random(4);
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const auto built = build_plain(random_faces(seed));
    if (!built) continue;
    std::vector<float> xyz;
    for (Index i = 0; i < 3 * built->mesh.vertex_count(); ++i) {
      xyz.push_back(static_cast<float>(random.below(101)) / 8);
    }
    if (!xyz.empty() && seed % 7 == 0) xyz[0] = std::numeric_limits<float>::quiet_NaN();
    const Positions positions{xyz.data(), built->mesh.vertex_count()};
    for (const Index part_vertices : {1, 4, 12, 1000}) {
      const auto found =
          decimate(built->mesh, positions, rounds(2, part_vertices), Execution::serial());
      ASSERT_TRUE(found) << seed << " " << name(found.error().code);
      const auto violations = validate(found->mesh, Execution::serial());
      ASSERT_TRUE(violations.empty()) << seed << " " << violations.front().relation;
    }
  }
}

}  // namespace
}  // namespace hedgerow::test
