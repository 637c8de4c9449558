#include "hedgerow/fill_holes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/query.h"
#include "hedgerow/shapes.h"
#include "hedgerow/validate.h"
#include "support/edit_mesh.h"
#include "support/edit_soundness.h"
#include "support/meshes.h"
#include "support/plain_build.h"
#include "support/random_faces.h"

namespace hedgerow::test {
namespace {

/// Half of the length of the cross product, summed over faces from `first` on: of triangles.
double area_from(const EditMesh& mesh, const std::vector<float>& xyz, Index first) {
  const EditView view = mesh.view();
  double sum = 0;
  for (Index f = first; f < view.face_count(); ++f) {
    double p[3][3];
    int k = 0;
    for (const VertexId v : vertices(view, FaceId(f))) {
      for (int i = 0; i < 3; ++i) p[k % 3][i] = xyz[static_cast<std::size_t>(3 * v.value + i)];
      ++k;
    }
    EXPECT_EQ(k, 3);
    double u[3];
    double w[3];
    for (int i = 0; i < 3; ++i) {
      u[i] = p[1][i] - p[0][i];
      w[i] = p[2][i] - p[0][i];
    }
    sum += std::hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2],
                      u[0] * w[1] - u[1] * w[0]) /
           2;
  }
  return sum;
}

/// A pyramid over each side of a flat outline, so that the outline is its only hole.
struct Tent {
  PlainFaces list;
  std::vector<float> xyz;
};
Tent tent(const std::vector<float>& outline) {
  const auto n = static_cast<std::int64_t>(outline.size() / 2);
  Tent made{{{}, n + 1}, {}};
  for (std::int64_t i = 0; i < n; ++i) {
    made.list.faces.push_back({i, (i + 1) % n, n});
    made.xyz.insert(made.xyz.end(), {outline[static_cast<std::size_t>(2 * i)],
                                     outline[static_cast<std::size_t>(2 * i + 1)], 0});
  }
  made.xyz.insert(made.xyz.end(), {0, 0, 5});
  return made;
}

// The area of the filling is that of the outline only if no triangle lies outside or upon another.
TEST(FillHoles, CoversAFlatOutlineThatIsNotConvex) {
  const Tent made = tent({0, 0, 4, 0, 4, 3, 3, 3, 3, 1, 2, 1, 2, 3, 1, 3, 1, 1, 0, 1});
  EditMesh mesh = edit_mesh(made.list);
  const Index faces = mesh.face_count();
  const auto report = fill_holes(mesh, positions_of(made.xyz));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->found, 1);
  EXPECT_EQ(report->filled, 1);
  EXPECT_EQ(report->triangles, 8);
  EXPECT_EQ(mesh.face_count(), faces + 8);
  EXPECT_EQ(find_fault(mesh), "");
  EXPECT_DOUBLE_EQ(area_from(mesh, made.xyz, faces), 8);
  const auto compacted = mesh.compact();
  ASSERT_TRUE(compacted);
  EXPECT_EQ(boundary_loops(compacted->mesh).count(), 0);
  EXPECT_EQ(euler_characteristic(compacted->mesh, Execution::serial()), 2);
}

// All triangulations of a small hole in space, one by one: none has less area.
double least_area(const std::vector<float>& xyz, std::vector<std::size_t> corners) {
  if (corners.size() < 3) return 0;
  double least = std::numeric_limits<double>::infinity();
  const auto length = [&](std::size_t a, std::size_t b, std::size_t c) {
    double u[3];
    double w[3];
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = static_cast<double>(xyz[3 * b + i]) - static_cast<double>(xyz[3 * a + i]);
      w[i] = static_cast<double>(xyz[3 * c + i]) - static_cast<double>(xyz[3 * a + i]);
    }
    return std::hypot(u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2],
                      u[0] * w[1] - u[1] * w[0]) /
           2;
  };
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const auto middle = corners.begin() + static_cast<std::ptrdiff_t>(k);
    least = std::min(least, length(corners.front(), *middle, corners.back()) +
                                least_area(xyz, {corners.begin(), middle + 1}) +
                                least_area(xyz, {middle, corners.end()}));
  }
  return least;
}
TEST(FillHoles, FindsTheLeastAreaInSpace) {
  Random random(3);
  for (int n = 3; n <= 9; ++n) {
    for (int i = 0; i < 10; ++i) {
      std::vector<float> outline;
      for (int k = 0; k < 2 * n; ++k) outline.push_back(static_cast<float>(random.below(50)));
      Tent made = tent(outline);
      for (std::size_t v = 0; v < static_cast<std::size_t>(n); ++v) {
        made.xyz[3 * v + 2] = static_cast<float>(random.below(50));
      }
      EditMesh mesh = edit_mesh(made.list);
      const Index faces = mesh.face_count();
      ASSERT_EQ(fill_holes(mesh, positions_of(made.xyz))->filled, 1);
      std::vector<std::size_t> corners;
      for (std::size_t v = 0; v < static_cast<std::size_t>(n); ++v) corners.push_back(v);
      EXPECT_NEAR(area_from(mesh, made.xyz, faces), least_area(made.xyz, corners), 1e-6);
    }
  }
}

