// Edits of all kinds, at random, on small meshes: each leaves a sound mesh or nothing changed, can
// be taken back and done again.
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/edit.h"
#include "hedgerow/validate.h"
#include "support/edit_soundness.h"
#include "support/random_faces.h"

namespace hedgerow::test {
namespace {

constexpr int kKinds = 14;
constexpr const char* kNames[kKinds] = {
    "flip",       "insert_vertex", "split_edge",   "split_face", "connect",
    "join_faces", "collapse",      "split_vertex", "add_vertex", "remove_vertex",
    "add_face",   "remove_face",   "cut",          "zip"};

/// What is counted of a mesh.
struct Counts {
  Index vertices = 0;
  Index edges = 0;
  Index faces = 0;
  [[nodiscard]] Index euler() const { return vertices - edges + faces; }
};
Counts counts_of(const EditMesh& mesh) {
  Counts counts;
  for (Index v = 0; v < mesh.vertex_count(); ++v) counts.vertices += mesh.has(VertexId(v));
  for (Index h = 0; h < mesh.halfedge_count(); ++h) counts.edges += mesh.has(HalfedgeId(h));
  for (Index f = 0; f < mesh.face_count(); ++f) counts.faces += mesh.has(FaceId(f));
  counts.edges /= 2;
  return counts;
}

/// Edits a mesh at random, with elements that are there most of the time.
class Editor {
 public:
  Editor(EditMesh& mesh, Random& random) : mesh_(mesh), random_(random) {}

  EditResult edit(int kind) {
    const HalfedgeId h = halfedge();
    switch (kind) {
      case 0:
        return mesh_.flip(h);
      case 1:
        return mesh_.insert_vertex(h);
      case 2:
        return mesh_.split_edge(h);
      case 3:
        return mesh_.split_face(face());
      case 4:
        return mesh_.connect(h, along_face(h));
      case 5:
        return mesh_.join_faces(h);
      case 6:
        return mesh_.collapse(h);
      case 7:
        return mesh_.split_vertex(h, round_vertex(h));
      case 8:
        return mesh_.add_vertex();
      case 9:
        return mesh_.remove_vertex(vertex());
      case 10:
        return mesh_.add_face(corners());
      case 11:
        return mesh_.remove_face(face());
      case 12:
        return mesh_.cut(path(h));
      default:
        return mesh_.zip(boundary(h));
    }
  }

 private:
  template <class Id>
  Id any(Index count) {
    for (int tries = 0; tries < 20 && count > 0; ++tries) {
      const Id id(random_.below(count));
      if (mesh_.has(id) || random_.one_in(50)) return id;
    }
    return Id(random_.one_in(2) ? Index{-1} : count);
  }
  HalfedgeId halfedge() { return any<HalfedgeId>(mesh_.halfedge_count()); }
  VertexId vertex() { return any<VertexId>(mesh_.vertex_count()); }
  FaceId face() { return any<FaceId>(mesh_.face_count()); }
  HalfedgeId along_face(HalfedgeId h) {
    if (!mesh_.has(h) || random_.one_in(20)) return halfedge();
    for (int steps = random_.below(6); steps > 0; --steps) h = mesh_.view().next(h);
    return h;
  }
  HalfedgeId round_vertex(HalfedgeId h) {
    if (!mesh_.has(h) || random_.one_in(20)) return halfedge();
    const EditView view = mesh_.view();
    for (int steps = random_.below(6); steps > 0; --steps) h = view.next(view.opposite[h]);
    return h;
  }
  HalfedgeId boundary(HalfedgeId h) {
    for (int tries = 0; tries < 30; ++tries) {
      if (mesh_.has(h) && !mesh_.view().face(h).valid()) return h;
      h = halfedge();
    }
    return h;
  }
  std::vector<HalfedgeId> path(HalfedgeId h) {
    std::vector<HalfedgeId> path;
    if (!mesh_.has(h)) return {h};
    for (int steps = 1 + random_.below(4); steps > 0; --steps) {
      path.push_back(h);
      if (!mesh_.has(h)) break;
      h = round_vertex(mesh_.view().next(h));
    }
    return path;
  }
  // Most often along a hole, where a face fits.
  std::vector<VertexId> corners() {
    const HalfedgeId start = boundary(halfedge());
    std::vector<VertexId> corners;
    if (mesh_.has(start) && !random_.one_in(3)) {
      HalfedgeId h = start;
      for (int n = 2 + random_.below(3); n > 0; --n, h = mesh_.view().next(h)) {
        corners.push_back(mesh_.view().origin[h]);
      }
      if (random_.one_in(2)) corners.push_back(vertex());
      return corners;
    }
    for (int n = 2 + random_.below(4); n > 0; --n) corners.push_back(vertex());
    return corners;
  }

