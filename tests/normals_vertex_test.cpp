#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/normal_meshes.h"

namespace hedgerow {
namespace {

using test::Answer;
using test::Method;

Answer vertices_of(const Soup& soup, NormalWeight weight,
                   PolygonMethod polygon = PolygonMethod::newell) {
  NormalOptions options;
  options.weight = weight;
  options.polygon = polygon;
  const Connectivity mesh = test::mesh_of(soup);
  const Answer gathered = test::run(Method::gather, mesh, soup.face_list(), soup.positions(),
                                    options, Execution::serial());
  EXPECT_EQ(gathered, test::run(Method::scatter, mesh, soup.face_list(), soup.positions(), options,
                                Execution::serial()));
  return gathered;
}

void expect_direction(const Answer& answer, std::size_t v, double x, double y, double z) {
  const std::vector<float> normals = floats(answer);
  const double length = std::sqrt(x * x + y * y + z * z);
  EXPECT_NEAR(normals[3 * v], x / length, 3e-7) << v;
  EXPECT_NEAR(normals[3 * v + 1], y / length, 3e-7) << v;
  EXPECT_NEAR(normals[3 * v + 2], z / length, 3e-7) << v;
}

TEST(VertexNormals, OfACubeOfQuadsAreItsDiagonals) {
  for (const NormalWeight weight : test::kWeights) {
    for (const auto method : {PolygonMethod::newell, PolygonMethod::wedge_mean}) {
      const Answer answer = vertices_of(test::cube_of_quads(), weight, method);
      expect_direction(answer, 0, -1, -1, -1);
      expect_direction(answer, 6, 1, 1, 1);
      EXPECT_EQ(answer.stats, NormalStats{});
    }
  }
}

TEST(VertexNormals, WeighTheCornersAsTheFormulasSay) {
  // Three sides of a box 1 x 2 x 3 at the origin, the one across x cut into two triangles there.
  const Soup soup = test::make_soup({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 2, 3},
                                    {{0, 2, 1}, {0, 1, 3}, {0, 3, 4}, {0, 4, 2}});
  expect_direction(vertices_of(soup, NormalWeight::uniform), 0, -2, -1, -1);
  expect_direction(vertices_of(soup, NormalWeight::area), 0, -12, -3, -2);
  expect_direction(vertices_of(soup, NormalWeight::angle), 0, -1, -1, -1);
  // a x b / (|a|^2 |b|^2): 2 / (1 * 4), 3 / (1 * 9), 6 / (9 * 13) + 6 / (13 * 4).
  expect_direction(vertices_of(soup, NormalWeight::max), 0, -(6.0 / 117 + 6.0 / 52), -3.0 / 9,
                   -2.0 / 4);
}

TEST(VertexNormals, CountAReflexCornerByItsInteriorAngle) {
  // An L in the plane z = 0 whose inner corner, 3, is shared with a wall towards +x.
  const Soup soup =
      test::make_soup({0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0, 1, 1, -1, 1, 2, -1},
                      {{0, 1, 2, 3, 4, 5}, {4, 3, 6, 7}});
  const double reflex = 1.5 * 3.141592653589793;
  const double right = 0.5 * 3.141592653589793;
  expect_direction(vertices_of(soup, NormalWeight::angle), 3, right, 0, reflex);
}

TEST(VertexNormals, OfAFlatFanPointUp) {
  Soup soup = test::wavy_fan(500);
  for (std::size_t i = 2; i < soup.xyz.size(); i += 3) soup.xyz[i] = 0;
  for (const NormalWeight weight : test::kWeights) {
    const Answer answer = vertices_of(soup, weight);
    for (std::size_t v = 0; v < 501; ++v) expect_direction(answer, v, 0, 0, 1);
  }
}

TEST(VertexNormals, ByMaxAreExactOnASphere) {
  // Any triangulation with closed rings will do, however uneven.
  Soup soup = test::sphere(4);
  for (std::size_t i = 0; i < soup.xyz.size(); i += 3) {
    const double x = soup.xyz[i] * 1.7 + 0.3;
    const double y = soup.xyz[i + 1];
    const double z = soup.xyz[i + 2] * 0.6 + 0.1;
    const double length = std::sqrt(x * x + y * y + z * z);
    soup.xyz[i] = static_cast<float>(x / length);
    soup.xyz[i + 1] = static_cast<float>(y / length);
    soup.xyz[i + 2] = static_cast<float>(z / length);
  }
  const std::vector<double> radial(soup.xyz.begin(), soup.xyz.end());
  EXPECT_LT(worst_angle(vertices_of(soup, NormalWeight::max), radial), 1e-5);
  EXPECT_GT(worst_angle(vertices_of(soup, NormalWeight::uniform), radial), 1e-2);
}

TEST(VertexNormals, AreWithinAFewRoundingsOfTheOracle) {
  const auto check = [](const Soup& soup, double bound) {
    for (const NormalWeight weight : test::kWeights) {
      for (const auto method : {PolygonMethod::newell, PolygonMethod::wedge_mean}) {
        NormalOptions options;
        options.weight = weight;
        options.polygon = method;
        EXPECT_LT(worst_angle(vertices_of(soup, weight, method),
                              test::oracle(soup.face_list(), soup.positions(), options)),
                  bound)
            << static_cast<int>(weight);
      }
    }
  };
  check(test::sphere(4), 1e-6);
  check(test::wavy_grid(40), 1e-6);
  check(test::wavy_fan(2000), 1e-4);
  check(test::sphere(3, 4096), 1e-6);  // far from the origin: the input is what it is
  check(test::cube_of_quads(), 1e-6);
}

// The area vector of a needle is a small difference of large products where it is computed at the
// tip, which is the first corner of a third of these faces.
TEST(VertexNormals, ByMaxKeepTheirDigitsOnNeedles) {
  for (const Index n : {2000, 20000}) {
    const Soup soup = test::wavy_fan(n);
    NormalOptions options;
    const auto error = [&](NormalWeight weight) {
      options.weight = weight;
      return worst_angle(vertices_of(soup, weight),
                         test::oracle(soup.face_list(), soup.positions(), options));
    };
    EXPECT_LT(error(NormalWeight::max), 5e-7) << n;
    // What the header says of the others, at a tip of about 4.4 / n.
    for (const auto weight : {NormalWeight::uniform, NormalWeight::area, NormalWeight::angle}) {
      EXPECT_LT(error(weight), 2e-8 * static_cast<double>(n)) << static_cast<int>(weight);
    }
  }
}

// As many as a group of each form takes, and some more; there is no half-edge to read.
TEST(VertexNormals, OfVerticesWithoutAnyFaceAreDegenerate) {
  Soup soup;
  soup.xyz = Buffer<float>(3 * 100, 1.0F);
  for (const NormalWeight weight : test::kWeights) {
    EXPECT_EQ(vertices_of(soup, weight).stats, (NormalStats{100, 0}));
  }
}

TEST(VertexNormals, FollowThePolicyAtIsolatedVerticesAndZeroSums) {
  // Vertex 3 is isolated; 4, 5, 6 are those of a triangle without area.
  const Soup soup = test::make_soup({0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5, 0, 0, 7, 1, 0, 7, 2, 0, 7},
                                    {{0, 1, 2}, {4, 5, 6}});
  const Connectivity mesh = test::mesh_of(soup);
  const float x[3] = {0, -9, 0};
  const float z[3] = {0, -9, 1};
  for (const auto policy :
       {DegeneratePolicy::zero, DegeneratePolicy::keep, DegeneratePolicy::axis}) {
    for (const auto method : {Method::gather, Method::scatter}) {
      for (const auto weight : test::kWeights) {
        NormalOptions options;
        options.weight = weight;
        options.degenerate = policy;
        const Answer answer = test::run(method, mesh, soup.face_list(), soup.positions(), options,
                                        Execution::serial());
        EXPECT_EQ(answer.stats, (NormalStats{4, 3}));
        std::vector<float> expected = {0, 0, 1, 0, 0, 1, 0, 0, 1};
        for (int i = 0; i < 4; ++i) {
          const auto p = static_cast<std::size_t>(policy);
          expected.insert(expected.end(), {x[p], x[p], z[p]});
        }
        EXPECT_EQ(floats(answer), expected);
      }
    }
  }
}

}  // namespace
}  // namespace hedgerow
