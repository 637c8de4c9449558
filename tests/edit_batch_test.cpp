// Many collapses and many splits at once are the same edits one after the other.
#include <algorithm>
#include <cstdint>
#include <new>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/edit.h"
#include "hedgerow/validate.h"
#include "support/allocations.h"
#include "support/edit_soundness.h"
#include "support/meshes.h"
#include "support/plain_build.h"
#include "support/random_faces.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

enum class Kind { collapse, split };
constexpr Kind kKinds[] = {Kind::collapse, Kind::split};

EditCheck can_do(const EditMesh& mesh, Kind kind, HalfedgeId h) {
  return kind == Kind::collapse ? mesh.can_collapse(h) : mesh.can_split_edge(h);
}
EditBatch do_batch(EditMesh& mesh, Kind kind, const std::vector<HalfedgeId>& wanted,
                   const Execution& execution) {
  return kind == Kind::collapse ? mesh.collapse_batch(wanted, execution)
                                : mesh.split_batch(wanted, execution);
}

// A patch of quads, wrapped round in so many directions, some of them cut in two triangles.
PlainFaces patch(Random& random, std::int64_t n, int wraps, bool has_quads, bool has_triangles) {
  const std::int64_t columns = wraps > 0 ? n : n + 1;
  const std::int64_t rows = wraps > 1 ? n : n + 1;
  PlainFaces list{{}, columns * rows};
  const auto at = [&](std::int64_t i, std::int64_t j) { return i % columns * rows + j % rows; };
  for (std::int64_t i = 0; i < n; ++i) {
    for (std::int64_t j = 0; j < n; ++j) {
      if (has_quads && (!has_triangles || random.one_in(2))) {
        list.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      } else {
        list.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        list.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return list;
}

// Meshes of all sorts, in both forms; holes of three and more edges.
Connectivity mesh_of(std::uint64_t seed) {
  Random random(seed);
  PlainFaces list =
      patch(random, 5 + random.below(5), random.below(3), seed % 3 != 0, seed % 3 != 1);
  if (seed % 4 == 3) {
    const std::size_t holes = 1 + random.below(std::size_t{6});
    random.shuffle(list.faces);
    list.faces.resize(list.faces.size() - holes);
  }
  Connectivity mesh = std::move(build_plain(list)->mesh);
  if (seed % 2 == 0) return mesh;
  return std::move(*close_boundary(mesh, Execution::serial()));
}
EditMesh edit_mesh_of(std::uint64_t seed) {
  return std::move(*EditMesh::of(mesh_of(seed), Execution::serial()));
}
std::vector<HalfedgeId> random_edges(const EditMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  std::vector<HalfedgeId> edges;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const HalfedgeId o = mesh.view().opposite[HalfedgeId(h)];
    if (mesh.has(HalfedgeId(h)) && h < o.value) {
      edges.push_back(random.one_in(2) ? HalfedgeId(h) : o);
    }
  }
  random.shuffle(edges);
  edges.resize(1 + random.below(edges.size()));
  return edges;
}

// Which two vertices have a face or an edge in common, from all faces and half-edges.
std::set<std::pair<VertexId, VertexId>> near_pairs(const EditMesh& mesh) {
  const EditView view = mesh.view();
  std::set<std::pair<VertexId, VertexId>> pairs;
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    const HalfedgeId h(i);
    if (!mesh.has(h)) continue;
    pairs.emplace(view.origin[h], view.origin[h]);
    pairs.emplace(view.origin[h], view.target(h));
    if (!view.face(h).valid()) continue;
    for (HalfedgeId g = view.next(h); g != h; g = view.next(g)) {
      pairs.emplace(view.origin[h], view.origin[g]);
    }
  }
  return pairs;
}

// In order: what stands in the way of none that was done is done, by itself.
struct CollapsedOneByOne {
  std::vector<HalfedgeId> done;
  std::vector<HalfedgeId> rest;
  std::vector<HalfedgeId> refused;
};
CollapsedOneByOne collapse_one_by_one(EditMesh& mesh, const std::vector<HalfedgeId>& wanted) {
  CollapsedOneByOne plain;
  const auto pairs = near_pairs(mesh);
  std::vector<std::pair<HalfedgeId, std::pair<VertexId, VertexId>>> possible;
  for (const HalfedgeId h : wanted) {
    if (mesh.can_collapse(h)) {
      possible.push_back({h, {mesh.view().origin[h], mesh.view().target(h)}});
    } else {
      plain.refused.push_back(h);
    }
  }
  std::vector<VertexId> ends;
  for (const auto& [h, edge] : possible) {
    const auto [a, b] = edge;
    const bool meets = std::any_of(ends.begin(), ends.end(), [&, a = a, b = b](VertexId v) {
      return pairs.count({a, v}) + pairs.count({b, v}) > 0;
    });
    if (meets) {
      plain.rest.push_back(h);
      continue;
    }
    EXPECT_TRUE(mesh.collapse(h)) << h.value;
    plain.done.push_back(h);
    ends.insert(ends.end(), {a, b});
  }
  return plain;
}
CollapsedOneByOne split_one_by_one(EditMesh& mesh, const std::vector<HalfedgeId>& wanted) {
  struct Asked {
    HalfedgeId h;
    HalfedgeId o;
    std::vector<FaceId> triangles;
  };
  CollapsedOneByOne plain;
  std::vector<Asked> possible;
  for (const HalfedgeId h : wanted) {
    if (!mesh.can_split_edge(h)) {
      plain.refused.push_back(h);
      continue;
    }
    const EditView view = mesh.view();
    possible.push_back({h, view.opposite[h], {}});
    for (const HalfedgeId side : {h, view.opposite[h]}) {
      const FaceId f = view.face(side);
      if (f.valid() && view.degree(f) == 3) possible.back().triangles.push_back(f);
    }
  }
  std::set<FaceId> cut;
  std::set<HalfedgeId> split;
  for (const Asked& asked : possible) {
    bool meets = split.count(asked.h) != 0;
    for (const FaceId f : asked.triangles) meets |= cut.count(f) != 0;
    if (meets) {
      plain.rest.push_back(asked.h);
      continue;
    }
    EXPECT_TRUE(mesh.split_edge(asked.h)) << asked.h.value;
    plain.done.push_back(asked.h);
    split.insert({asked.h, asked.o});
    cut.insert(asked.triangles.begin(), asked.triangles.end());
  }
  return plain;
}
CollapsedOneByOne one_by_one(EditMesh& mesh, Kind kind, const std::vector<HalfedgeId>& wanted) {
  return kind == Kind::collapse ? collapse_one_by_one(mesh, wanted)
                                : split_one_by_one(mesh, wanted);
}

void expect_sound(const EditMesh& mesh, std::uint64_t seed) {
  ASSERT_EQ(find_fault(mesh), "") << "seed " << seed;
  const Result<Compacted> compacted = mesh.compact();
  ASSERT_TRUE(compacted) << "seed " << seed;
  const auto violations = validate(compacted->mesh, Execution::serial());
  ASSERT_TRUE(violations.empty()) << "seed " << seed << ": " << violations.front().relation;
}

class EditBatches : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(, EditBatches, ::testing::ValuesIn(kKinds),
                         [](const ::testing::TestParamInfo<Kind>& kind) {
                           return kind.param == Kind::collapse ? "Collapse" : "Split";
                         });

TEST_P(EditBatches, AreTheSameAsOneByOneForEveryThreadCount) {
  for (const int threads : kThreadCounts) {
    Threads arena(threads);
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
      EditMesh mesh = edit_mesh_of(seed);
      EditMesh copy = edit_mesh_of(seed);
      mesh.set_recording(seed % 5 == 0);
      std::size_t done = 0;
      for (std::uint64_t round = 0; round < 3; ++round) {
        const std::vector<HalfedgeId> wanted = random_edges(mesh, 10 * seed + round);
        const CollapsedOneByOne plain = one_by_one(copy, GetParam(), wanted);
        const EditBatch batch = do_batch(mesh, GetParam(), wanted, arena.execution(3));
        ASSERT_EQ(batch.done, plain.done) << "seed " << seed;
        ASSERT_EQ(batch.rest, plain.rest) << "seed " << seed;
        ASSERT_EQ(batch.refused, plain.refused) << "seed " << seed;
        ASSERT_EQ(state_of(mesh), state_of(copy)) << "seed " << seed;
        expect_sound(mesh, seed);
        done += batch.done.size();
      }
      EXPECT_GT(done, 1U) << "seed " << seed;
    }
  }
}

