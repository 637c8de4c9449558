#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "kernels/face_normals.h"
#include "support/guarded.h"
#include "support/normal_meshes.h"

namespace hedgerow {
namespace {

using test::Answer;
using test::Method;

Answer faces_of(const Soup& soup, const NormalOptions& options = {}) {
  return test::run(Method::face, {}, soup.face_list(), soup.positions(), options,
                   Execution::serial());
}

TEST(FaceNormals, OfACubePointOutwards) {
  const std::vector<float> normals = floats(faces_of(test::cube_of_quads()));
  EXPECT_EQ(normals, (std::vector<float>{0, 0, -1, 0, 0, 1, 0, -1, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0}));
}

TEST(FaceNormals, OfAConcavePolygonDoNotDependOnItsFirstCorner) {
  // An L, started at each corner in turn, the inner one included.
  const std::vector<float> xyz = {0, 0, 5, 2, 0, 5, 2, 1, 5, 1, 1, 5, 1, 2, 5, 0, 2, 5};
  for (Index start = 0; start < 6; ++start) {
    std::vector<Index> face;
    for (Index k = 0; k < 6; ++k) face.push_back((start + k) % 6);
    for (const auto method : {PolygonMethod::newell, PolygonMethod::wedge_mean}) {
      NormalOptions options;
      options.polygon = method;
      EXPECT_EQ(floats(faces_of(test::make_soup(xyz, {face}), options)),
                (std::vector<float>{0, 0, 1}));
    }
  }
}

TEST(FaceNormals, FollowThePolicyWhereAFaceHasNoArea) {
  // In line, two corners in one place, and sound.
  const Soup soup = test::make_soup({0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 0, 0, 0, 3, 0},
                                    {{0, 1, 2}, {0, 3, 1}, {0, 1, 4}});
  const float expected[3] = {0, -9, 0};
  const float expected_z[3] = {0, -9, 1};
  for (const auto policy :
       {DegeneratePolicy::zero, DegeneratePolicy::keep, DegeneratePolicy::axis}) {
    NormalOptions options;
    options.degenerate = policy;
    const Answer answer = faces_of(soup, options);
    EXPECT_EQ(answer.stats, (NormalStats{2, 0}));
    const auto p = static_cast<std::size_t>(policy);
    const float x = expected[p];
    const float z = expected_z[p];
    EXPECT_EQ(floats(answer), (std::vector<float>{x, x, z, x, x, z, 0, 0, 1}));
  }
}

TEST(FaceNormals, AreTheSameScalarAndFourAtATime) {
  const Soup soup = test::random_soup(11, 60, 403, 3);
  const kernels::Points points{soup.positions()};
  std::vector<float> a(403 * 3, -9.0f);
  std::vector<float> b(403 * 3, -9.0f);
  const auto plain = kernels::triangle_normals_scalar({0, 403}, soup.corners.data(), points,
                                                      {{a.data(), 403}, DegeneratePolicy::keep});
  const auto fast = kernels::triangle_normals_sse({0, 403}, soup.corners.data(), points,
                                                  {{b.data(), 403}, DegeneratePolicy::keep});
  EXPECT_EQ(plain, fast);
  EXPECT_GT(plain.degenerate_count, 0);
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0);
}

TEST(FaceNormals, AreTheSameForEveryIndexFormatAndStride) {
  const Soup soup = test::random_soup(12, 80, 700, 3);
  const Answer expected = faces_of(soup);
  const auto check_format = [&](auto zero, std::size_t extra) {
    using Integer = decltype(zero);
    const std::size_t width = 3 + extra;
    std::vector<Integer> corners(700 * width, 9);
    for (std::size_t c = 0; c < 2100; ++c) {
      corners[c / 3 * width + c % 3] = static_cast<Integer>(soup.corners[c]);
    }
    FaceList faces = FaceList::triangles<Integer>(corners, 80);
    faces.face_count = 700;
    faces.stride_bytes = width * sizeof(Integer);
    EXPECT_EQ(test::run(Method::face, {}, faces, soup.positions(), {}, Execution::serial()),
              expected);
    for (const auto weight : test::kWeights) {
      NormalOptions options;
      options.weight = weight;
      EXPECT_EQ(
          test::run(Method::scatter, {}, faces, soup.positions(), options, Execution::serial()),
          test::run(Method::scatter, {}, soup.face_list(), soup.positions(), options,
                    Execution::serial()));
    }
  };
  for (const std::size_t extra : {0u, 1u, 5u}) {
    check_format(std::int32_t{}, extra);
    check_format(std::uint32_t{}, extra);
    check_format(std::uint16_t{}, extra);
    check_format(std::int64_t{}, extra);
  }
}

TEST(FaceNormals, RefuseAnIndexOutOfRangeBeforeAnythingIsWritten) {
  Soup soup = test::wavy_grid(20);
  soup.corners[3 * 700 + 1] = soup.vertex_count();
  soup.corners[3 * 710 + 2] = -4;
  std::vector<float> out(static_cast<std::size_t>(soup.face_count()) * 3, 5.0f);
  const NormalsOut to{out.data(), soup.face_count()};
  Workspace workspace;
  for (const auto& result :
       {face_normals(soup.face_list(), soup.positions(), to, {}, Execution::serial()),
        scatter_vertex_normals(soup.face_list(), soup.positions(), to, {}, Execution::serial(),
                               workspace)}) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::index_out_of_range);
    EXPECT_EQ(result.error().element, 700);
    EXPECT_EQ(result.error().value, soup.vertex_count());
    EXPECT_EQ(result.error().limit, soup.vertex_count());
    EXPECT_EQ(result.error().count, 2);
  }
  EXPECT_EQ(out, std::vector<float>(out.size(), 5.0f));
}