TEST(FillHoles, LeavesLongHolesAndCountsThem) {
  const Soup soup = *shapes::grid(6, 6);
  EditMesh mesh = std::move(
      *EditMesh::of(build(soup.face_list(), {}, Execution::serial())->mesh, Execution::serial()));
  const EditState before = state_of(mesh);
  const auto long_one = fill_holes(mesh, soup.positions(), {.max_edges = 23});
  ASSERT_TRUE(long_one);
  EXPECT_EQ(long_one->found, 1);
  EXPECT_EQ(long_one->too_long, 1);
  EXPECT_TRUE(state_of(mesh) == before);
  EXPECT_EQ(fill_holes(mesh, soup.positions(), {.max_edges = 24})->triangles, 22);
  EXPECT_EQ(find_fault(mesh), "");
}

TEST(FillHoles, RefusesWhatWouldDoubleAFace) {
  EditMesh mesh = edit_mesh({{{0, 1, 2}}, 3});
  const EditState before = state_of(mesh);
  const std::vector<float> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto report = fill_holes(mesh, positions_of(xyz));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->filled + report->refused, 1);
  EXPECT_EQ(find_fault(mesh), "");
  if (report->refused == 1) {
    EXPECT_TRUE(state_of(mesh) == before);
  }
}

TEST(FillHoles, LeavesRandomMeshesSound) {
  Index filled = 0;
  Index refused = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto built = build_plain(random_good_faces(seed));
    ASSERT_TRUE(built);
    EditMesh mesh = std::move(*EditMesh::of(built->mesh, Execution::serial()));
    const bool may_double = find_fault(mesh) != "";
    Random random(seed);
    std::vector<float> xyz;
    for (Index i = 0; i < 3 * mesh.vertex_count(); ++i) {
      xyz.push_back(static_cast<float>(random.below(100)));
    }
    const auto report = fill_holes(mesh, positions_of(xyz));
    ASSERT_TRUE(report);
    ASSERT_EQ(report->found, report->filled + report->too_long + report->refused);
    ASSERT_EQ(find_fault(mesh, may_double), "");
    const auto compacted = mesh.compact();
    ASSERT_TRUE(compacted);
    ASSERT_TRUE(validate(compacted->mesh, Execution::serial()).empty());
    ASSERT_EQ(compacted->mesh.halfedge_count(),
              built->mesh.halfedge_count() + 3 * report->triangles);
    filled += report->filled;
    refused += report->refused;
  }
  EXPECT_GT(filled, 500);
  EXPECT_GT(refused, 100);
}

TEST(FillHoles, RefusesPositionsThatDoNotFit) {
  EditMesh mesh = edit_mesh(hexagon_of_triangles());
  const std::vector<float> xyz(21, 0.0F);
  EXPECT_EQ(fill_holes(mesh, {xyz.data(), 6}).error().code, ErrorCode::count_mismatch);
  EXPECT_EQ(fill_holes(mesh, {xyz.data(), 7, 10}).error().code, ErrorCode::bad_stride);
  EXPECT_EQ(fill_holes(mesh, {nullptr, 7}).error().code, ErrorCode::null_pointer);
  const std::vector<float> nan(21, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(fill_holes(mesh, positions_of(nan))->refused, 1);
}

}  // namespace
}  // namespace hedgerow::test