TEST_P(EditBatches, AreTakenBackAndDoneAgainAsOneChange) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    EditMesh mesh = edit_mesh_of(seed);
    EditMesh copy = edit_mesh_of(seed);
    const EditState before = state_of(mesh);
    const EditBatch batch =
        do_batch(mesh, GetParam(), random_edges(mesh, seed), Execution::serial());
    ASSERT_GT(batch.done.size(), 0U) << "seed " << seed;
    const Change change = *batch.change;
    ASSERT_TRUE(copy.replay(change));
    EXPECT_EQ(state_of(copy), state_of(mesh));
    ASSERT_TRUE(mesh.undo(change));
    EXPECT_EQ(state_of(mesh), before);
  }
}

TEST_P(EditBatches, CannotBeTakenBackWithoutARecord) {
  EditMesh mesh = edit_mesh_of(2);
  mesh.set_recording(false);
  const Change change =
      *do_batch(mesh, GetParam(), random_edges(mesh, 1), Execution::serial()).change;
  EXPECT_EQ(mesh.undo(change).reason, Refusal::other_state);
}

TEST_P(EditBatches, RefuseWhatDoesNotExist) {
  EditMesh mesh = edit_mesh_of(6);
  const HalfedgeId gone = [&] {
    for (Index h = 0;; ++h) {
      if (mesh.collapse(HalfedgeId(h))) return HalfedgeId(h);
    }
  }();
  const std::vector<HalfedgeId> broken = {HalfedgeId(), HalfedgeId(-5), gone,
                                          HalfedgeId(mesh.halfedge_count()), HalfedgeId(kMaxCount)};
  std::vector<HalfedgeId> wanted = broken;
  const std::vector<HalfedgeId> good = random_edges(mesh, 3);
  for (std::size_t i = 0; i < good.size(); ++i) {
    wanted.insert(wanted.begin() + static_cast<std::ptrdiff_t>(std::min(2 * i, wanted.size())),
                  good[i]);
  }
  const EditBatch batch = do_batch(mesh, GetParam(), wanted, Execution::serial());
  for (const HalfedgeId h : broken) {
    EXPECT_EQ(std::count(batch.refused.begin(), batch.refused.end(), h), 1) << h.value;
  }
  EXPECT_EQ(batch.done.size() + batch.rest.size() + batch.refused.size(), wanted.size());
  expect_sound(mesh, 6);
}

