// Batches of edits, and decimation in rounds, on plain threads.
#include <algorithm>
#include <initializer_list>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/decimate.h"
#include "hedgerow/edit.h"
#include "support/edit_soundness.h"
#include "support/plain_threads.h"

namespace hedgerow::test {
namespace {

// n x n squares, every third one whole and the others cut in two.
Connectivity patch(Index n) {
  std::vector<Index> corners;
  std::vector<Index> offsets = {0};
  const auto add = [&](std::initializer_list<Index> face) {
    corners.insert(corners.end(), face);
    offsets.push_back(static_cast<Index>(corners.size()));
  };
  for (Index y = 0; y < n; ++y) {
    for (Index x = 0; x < n; ++x) {
      const Index v = y * (n + 1) + x;
      const Index above = v + n + 1;
      if ((x + y) % 3 == 0) {
        add({v, v + 1, above + 1, above});
      } else {
        add({v, v + 1, above});
        add({v + 1, above + 1, above});
      }
    }
  }
  const FaceList faces = FaceList::polygons<Index>(corners, offsets, (n + 1) * (n + 1));
  return std::move(build(faces, {}, Execution::serial())->mesh);
}

EditBatch collapse(EditMesh& mesh, std::span<const HalfedgeId> edges, const Execution& execution) {
  return mesh.collapse_batch(edges, execution);
}
EditBatch split(EditMesh& mesh, std::span<const HalfedgeId> edges, const Execution& execution) {
  return mesh.split_batch(edges, execution);
}

// Rounds of one sort of batch, of all edges in any order; how many edits there were.
template <class Batch>
EditState after_rounds(const Connectivity& from, Batch* batch, const Execution& execution) {
  EditMesh mesh = std::move(*EditMesh::of(from, Execution::serial()));
  mesh.set_recording(false);
  std::mt19937 random(3);
  std::size_t done = 0;
  for (int round = 0; round < 3; ++round) {
    std::vector<HalfedgeId> edges;
    for (HalfedgeId h(0); h.value < mesh.halfedge_count(); ++h.value) {
      if (mesh.has(h) && h < mesh.view().opposite[h]) edges.push_back(h);
    }
    for (std::size_t i = edges.size(); i > 1; --i) std::swap(edges[i - 1], edges[random() % i]);
    done += batch(mesh, edges, execution).done.size();
  }
  EXPECT_GT(done, 1000U);
  return state_of(mesh);
}

TEST(EditRaces, CollapsesAndSplitsAsOneThreadDoes) {
  const Connectivity mesh = patch(100);
  for (const auto batch : {&collapse, &split}) {
    EXPECT_EQ(after_rounds(mesh, batch, Execution::serial()),
              after_rounds(mesh, batch, plain_threads().with_grain(7)));
  }
}

TEST(EditRaces, DecimatesAsOneThreadDoes) {
  const Connectivity mesh = patch(100);
  std::mt19937 random(5);
  std::vector<float> xyz;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    for (const Index i : {v % 101, v / 101}) xyz.push_back(static_cast<float>(i));
    xyz.push_back(static_cast<float>(random() % 64) / 64);
  }
  DecimateOptions options;
  options.faces = mesh.face_count() / 4;
  options.order = DecimateOrder::rounds;
  options.part_vertices = 300;
  const auto decimated = [&](const Execution& execution) {
    return std::move(*decimate(mesh, {xyz.data(), mesh.vertex_count()}, options, execution));
  };
  const DecimateOutput serial = decimated(Execution::serial());
  const DecimateOutput shared = decimated(plain_threads().with_grain(500));
  EXPECT_GT(serial.accepted, 1000);
  EXPECT_EQ(shared.accepted, serial.accepted);
  EXPECT_TRUE(std::ranges::equal(shared.positions, serial.positions));
  EXPECT_TRUE(std::ranges::equal(shared.maps.halfedges, serial.maps.halfedges));
}

}  // namespace
}  // namespace hedgerow::test
