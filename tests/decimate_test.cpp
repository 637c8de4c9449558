#include "hedgerow/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/circulate.h"
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

struct Invariants {
  std::int64_t euler;
  std::size_t loops;
  friend bool operator==(const Invariants&, const Invariants&) = default;
};
Invariants invariants_of(const Connectivity& mesh) {
  return {euler_characteristic(mesh, Execution::serial()),
          static_cast<std::size_t>(boundary_loops(mesh).count())};
}

std::array<double, 3> point(const Positions& positions, Index v) {
  const float* p = positions[v];
  return {p[0], p[1], p[2]};
}
/// The positions of the corners, face by face.
std::vector<std::vector<std::array<double, 3>>> corners_of(const Connectivity& mesh,
                                                           const Positions& positions) {
  const EditMesh edited = std::move(*EditMesh::of(mesh, Execution::serial()));
  const EditView view = edited.view();
  std::vector<std::vector<std::array<double, 3>>> faces;
  for (Index f = 0; f < view.face_count(); ++f) {
    faces.emplace_back();
    for (const VertexId v : vertices(view, FaceId(f))) {
      faces.back().push_back(point(positions, v.value));
    }
  }
  return faces;
}
double area_of(const Connectivity& mesh, const Positions& positions) {
  double area = 0;
  for (const auto& p : corners_of(mesh, positions)) {
    for (std::size_t k = 2; k < p.size(); ++k) {
      std::array<double, 3> u{};
      std::array<double, 3> v{};
      for (std::size_t i = 0; i < 3; ++i) {
        u[i] = p[k - 1][i] - p[0][i];
        v[i] = p[k][i] - p[0][i];
      }
      area += std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                         u[0] * v[1] - u[1] * v[0]) /
              2;
    }
  }
  return area;
}

TEST(Decimate, LeavesAsManyFacesAsAsked) {
  for (const Soup& soup : {*shapes::torus(24, 12), *shapes::terrain(20, 20), *shapes::icosphere(3),
                           *shapes::gyroid(8)}) {
    const Connectivity mesh = built(soup);
    for (const std::int64_t faces : {mesh.face_count() / 2, mesh.face_count() / 5}) {
      const DecimateOutput output = decimated(mesh, soup.positions(), {.faces = faces});
      EXPECT_EQ(output.end, DecimateEnd::faces);
      EXPECT_LE(output.mesh.face_count(), faces);
      EXPECT_GE(output.mesh.face_count(), faces - 1);
      const auto violations = validate(output.mesh, Execution::serial());
      ASSERT_TRUE(violations.empty()) << violations.front().relation;
      EXPECT_EQ(invariants_of(output.mesh), invariants_of(mesh));
      EXPECT_EQ(mesh.vertex_count() - output.collapses, output.mesh.vertex_count());
    }
  }
}

TEST(Decimate, DoesNothingWhereThereAreFewFacesAlready) {
  const Soup soup = *shapes::torus(6, 5);
  const Connectivity mesh = built(soup);
  const DecimateOutput output = decimated(mesh, soup.positions(), {.faces = mesh.face_count()});
  EXPECT_EQ(output.collapses, 0);
  EXPECT_EQ(digest(output.mesh, Execution::serial()), digest(mesh, Execution::serial()));
  EXPECT_TRUE(std::equal(soup.xyz.begin(), soup.xyz.end(), output.positions.begin()));
}

// A flat square costs nothing to take apart, but for its four corners.
TEST(Decimate, LeavesTwoTrianglesOfAFlatSquare) {
  Soup soup = *shapes::grid(16, 16);
  for (std::size_t i = 2; i < soup.xyz.size(); i += 3) soup.xyz[i] = 0;
  const Connectivity mesh = built(soup);
  const DecimateOutput output = decimated(mesh, soup.positions(), {.faces = 2});
  EXPECT_EQ(output.mesh.face_count(), 2);
  EXPECT_NEAR(area_of(output.mesh, positions_of(output)), area_of(mesh, soup.positions()),
              0.02 * area_of(mesh, soup.positions()));
}

TEST(Decimate, KeepsASphereRound) {
  const Soup soup = *shapes::icosphere(5);
  const DecimateOutput output =
      decimated(built(soup), soup.positions(), {.faces = soup.face_count() / 20});
  const Positions positions = positions_of(output);
  for (Index v = 0; v < output.mesh.vertex_count(); ++v) {
    const auto p = point(positions, v);
    EXPECT_NEAR(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]), 1, 0.01) << v;
  }
  EXPECT_NEAR(area_of(output.mesh, positions), 4 * 3.14159265, 0.15);
}