TEST(FaceNormals, RefuseArraysThatDoNotFit) {
  const Soup soup = test::cube_of_quads();
  std::vector<float> out(18);
  const auto code = [&](Positions in, NormalsOut to) {
    const auto result = face_normals(soup.face_list(), in, to, {}, Execution::serial());
    return result ? ErrorCode::duplicate_face : result.error().code;
  };
  const Positions good = soup.positions();
  const NormalsOut to{out.data(), 6};
  EXPECT_EQ(code({good.data, 7}, to), ErrorCode::count_mismatch);
  EXPECT_EQ(code(good, {out.data(), 5}), ErrorCode::count_mismatch);
  EXPECT_EQ(code({good.data, 8, 8}, to), ErrorCode::bad_stride);
  EXPECT_EQ(code({good.data, 8, 14}, to), ErrorCode::bad_stride);
  EXPECT_EQ(code(good, {out.data(), 6, 0}), ErrorCode::bad_stride);
  EXPECT_EQ(code({nullptr, 8}, to), ErrorCode::null_pointer);
  EXPECT_EQ(code(good, {nullptr, 6}), ErrorCode::null_pointer);
}

TEST(Normals, TouchNoByteOutsideTheirArrays) {
  const Soup soup = test::sphere(2);
  const Connectivity mesh = test::mesh_of(soup);
  const auto vertices = static_cast<std::size_t>(soup.vertex_count());
  const auto most = static_cast<std::size_t>(soup.face_count());
  for (const std::size_t stride : {12u, 16u, 20u, 24u}) {
    for (const bool at_end : {true, false}) {
      const test::Guarded in((vertices - 1) * stride + 12, at_end);
      const test::Guarded faces_out((most - 1) * stride + 12, at_end);
      const test::Guarded vertices_out((vertices - 1) * stride + 12, at_end);
      ASSERT_TRUE(in.is_ready() && faces_out.is_ready() && vertices_out.is_ready());
      for (std::size_t v = 0; v < vertices; ++v) {
        std::memcpy(in.floats() + v * stride / 4, soup.xyz.data() + 3 * v, 12);
      }
      const Positions positions{in.floats(), soup.vertex_count(), stride};
      const NormalsOut to_faces{faces_out.floats(), soup.face_count(), stride};
      const NormalsOut to_vertices{vertices_out.floats(), soup.vertex_count(), stride};
      Workspace workspace;
      for (const auto weight : test::kWeights) {
        NormalOptions options;
        options.weight = weight;
        EXPECT_TRUE(face_normals(mesh, positions, to_faces, options, Execution::serial()));
        EXPECT_TRUE(gather_vertex_normals(mesh, positions, to_vertices, options,
                                          Execution::serial(), workspace));
        EXPECT_TRUE(scatter_vertex_normals(soup.face_list(), positions, to_vertices, options,
                                           Execution::serial(), workspace));
      }
    }
  }
}

}  // namespace
}  // namespace hedgerow