  EditMesh& mesh_;
  Random& random_;
};

/// How the Euler characteristic changes; 99: it depends.
int euler_step(int kind) {
  switch (kind) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
    case 5:
    case 6:
    case 7:
      return 0;
    case 8:
      return 1;
    default:
      return 99;
  }
}

class RandomEdits : public ::testing::TestWithParam<int> {};

TEST_P(RandomEdits, LeaveASoundMeshOrNothingChanged) {
  std::vector<int> done(kKinds, 0);
  for (std::uint64_t round = 0; round < 400 && !HasFailure(); ++round) {
    const std::uint64_t seed = 1000 * static_cast<std::uint64_t>(GetParam()) + round;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ReferenceMesh reference = random_reference_mesh(seed);
    const ReferenceMesh start = seed % 2 == 0 ? reference : reference_closed(reference);
    auto made = EditMesh::of(to_connectivity(start), Execution::serial());
    ASSERT_TRUE(made);
    EditMesh& mesh = *made;
    const EditState first = state_of(mesh);
    const bool may_double = find_fault(mesh) != "";
    ASSERT_EQ(find_fault(mesh, may_double), "");
    Random random(seed);
    Editor editor(mesh, random);
    std::vector<Change> changes;
    for (int step = 0; step < 60; ++step) {
      const EditState before = state_of(mesh);
      const Counts counts = counts_of(mesh);
      const int kind = random.below(kKinds);
      SCOPED_TRACE("step " + std::to_string(step) + " " + kNames[kind]);
      const EditResult result = editor.edit(kind);
      if (!result) {
        ASSERT_TRUE(state_of(mesh) == before) << name(result.error().reason);
        continue;
      }
      ++done[static_cast<std::size_t>(kind)];
      ASSERT_EQ(find_fault(mesh, may_double), "");
      const Index step_of_euler = counts_of(mesh).euler() - counts.euler();
      if (euler_step(kind) != 99) {
        ASSERT_EQ(step_of_euler, euler_step(kind));
      }
      changes.push_back(**result);
      const EditState after = state_of(mesh);
      ASSERT_TRUE(mesh.undo(changes.back()));
      ASSERT_TRUE(state_of(mesh) == before);
      ASSERT_FALSE(mesh.undo(changes.back()) && !changes.back().writes.empty());
      ASSERT_TRUE(mesh.replay(changes.back()));
      ASSERT_TRUE(state_of(mesh) == after);
    }
    const auto compacted = mesh.compact();
    if (compacted) {
      EXPECT_TRUE(validate(compacted->mesh, Execution::serial()).empty());
      EXPECT_EQ(compacted->mesh.form(), start.form);
    } else {
      EXPECT_EQ(compacted.error().code, ErrorCode::not_canonical);
    }
    for (std::size_t i = changes.size(); i-- > 0;) ASSERT_TRUE(mesh.undo(changes[i]));
    EXPECT_TRUE(state_of(mesh) == first);
  }
  for (int kind = 0; kind < kKinds; ++kind) {
    EXPECT_GT(done[static_cast<std::size_t>(kind)], 50) << kNames[kind];
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomEdits, ::testing::Range(0, 4));

}  // namespace
}  // namespace hedgerow::test