TEST_P(EditBatches, DoAnEdgeThatIsGivenTwiceOnce) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    EditMesh mesh = edit_mesh_of(seed);
    const std::vector<HalfedgeId> edges = random_edges(mesh, 1);
    const auto possible = std::find_if(edges.begin(), edges.end(), [&](HalfedgeId h) {
      return can_do(mesh, GetParam(), h) && can_do(mesh, GetParam(), mesh.view().opposite[h]);
    });
    ASSERT_NE(possible, edges.end());
    const std::vector<HalfedgeId> wanted = {*possible, *possible, mesh.view().opposite[*possible]};
    const EditBatch batch = do_batch(mesh, GetParam(), wanted, Execution::serial());
    EXPECT_EQ(batch.done, std::vector{wanted[0]});
    EXPECT_EQ(batch.rest, (std::vector{wanted[1], wanted[2]}));
    expect_sound(mesh, seed);
  }
}

TEST_P(EditBatches, OfNothingChangeNothing) {
  EditMesh mesh = edit_mesh_of(1);
  const EditState before = state_of(mesh);
  const EditBatch batch = do_batch(mesh, GetParam(), {}, Execution::serial());
  EXPECT_TRUE(batch.done.empty() && batch.rest.empty() && batch.refused.empty());
  EXPECT_EQ(state_of(mesh), before);
}