// The plainest way: evaluate all edges, take the cheapest that is allowed, begin anew.
struct Plane {
  std::array<double, 4> abcd;
  double weight;
};
class PlainDecimation {
 public:
  PlainDecimation(const Connectivity& mesh, const Positions& positions)
      : mesh_(std::move(*EditMesh::of(mesh, Execution::serial()))),
        planes_(static_cast<std::size_t>(mesh.vertex_count())) {
    const EditView view = mesh_.view();
    for (Index v = 0; v < mesh.vertex_count(); ++v) place_.push_back(point(positions, v));
    for (Index f = 0; f < view.face_count(); ++f) {
      std::vector<std::size_t> corners;
      for (const VertexId v : vertices(view, FaceId(f))) {
        corners.push_back(static_cast<std::size_t>(v.value));
      }
      const auto& a = place_[corners[0]];
      const auto& b = place_[corners[1]];
      const auto& c = place_[corners[2]];
      const std::array<double, 3> n = {
          (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]),
          (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]),
          (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])};
      const double length = std::hypot(n[0], n[1], n[2]);
      const Plane plane{{n[0] / length, n[1] / length, n[2] / length,
                         -(n[0] * a[0] + n[1] * a[1] + n[2] * a[2]) / length},
                        length};
      for (const std::size_t v : corners) {
        planes_[v].push_back(plane);
        // Three planes at right angles are a point.
        for (std::size_t k = 0; k < 3; ++k) {
          Plane at_point{{0, 0, 0, -place_[v][k]}, 1e-3 * length};
          at_point.abcd[k] = 1;
          planes_[v].push_back(at_point);
        }
      }
    }
  }
  // The sum of the planes' weights times squared distances at the best of many places near by.
  [[nodiscard]] double cost(Index h) const {
    const EditView view = mesh_.view();
    std::vector<Plane> all = planes_[at(view.origin[HalfedgeId(h)])];
    const auto& more = planes_[at(view.target(HalfedgeId(h)))];
    all.insert(all.end(), more.begin(), more.end());
    std::array<double, 3> x = place_[at(view.target(HalfedgeId(h)))];
    // One coordinate after the other, until nothing moves: slow, and without a matrix.
    for (int round = 0; round < 400; ++round) {
      for (std::size_t k = 0; k < 3; ++k) {
        double slope = 0;
        double curve = 0;
        for (const Plane& plane : all) {
          slope += plane.weight * plane.abcd[k] * distance(plane, x);
          curve += plane.weight * plane.abcd[k] * plane.abcd[k];
        }
        if (curve > 0) x[k] -= slope / curve;
      }
    }
    double sum = 0;
    for (const Plane& plane : all) sum += plane.weight * distance(plane, x) * distance(plane, x);
    return sum;
  }
  [[nodiscard]] double least_cost() const {
    double least = std::numeric_limits<double>::infinity();
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      if (mesh_.can_collapse(HalfedgeId(h))) least = std::min(least, cost(h));
    }
    return least;
  }

 private:
  static std::size_t at(VertexId v) { return static_cast<std::size_t>(v.value); }
  static double distance(const Plane& plane, const std::array<double, 3>& x) {
    return plane.abcd[0] * x[0] + plane.abcd[1] * x[1] + plane.abcd[2] * x[2] + plane.abcd[3];
  }

  EditMesh mesh_;
  std::vector<std::array<double, 3>> place_;
  std::vector<std::vector<Plane>> planes_;
};

TEST(Decimate, TakesTheCheapestEdgeToASixteenth) {
  for (const Soup& soup : {*shapes::icosphere(1), *shapes::torus(8, 6)}) {
    const Connectivity mesh = built(soup);
    const DecimateOutput output =
        decimated(mesh, soup.positions(), {.faces = mesh.face_count() - 1});
    ASSERT_EQ(output.collapses, 1);
    const double least = PlainDecimation(mesh, soup.positions()).least_cost();
    EXPECT_GE(output.largest_cost, least * (1 - 1e-4));
    EXPECT_LE(output.largest_cost, least * (1 + 1.0 / 16) * (1 + 1e-4));
  }
}

TEST(Decimate, StopsWhereItCostsTooMuch) {
  const Soup soup = *shapes::icosphere(3);
  const Connectivity mesh = built(soup);
  const DecimateOutput free = decimated(mesh, soup.positions(), {.faces = mesh.face_count() / 4});
  const DecimateOutput held =
      decimated(mesh, soup.positions(), {.faces = 0, .max_cost = free.largest_cost / 4});
  EXPECT_EQ(held.end, DecimateEnd::max_cost);
  EXPECT_LE(held.largest_cost, free.largest_cost / 4);
  EXPECT_GT(held.mesh.face_count(), free.mesh.face_count());
  EXPECT_EQ(decimated(mesh, soup.positions(), {.faces = 0, .max_cost = -1}).collapses, 0);
}

TEST(Decimate, EndsAtWhatCannotBeCollapsed) {
  const auto built = build_plain(tetrahedron());
  const std::vector<float> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const DecimateOutput output = decimated(built->mesh, {xyz.data(), 4}, {.faces = 0});
  EXPECT_EQ(output.end, DecimateEnd::refused);
  EXPECT_EQ(output.mesh.face_count(), 4);
  EXPECT_EQ(output.collapses, 0);
}

