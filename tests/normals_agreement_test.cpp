// One mesh, one answer: every method, execution, grain, weight, view and stride gives the same
// bits.

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "support/normal_meshes.h"

namespace hedgerow {
namespace {

using test::Answer;
using test::Method;

constexpr std::size_t kStrides[] = {12, 16, 28};

enum class Extent : std::uint8_t { every_grain, two_grains, large_mesh };

bool is_tried(const Execution& execution, Extent extent) {
  const bool has_small_grain = execution.grain() == 1 || execution.grain() == 7;
  if (extent == Extent::every_grain) return true;
  if (extent == Extent::two_grains) return !has_small_grain;
  return execution.grain() == 0 && (execution.threads() == 3 || execution.threads() == 5);
}

void expect_one_answer(const Soup& soup, Extent extent) {
  const Connectivity mesh = test::mesh_of(soup);
  Connectivity stored = test::mesh_of(soup);
  stored.materialise(Execution::serial());
  auto closed = close_boundary(mesh, Execution::serial());
  ASSERT_TRUE(closed);
  const Connectivity* meshes[] = {&mesh, &stored, &*closed};
  const test::Executions executions;
  for (const NormalWeight weight : test::kWeights) {
    for (const PolygonMethod polygon : {PolygonMethod::newell, PolygonMethod::wedge_mean}) {
      if (soup.offsets.empty() && polygon != PolygonMethod::newell) continue;
      NormalOptions options;
      options.weight = weight;
      options.polygon = polygon;
      options.degenerate = DegeneratePolicy::axis;
      const Positions positions = soup.positions();
      const Answer expected = test::run(Method::scatter, mesh, soup.face_list(), positions, options,
                                        Execution::serial());
      const Answer faces =
          test::run(Method::face, mesh, soup.face_list(), positions, options, Execution::serial());
      std::size_t turn = 0;
      for (const Execution& execution : executions.all()) {
        if (!is_tried(execution, extent)) continue;
        const std::size_t stride = kStrides[turn % 3];
        const Connectivity& view = *meshes[turn++ % 3];
        ASSERT_EQ(expected, test::run(Method::scatter, mesh, soup.face_list(), positions, options,
                                      execution, stride));
        ASSERT_EQ(expected, test::run(Method::gather, view, soup.face_list(), positions, options,
                                      execution, stride));
        ASSERT_EQ(faces, test::run(Method::face, view, soup.face_list(), positions, options,
                                   execution, stride));
      }
      for (const Connectivity* view : meshes) {
        ASSERT_EQ(expected, test::run(Method::gather, *view, face_list(*view), positions, options,
                                      Execution::serial()));
        ASSERT_EQ(expected, test::run(Method::scatter, *view, face_list(*view), positions, options,
                                      Execution::serial()));
        ASSERT_EQ(faces, test::run(Method::face, *view, face_list(*view), positions, options,
                                   Execution::serial()));
      }
    }
  }
}

TEST(NormalAgreement, OnRandomTrianglesWithSeveralFansAndDegenerateFaces) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    expect_one_answer(test::random_soup(seed, 90, 250, 3), Extent::every_grain);
  }
}

TEST(NormalAgreement, OnRandomPolygons) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    expect_one_answer(test::random_soup(seed, 90, 160, 7), Extent::every_grain);
  }
}

TEST(NormalAgreement, OnTrianglesGivenAsPolygons) {
  const Soup triangles = test::random_soup(5, 90, 250, 3);
  std::vector<Index> offsets;
  for (Index f = 0; f <= 250; ++f) offsets.push_back(3 * f);
  Soup polygons = test::copy_of(triangles);
  polygons.offsets = Buffer<Index>::copy_of(offsets);
  expect_one_answer(polygons, Extent::two_grains);
  for (const NormalWeight weight : test::kWeights) {
    NormalOptions options;
    options.weight = weight;
    for (const Method method : {Method::face, Method::gather, Method::scatter}) {
      EXPECT_EQ(test::run(method, test::mesh_of(triangles), triangles.face_list(),
                          triangles.positions(), options, Execution::serial()),
                test::run(method, test::mesh_of(polygons), polygons.face_list(),
                          polygons.positions(), options, Execution::serial()));
    }
  }
}

TEST(NormalAgreement, OnAGridLargerThanABlock) {
  expect_one_answer(test::wavy_grid(92), Extent::two_grains);
}

TEST(NormalAgreement, OnASphere) { expect_one_answer(test::sphere(4), Extent::two_grains); }

TEST(NormalAgreement, OnShuffledFaces) {
  Soup soup = test::wavy_grid(92);
  const std::size_t faces = soup.corners.size() / 3;
  std::uint64_t state = 1;
  for (std::size_t f = faces; f > 1; --f) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const std::size_t other = (state >> 33) % f;
    for (std::size_t k = 0; k < 3; ++k) {
      std::swap(soup.corners[3 * (f - 1) + k], soup.corners[3 * other + k]);
    }
  }
  expect_one_answer(soup, Extent::two_grains);
}

TEST(NormalAgreement, OnAFanOfManyTriangles) {
  const Soup soup = test::wavy_fan(200'000);
  const Connectivity mesh = test::mesh_of(soup);
  const test::Executions executions;
  for (const NormalWeight weight : test::kWeights) {
    NormalOptions options;
    options.weight = weight;
    const Answer expected = test::run(Method::scatter, mesh, soup.face_list(), soup.positions(),
                                      options, Execution::serial());
    for (const Execution& execution : executions.all()) {
      if (!is_tried(execution, Extent::large_mesh)) continue;
      ASSERT_EQ(expected, test::run(Method::gather, mesh, soup.face_list(), soup.positions(),
                                    options, execution));
      ASSERT_EQ(expected, test::run(Method::scatter, mesh, soup.face_list(), soup.positions(),
                                    options, execution));
    }
  }
}

TEST(NormalAgreement, OnAPolygonOfManyCorners) {
  constexpr int kCorners = 70'000;
  std::vector<float> xyz;
  std::vector<Index> ring;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 6.283185307179586 * i / kCorners;
    const double radius = 1 + 0.1 * (i % 2);
    xyz.insert(xyz.end(), {static_cast<float>(radius * std::cos(angle)),
                           static_cast<float>(radius * std::sin(angle)), 0.5f});
    ring.push_back(i);
  }
  expect_one_answer(test::make_soup(xyz, {ring}), Extent::large_mesh);
}

TEST(NormalAgreement, OnNothing) {
  expect_one_answer(test::make_soup({}, {}), Extent::every_grain);
  expect_one_answer(test::make_soup({1, 2, 3}, {}), Extent::every_grain);
  expect_one_answer(test::make_soup({1, 2, 3}, {}, true), Extent::every_grain);
}

}  // namespace
}  // namespace hedgerow