// Each allocation of a batch fails once: before the last of them nothing has been written.
TEST_P(EditBatches, ChangeNothingWhereThereIsNoMemory) {
  for (const bool is_recording : {false, true}) {
    EditMesh mesh = edit_mesh_of(4);
    mesh.set_recording(is_recording);
    const EditState before = state_of(mesh);
    const std::vector<HalfedgeId> wanted = random_edges(mesh, 2);
    int failures = 0;
    for (bool is_done = false; !is_done;) {
      try {
        const FailingAllocation failing(failures);
        is_done = !do_batch(mesh, GetParam(), wanted, Execution::serial()).done.empty();
      } catch (const std::bad_alloc&) {
        ++failures;
        ASSERT_EQ(state_of(mesh), before) << failures;
      }
    }
    EXPECT_GT(failures, 5);
    EXPECT_NE(state_of(mesh), before);
    expect_sound(mesh, 4);
  }
}

// A hole of so many edges round which everything would like to go.
TEST(CollapseBatch, LeavesEachHoleThreeEdges) {
  for (std::int64_t n = 4; n < 16; ++n) {
    // A ring of quads, cut in two, inside of which is the hole.
    PlainFaces list{{}, 2 * n};
    for (std::int64_t i = 0; i < n; ++i) {
      const std::int64_t j = (i + 1) % n;
      list.faces.push_back({i, j, n + j});
      list.faces.push_back({i, n + j, n + i});
    }
    EditMesh mesh = std::move(*EditMesh::of(build_plain(list)->mesh, Execution::serial()));
    std::vector<HalfedgeId> around;
    for (std::int64_t i = 0; i < n; ++i) {
      around.push_back(
          mesh.find(VertexId(static_cast<Index>(i)), VertexId(static_cast<Index>((i + 1) % n))));
    }
    EditBatch batch = mesh.collapse_batch(around, Execution::serial());
    EXPECT_EQ(batch.done.size(), static_cast<std::size_t>(n / 3)) << n;
    while (!batch.done.empty()) {
      batch = mesh.collapse_batch(batch.rest, Execution::serial());
      ASSERT_EQ(find_fault(mesh), "") << n;
    }
    const EditView view = mesh.view();
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      if (!mesh.has(HalfedgeId(h)) || view.face(HalfedgeId(h)).valid()) continue;
      EXPECT_NE(view.next(view.next(HalfedgeId(h))), HalfedgeId(h));
    }
  }
}

TEST(SplitBatch, NumbersNewElementsInTheOrderOfTheList) {
  EditMesh mesh = edit_mesh_of(6);
  const Index first = mesh.vertex_count();
  std::vector<HalfedgeId> wanted = random_edges(mesh, 9);
  const std::vector<std::pair<VertexId, VertexId>> ends = [&] {
    std::vector<std::pair<VertexId, VertexId>> pairs;
    EditMesh copy = edit_mesh_of(6);
    wanted = copy.split_batch(wanted, Execution::serial()).done;
    for (const HalfedgeId h : wanted) {
      pairs.emplace_back(mesh.view().origin[h], mesh.view().target(h));
    }
    return pairs;
  }();
  ASSERT_EQ(mesh.split_batch(wanted, Execution::serial()).done, wanted);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const VertexId v(first + static_cast<Index>(i));
    EXPECT_EQ(mesh.view().target(wanted[i]), v);
    EXPECT_TRUE(mesh.find(v, ends[i].first).valid());
    EXPECT_TRUE(mesh.find(v, ends[i].second).valid());
  }
}

}  // namespace
}  // namespace hedgerow::test