TEST(Decimate, TurnsNoCornerOver) {
  const Soup soup = *shapes::terrain(24, 24, 3);
  const DecimateOutput output = decimated(built(soup), soup.positions(), {.faces = 60});
  const auto faces = corners_of(output.mesh, positions_of(output));
  ASSERT_GT(faces.size(), 50U);
  for (const auto& p : faces) {
    // A height field has all of its triangles the same way round from above.
    const double up =
        (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    EXPECT_GT(up, 0);
  }
}

TEST(Decimate, GivesTheSameBitsOnAllThreadsAndInBothForms) {
  const Soup soup = *shapes::gyroid(10);
  const Connectivity mesh = built(soup);
  const Connectivity closed = std::move(*close_boundary(mesh, Execution::serial()));
  const DecimateOptions options{.faces = mesh.face_count() / 6};
  const DecimateOutput expected = decimated(mesh, soup.positions(), options);
  for (const int count : kThreadCounts) {
    Threads threads(count);
    const auto found = decimate(mesh, soup.positions(), options, threads.execution(7));
    ASSERT_TRUE(found);
    EXPECT_EQ(digest(found->mesh, Execution::serial()), digest(expected.mesh, Execution::serial()));
    EXPECT_TRUE(std::equal(found->positions.begin(), found->positions.end(),
                           expected.positions.begin(), expected.positions.end()));
  }
  const DecimateOutput found = decimated(closed, soup.positions(), options);
  EXPECT_EQ(found.mesh.form(), Form::closed);
  EXPECT_EQ(invariants_of(found.mesh), invariants_of(mesh));
  EXPECT_LE(found.mesh.face_count(), options.faces);
}

TEST(Decimate, SaysWhereEverythingWent) {
  const Soup soup = *shapes::torus(20, 10);
  const Connectivity mesh = built(soup);
  const DecimateOutput output = decimated(mesh, soup.positions(), {.faces = 100});
  ASSERT_EQ(output.maps.vertices.size(), static_cast<std::size_t>(mesh.vertex_count()));
  ASSERT_EQ(output.maps.faces.size(), static_cast<std::size_t>(mesh.face_count()));
  Index next = 0;
  for (const VertexId v : output.maps.vertices) {
    if (!v.valid()) continue;
    EXPECT_EQ(v.value, next);
    ++next;
  }
  EXPECT_EQ(next, output.mesh.vertex_count());
}

TEST(Decimate, TakesPolygonsAndAnythingElse) {
  const Soup quads = *shapes::quad_grid(12, 12);
  const DecimateOutput output =
      decimated(built(quads), quads.positions(), {.faces = quads.face_count() / 2});
  EXPECT_TRUE(validate(output.mesh, Execution::serial()).empty());
  EXPECT_LE(output.mesh.face_count(), quads.face_count());

  Random random(4);
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const auto built = build_plain(random_faces(seed));
    if (!built) continue;
    std::vector<float> xyz;
    for (Index i = 0; i < 3 * built->mesh.vertex_count(); ++i) {
      xyz.push_back(static_cast<float>(random.below(101)) / 8);
    }
    const Positions positions{xyz.data(), built->mesh.vertex_count()};
    const auto found = decimate(built->mesh, positions, {.faces = 2}, Execution::serial());
    ASSERT_TRUE(found) << seed << " " << name(found.error().code);
    const auto violations = validate(found->mesh, Execution::serial());
    ASSERT_TRUE(violations.empty()) << seed << " " << violations.front().relation;
  }
}

TEST(Decimate, LeavesEdgesAloneWhosePositionsAreNotFinite) {
  Soup soup = *shapes::torus(12, 8);
  soup.xyz[0] = std::numeric_limits<float>::quiet_NaN();
  soup.xyz[100] = std::numeric_limits<float>::infinity();
  const Connectivity mesh = built(soup);
  const DecimateOutput output = decimated(mesh, soup.positions(), {.faces = 0});
  EXPECT_EQ(output.end, DecimateEnd::refused);
  EXPECT_TRUE(validate(output.mesh, Execution::serial()).empty());
  EXPECT_TRUE(output.maps.vertices[0].valid());
  EXPECT_LT(output.mesh.face_count(), mesh.face_count());
}

TEST(Decimate, RefusesPositionsThatDoNotFit) {
  const auto built = build_plain(tetrahedron());
  const std::vector<float> xyz(12, 0.0F);
  const auto error = [&](const Positions& positions) {
    const auto found = decimate(built->mesh, positions, {}, Execution::serial());
    return found ? Error{} : found.error();
  };
  EXPECT_EQ(error({xyz.data(), 3}).code, ErrorCode::count_mismatch);
  EXPECT_EQ(error({xyz.data(), 3}).limit, 4);
  EXPECT_EQ(error({xyz.data(), 4, 10}).code, ErrorCode::bad_stride);
  EXPECT_EQ(error({nullptr, 4}).code, ErrorCode::null_pointer);
}

}  // namespace
}  // namespace hedgerow::test
