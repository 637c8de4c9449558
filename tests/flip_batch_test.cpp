// Many flips at once are the same flips one after the other.
#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/edit.h"
#include "support/edit_mesh.h"
#include "support/edit_soundness.h"
#include "support/meshes.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

// A closed torus of n by n quads, each cut in two triangles.
PlainFaces cut_torus(std::int64_t n) {
  PlainFaces list;
  list.vertex_count = n * n;
  const auto at = [n](std::int64_t i, std::int64_t j) { return i % n * n + j % n; };
  for (std::int64_t i = 0; i < n; ++i) {
    for (std::int64_t j = 0; j < n; ++j) {
      list.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      list.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return list;
}

std::vector<HalfedgeId> shuffled_edges(const EditMesh& mesh, std::uint64_t seed) {
  std::vector<HalfedgeId> edges;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (h < mesh.view().opposite[HalfedgeId(h)].value) edges.emplace_back(h);
  }
  std::mt19937_64 random(seed);
  std::shuffle(edges.begin(), edges.end(), random);
  return edges;
}

// In order: what touches a face of a flip before it waits, what cannot be done is refused.
struct FlippedOneByOne {
  std::vector<HalfedgeId> flipped;
  std::vector<HalfedgeId> rest;
  std::vector<HalfedgeId> refused;
};
FlippedOneByOne flip_one_by_one(EditMesh& mesh, const std::vector<HalfedgeId>& wanted) {
  FlippedOneByOne plain;
  std::vector<HalfedgeId> possible;
  for (const HalfedgeId h : wanted) (mesh.can_flip(h) ? possible : plain.refused).push_back(h);
  std::set<FaceId> touched;
  for (const HalfedgeId h : possible) {
    const FaceId f = mesh.view().face(h);
    const FaceId g = mesh.view().face(mesh.view().opposite[h]);
    const bool is_free = touched.count(f) == 0 && touched.count(g) == 0;
    // Only another flip of this batch can have made the edge since.
    const bool is_done = is_free && mesh.flip(h).has_value();
    (is_done ? plain.flipped : plain.rest).push_back(h);
    if (is_done) touched.insert({f, g});
  }
  return plain;
}

void expect_the_same(EditMesh& mesh, EditMesh& copy, const std::vector<HalfedgeId>& wanted,
                     const Execution& execution) {
  const FlippedOneByOne plain = flip_one_by_one(copy, wanted);
  const EditBatch batch = mesh.flip_batch(wanted, execution);
  EXPECT_EQ(batch.done, plain.flipped);
  EXPECT_EQ(batch.refused, plain.refused);
  EXPECT_EQ(batch.rest, plain.rest);
  EXPECT_EQ(state_of(mesh), state_of(copy));
}

TEST(FlipBatch, PutsAnEdgeThatMeetsAnEarlierOneOff) {
  EditMesh mesh = edit_mesh(hexagon_of_triangles());
  const HalfedgeId first = mesh.find(VertexId(2), VertexId(3));
  const HalfedgeId second = mesh.find(VertexId(3), VertexId(0));
  const HalfedgeId outside = mesh.find(VertexId(0), VertexId(2));
  const EditBatch batch = mesh.flip_batch(std::vector{first, outside, second}, Execution::serial());
  EXPECT_EQ(batch.done, std::vector{first});
  EXPECT_EQ(batch.rest, std::vector{second});
  EXPECT_EQ(batch.refused, std::vector{outside});
  EXPECT_EQ(find_fault(mesh), "");
}

TEST(FlipBatch, MakesAnEdgeOnce) {
  // Two edges, 0 1 and 2 3, each between triangles with 4 and 5 across.
  const PlainFaces list{{{0, 1, 4}, {1, 0, 5}, {2, 3, 4}, {3, 2, 5}, {1, 2, 4}, {2, 1, 5}}, 6};
  EditMesh mesh = edit_mesh(list);
  const HalfedgeId a = mesh.find(VertexId(0), VertexId(1));
  const HalfedgeId b = mesh.find(VertexId(2), VertexId(3));
  const EditBatch batch = mesh.flip_batch(std::vector{b, a}, Execution::serial());
  EXPECT_EQ(batch.done, std::vector{b});
  EXPECT_EQ(batch.rest, std::vector{a});
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_EQ(mesh.flip_batch(batch.rest, Execution::serial()).refused, std::vector{a});
}

TEST(FlipBatch, IsTheSameAsOneByOneForEveryThreadCount) {
  for (const int threads : kThreadCounts) {
    Threads arena(threads);
    for (const bool is_recording : {false, true}) {
      EditMesh mesh = edit_mesh(cut_torus(8));
      EditMesh copy = edit_mesh(cut_torus(8));
      mesh.set_recording(is_recording);
      for (std::uint64_t round = 0; round < 40; ++round) {
        std::vector<HalfedgeId> wanted = shuffled_edges(mesh, round);
        wanted.resize(1 + round * 4);
        expect_the_same(mesh, copy, wanted, arena.execution(5));
      }
      EXPECT_EQ(find_fault(mesh), "");
    }
  }
}

TEST(FlipBatch, IsTakenBackAndDoneAgainAsOneChange) {
  EditMesh mesh = edit_mesh(cut_torus(6));
  EditMesh copy = edit_mesh(cut_torus(6));
  const EditState before = state_of(mesh);
  const EditBatch batch = mesh.flip_batch(shuffled_edges(mesh, 3), Execution::serial());
  ASSERT_GT(batch.done.size(), 5U);
  const Change change = *batch.change;
  ASSERT_TRUE(copy.replay(change));
  EXPECT_EQ(state_of(copy), state_of(mesh));
  ASSERT_TRUE(mesh.undo(change));
  EXPECT_EQ(state_of(mesh), before);
}

TEST(FlipBatch, CannotBeTakenBackWithoutARecord) {
  EditMesh mesh = edit_mesh(cut_torus(4));
  mesh.set_recording(false);
  const Change change = *mesh.flip_batch(shuffled_edges(mesh, 1), Execution::serial()).change;
  EXPECT_EQ(mesh.undo(change).reason, Refusal::other_state);
}

}  // namespace
}  // namespace hedgerow::test
