// What is packed after edits is the same on each path.
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/build.h"
#include "hedgerow/digest.h"
#include "hedgerow/edit.h"
#include "hedgerow/shapes.h"
#include "support/random_faces.h"

namespace hedgerow::test {
namespace {

// Triangles in the default form are packed by code of their own.
TEST(Compact, GivesTheSameMeshFromBothForms) {
  Random random(7);
  for (const Soup& soup : {*shapes::terrain(12, 9), *shapes::torus(9, 7), *shapes::grid(1, 1)}) {
    const Connectivity open = std::move(build(soup.face_list(), {}, Execution::serial())->mesh);
    const Connectivity closed = std::move(*close_boundary(open, Execution::serial()));
    EditMesh a = std::move(*EditMesh::of(open, Execution::serial()));
    EditMesh b = std::move(*EditMesh::of(closed, Execution::serial()));
    for (int step = 0; step < 300; ++step) {
      const HalfedgeId h(random.below(a.halfedge_count()));
      const int kind = static_cast<int>(random.below(3));
      const auto edit = [&](EditMesh& mesh) {
        if (kind == 0) return mesh.flip(h).has_value();
        if (kind == 1) return mesh.collapse(h).has_value();
        return mesh.has(h) && mesh.split_edge(h).has_value();
      };
      ASSERT_EQ(edit(a), edit(b));
    }
    const auto from_open = a.compact();
    const auto from_closed = b.compact();
    ASSERT_TRUE(from_open && from_closed);
    ASSERT_TRUE(from_open->mesh.is_implicit());
    const Connectivity opened = std::move(*open_boundary(from_closed->mesh, Execution::serial()));
    EXPECT_EQ(digest(from_open->mesh, Execution::serial()), digest(opened, Execution::serial()));
    EXPECT_EQ(from_open->maps.vertices, from_closed->maps.vertices);
    EXPECT_EQ(from_open->maps.faces, from_closed->maps.faces);
    std::vector<HalfedgeId> halfedges = from_closed->maps.halfedges;
    for (HalfedgeId& h : halfedges) {
      if (h.value >= opened.halfedge_count()) h = HalfedgeId();
    }
    EXPECT_EQ(from_open->maps.halfedges, halfedges);
  }
}

}  // namespace
}  // namespace hedgerow::test
