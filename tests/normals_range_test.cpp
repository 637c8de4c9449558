#include <gtest/gtest.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <cmath>
#include <limits>
#include <vector>

#include "support/normal_meshes.h"

namespace hedgerow {
namespace {

using test::Answer;
using test::Method;

constexpr Method kNormalMethods[] = {Method::face, Method::gather, Method::scatter};

Soup scaled_by(const Soup& soup, float factor) {
  Soup copy = test::copy_of(soup);
  for (float& c : copy.xyz) c *= factor;
  return copy;
}

std::vector<Soup> soups_to_scale() {
  std::vector<Soup> all;
  all.push_back(test::sphere(3));
  all.push_back(test::cube_of_quads());
  all.push_back(test::wavy_fan(150));
  return all;
}

TEST(NormalRange, HoldsFromTinyToHugeCoordinates) {
  for (const Soup& soup : soups_to_scale()) {
    const Connectivity mesh = test::mesh_of(soup);
    for (const float factor : {1e-36f, 1e-30f, 1e-20f, 1e-10f, 1e-5f, 1e5f, 1e15f, 1e30f, 1e37f}) {
      const Soup other = scaled_by(soup, factor);
      for (const NormalWeight weight : test::kWeights) {
        NormalOptions options;
        options.weight = weight;
        const auto expected = test::oracle(soup.face_list(), soup.positions(), options);
        const auto gathered = test::run(Method::gather, mesh, soup.face_list(), other.positions(),
                                        options, Execution::serial());
        EXPECT_EQ(gathered, test::run(Method::scatter, mesh, soup.face_list(), other.positions(),
                                      options, Execution::serial()));
        EXPECT_EQ(gathered.stats, NormalStats{});
        EXPECT_LT(worst_angle(gathered, expected), 1e-5) << factor << ' ' << int(weight);
      }
    }
  }
}

TEST(NormalRange, MixesTinyAndHugeFacesAtOneVertex) {
  // Round vertex 0: sides of 1e-15, of 1 and of 1e12.
  const Soup soup =
      test::make_soup({0, 0, 0, 1e-15f, 0, 0, 0, 1, 0, -1e12f, 0, 0, 0, -1e-15f, 1e-15f},
                      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  const Connectivity mesh = test::mesh_of(soup);
  for (const NormalWeight weight : test::kWeights) {
    NormalOptions options;
    options.weight = weight;
    const auto gathered = test::run(Method::gather, mesh, soup.face_list(), soup.positions(),
                                    options, Execution::serial());
    EXPECT_EQ(gathered, test::run(Method::scatter, mesh, soup.face_list(), soup.positions(),
                                  options, Execution::serial()));
    EXPECT_LT(worst_angle(gathered, test::oracle(soup.face_list(), soup.positions(), options)),
              1e-6)
        << int(weight);
  }
}

TEST(NormalRange, DoesNotDependOnWhetherAListIsOfTrianglesAlone) {
  // Positions of mixed size, so that many triangles are too small or too large for float.
  Soup soup = test::random_soup(11, 60, 400, 3);
  for (std::size_t i = 0; i < soup.xyz.size(); ++i) {
    soup.xyz[i] *= i % 7 < 5 ? 1.0f : i % 7 == 5 ? 1e-20f : 1e16f;
  }
  const FaceList triangles = soup.face_list();
  std::vector<Index> offsets(401);
  for (std::size_t f = 0; f < offsets.size(); ++f) offsets[f] = 3 * static_cast<Index>(f);
  FaceList polygons = triangles;
  polygons.offsets = offsets.data();
  polygons.stride_bytes = sizeof(Index);
  for (const NormalWeight weight : test::kWeights) {
    NormalOptions options;
    options.weight = weight;
    const auto scatter = [&](const FaceList& faces) {
      Answer answer;
      answer.bits.resize(180);
      Workspace workspace;
      const NormalsOut out{reinterpret_cast<float*>(answer.bits.data()), 60};
      answer.stats = *scatter_vertex_normals(faces, soup.positions(), out, options,
                                             Execution::serial(), workspace);
      return answer;
    };
    EXPECT_EQ(scatter(triangles), scatter(polygons)) << static_cast<int>(weight);
  }
}

TEST(NormalRange, LeavesOutFacesWithACoordinateThatIsNotFinite) {
  const Soup good = test::sphere(2);
  const Connectivity mesh = test::mesh_of(good);
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Soup soup = test::copy_of(good);
    soup.xyz[3 * 20 + 1] = bad;
    std::vector<bool> is_touched(static_cast<std::size_t>(soup.vertex_count()));
    Index touched_faces = 0;
    for (std::size_t c = 0; c < soup.corners.size(); ++c) {
      if (soup.corners[c] != 20) continue;
      ++touched_faces;
      for (std::size_t k = 0; k < 3; ++k) {
        is_touched[static_cast<std::size_t>(soup.corners[c / 3 * 3 + k])] = true;
      }
    }
    for (const NormalWeight weight : test::kWeights) {
      NormalOptions options;
      options.weight = weight;
      for (const Method method : kNormalMethods) {
        const Answer before = test::run(method, mesh, good.face_list(), good.positions(), options,
                                        Execution::serial());
        const Answer after = test::run(method, mesh, soup.face_list(), soup.positions(), options,
                                       Execution::serial());
        for (const float c : floats(after)) EXPECT_TRUE(std::isfinite(c));
        if (method == Method::face) {
          EXPECT_EQ(after.stats.degenerate_count, touched_faces);
          continue;
        }
        EXPECT_EQ(after.stats, (NormalStats{1, 20}));
        for (std::size_t i = 0; i < before.bits.size(); ++i) {
          if (!is_touched[i / 3]) {
            EXPECT_EQ(before.bits[i], after.bits[i]);
          }
        }
      }
    }
  }
}

#if defined(__SSE2__)
TEST(NormalRange, LeavesTheControlBitsAloneAndBearsFlushingToZero) {
  const Soup soup = scaled_by(test::sphere(2), 1e-36f);
  const Connectivity mesh = test::mesh_of(soup);
  const unsigned found = _mm_getcsr();
  constexpr unsigned kFlags = 0x3f;
  _mm_setcsr(found | 0x8040);  // flush to zero, denormals are zero
  for (const Method method : kNormalMethods) {
    const Answer answer =
        test::run(method, mesh, soup.face_list(), soup.positions(), {}, Execution::serial());
    EXPECT_EQ(_mm_getcsr() & ~kFlags, (found | 0x8040) & ~kFlags);
    for (const float c : floats(answer)) EXPECT_TRUE(std::isfinite(c));
  }
  _mm_setcsr(found);
}
#endif

}  // namespace
}  // namespace hedgerow
