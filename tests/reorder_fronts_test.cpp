// ReorderMethod::fronts: what is particular to it. What holds for every method is in
// reorder_test.cpp.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/circulate.h"
#include "hedgerow/reorder.h"
#include "hedgerow/shapes.h"
#include "hedgerow/validate.h"
#include "support/plain_build.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"
#include "support/reorder_cases.h"

namespace hedgerow::test {
namespace {

// Random meshes: polygons, boundaries, bowties, bad edges, isolated vertices.
class FrontsOfRandomMeshes : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  FrontsOfRandomMeshes() {
    Random random(GetParam());
    const Connectivity mesh = to_connectivity(random_reference_mesh(GetParam()), random.one_in(2));
    const std::vector<float> xyz = random_positions(mesh.vertex_count(), random);
    Result<ReorderOutput> output = reorder(mesh, {xyz.data(), mesh.vertex_count()},
                                           ReorderMethod::fronts, Execution::serial());
    EXPECT_TRUE(output);
    faces_ = faces_of(output->mesh);
    neighbours_.resize(static_cast<std::size_t>(mesh.vertex_count()));
    for (const std::vector<Index>& face : faces_) {
      for (std::size_t k = 0; k < face.size(); ++k) {
        const Index v = face[k];
        const Index u = face[(k + 1) % face.size()];
        neighbours_[static_cast<std::size_t>(v)].push_back(u);
        neighbours_[static_cast<std::size_t>(u)].push_back(v);
      }
    }
  }

  std::vector<std::vector<Index>> faces_;
  std::vector<std::vector<Index>> neighbours_;
};
INSTANTIATE_TEST_SUITE_P(Seeds, FrontsOfRandomMeshes, ::testing::Range<std::uint64_t>(1, 400));

// What makes an order breadth-first: who is found later was not found by an earlier one, and a
// vertex without an earlier neighbour begins a component when all before it are done.
TEST_P(FrontsOfRandomMeshes, FindVerticesInTheOrderOfTheirFinders) {
  Index last_finder = 0;
  Index largest_seen = -1;  // of the neighbours of vertices so far
  bool is_isolated = false;
  for (std::size_t i = 0; i < neighbours_.size(); ++i) {
    const auto v = static_cast<Index>(i);
    const std::vector<Index>& around = neighbours_[i];
    EXPECT_FALSE(is_isolated && !around.empty()) << "isolated vertices come last";
    is_isolated = around.empty();
    if (is_isolated) continue;
    const Index finder = *std::min_element(around.begin(), around.end());
    if (finder < v) {
      EXPECT_LE(last_finder, finder);
      last_finder = finder;
    } else {
      EXPECT_LT(largest_seen, v) << "a component that begins before the last one ends";
      last_finder = v;
    }
    largest_seen = std::max(largest_seen, *std::max_element(around.begin(), around.end()));
  }
}

TEST_P(FrontsOfRandomMeshes, SortFacesByTheirTwoSmallestVertices) {
  std::vector<std::pair<Index, Index>> keys;
  for (std::vector<Index> face : faces_) {
    std::sort(face.begin(), face.end());
    keys.emplace_back(face[0], face[1]);
  }
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
}

// The order of a grid's own rows: of all corners at which its rings go on, few are unlike the one
// at the same step of the ring before.
TEST(Fronts, MakeRingsThatLieAlike) {
  const Result<Soup> soup = shapes::grid(100, 100);
  ASSERT_TRUE(soup);
  const Soup mixed = shapes::shuffled(*soup, 7);
  const auto changes = [](const Connectivity& mesh) {
    Index count = 0;
    std::vector<Index> last;
    const TriangleView view = mesh.triangles();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      std::vector<Index> corners;
      for (const HalfedgeId h : outgoing_halfedges(view, VertexId(v))) {
        corners.push_back(h.value % 3);
      }
      count += static_cast<Index>(corners != last);
      last = corners;
    }
    return static_cast<double>(count) / static_cast<double>(mesh.vertex_count());
  };
  const Connectivity mesh = built(mixed);
  const auto along = [&](ReorderMethod method) {
    return changes(reorder(mesh, mixed.positions(), method, Execution::serial())->mesh);
  };
  EXPECT_LT(changes(built(*soup)), 0.05);
  EXPECT_GT(along(ReorderMethod::hilbert), 0.5);
  EXPECT_LT(along(ReorderMethod::fronts), 0.1);
}

TEST(Fronts, FindTheirWayWherePositionsTellNothing) {
  const Result<Soup> soup = shapes::grid(60, 60);
  ASSERT_TRUE(soup);
  const Connectivity mesh = built(shapes::shuffled(*soup, 9));
  const std::vector<float> nowhere(static_cast<std::size_t>(3 * mesh.vertex_count()),
                                   std::numeric_limits<float>::quiet_NaN());
  const auto output = reorder(mesh, {nowhere.data(), mesh.vertex_count()}, ReorderMethod::fronts,
                              Execution::serial());
  ASSERT_TRUE(output);
  EXPECT_TRUE(validate(output->mesh, Execution::serial()).empty());
  EXPECT_LT(output->after.lines_per_face, 0.5);
}

}  // namespace
}  // namespace hedgerow::test
