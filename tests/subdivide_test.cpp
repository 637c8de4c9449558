#include "hedgerow/subdivide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/digest.h"
#include "hedgerow/shapes.h"
#include "hedgerow/validate.h"
#include "support/meshes.h"
#include "support/numbers.h"
#include "support/plain_build.h"
#include "support/random_faces.h"
#include "support/reference_subdivide.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

constexpr std::array kSchemes = {SubdivisionScheme::catmull_clark, SubdivisionScheme::loop,
                                 SubdivisionScheme::sqrt3};

std::vector<float> random_points(std::int64_t count, Random& random) {
  std::vector<float> xyz(static_cast<std::size_t>(3 * count));
  for (float& x : xyz) x = static_cast<float>(random.below(2001) - 1000) / 256.0F;
  return xyz;
}
bool is_triangles(const PlainFaces& list) {
  return std::all_of(list.faces.begin(), list.faces.end(),
                     [](const auto& face) { return face.size() == 3; });
}
PlainFaces cube() {
  return {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}, 8};
}
std::vector<float> cube_points() {
  return {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1};
}

void expect_near(const std::vector<float>& found, const std::vector<float>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_NEAR(found[i], expected[i], 1e-5) << "coordinate " << i % 3 << " of vertex " << i / 3;
  }
}

// One level after another, each compared with the reference on the same input.
void expect_as_reference(PlainFaces list, SubdivisionScheme scheme, int levels, Random& random,
                         bool has_creases) {
  std::vector<float> xyz = random_points(list.vertex_count, random);
  const auto built = build_plain(list);
  ASSERT_TRUE(built);
  std::vector<float> sharpness;
  if (has_creases) {
    const std::vector<float> some = {0, 0, 0, 0.25F, 0.5F, 1, 1.75F, 9, -1};
    for (Index h = 0; h < built->mesh.halfedge_count(); ++h)
      sharpness.push_back(random.any_of(some));
  }
  const Positions input = positions_of(xyz);
  const std::vector<float> first_xyz = xyz;
  std::vector<float> left = sharpness;
  for (int level = 0; level < levels; ++level) {
    ReferenceSubdivision next = reference_subdivide(list, xyz, left, scheme, level);
    list = std::move(next.faces);
    xyz = std::move(next.xyz);
    left = std::move(next.sharpness);
  }
  const Positions start = positions_of(first_xyz);
  ASSERT_EQ(start.count, input.count);
  const auto found =
      subdivide(built->mesh, start, {scheme, levels, sharpness}, Execution::serial());
  ASSERT_TRUE(found);
  const auto violations = validate(found->mesh, Execution::serial());
  ASSERT_TRUE(violations.empty()) << violations.front().relation;
  const auto expected = build_plain(list);
  ASSERT_TRUE(expected);
  ASSERT_EQ(found->mesh.vertex_count(), expected->mesh.vertex_count());
  ASSERT_EQ(digest(found->mesh, Execution::serial()), digest(expected->mesh, Execution::serial()));
  expect_near(to_vector(found->positions), xyz);
  ASSERT_EQ(to_vector(found->sharpness), left);
}

class Subdivide : public testing::TestWithParam<SubdivisionScheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, Subdivide, testing::ValuesIn(kSchemes));

TEST_P(Subdivide, AgreesWithTheReferenceOnSmallMeshes) {
  Random random(1);
  for (const PlainFaces& list :
       {hexagon_of_triangles(), tetrahedron(), bowtie(), three_on_an_edge(), mixed_row(),
        closed_and_open_fan(), cube(), PlainFaces{{}, 2}, PlainFaces{{{0, 1, 2}}, 3}}) {
    if (GetParam() != SubdivisionScheme::catmull_clark && !is_triangles(list)) continue;
    for (int levels = 1; levels <= 3; ++levels) {
      SCOPED_TRACE(levels);
      expect_as_reference(list, GetParam(), levels, random, false);
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(Subdivide, AgreesWithTheReferenceOnRandomMeshes) {
  const bool is_sqrt3 = GetParam() == SubdivisionScheme::sqrt3;
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const PlainFaces list = random.one_in(2) ? random_patch(random) : random_cone(random);
    if (GetParam() != SubdivisionScheme::catmull_clark && !is_triangles(list)) continue;
    ++compared;
    expect_as_reference(list, GetParam(), 1 + random.below(2), random,
                        !is_sqrt3 && random.one_in(2));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(compared, 100);
}

TEST_P(Subdivide, GivesSoundConnectivityOfAnyFaces) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const PlainFaces list = random_clutter(random);
    if (GetParam() != SubdivisionScheme::catmull_clark && !is_triangles(list)) continue;
    const auto built = build_plain(list);
    if (!built) continue;
    const auto xyz = random_points(built->mesh.vertex_count(), random);
    const auto found =
        subdivide(built->mesh, positions_of(xyz), {GetParam(), 2, {}}, Execution::serial());
    ASSERT_TRUE(found);
    const auto violations = validate(found->mesh, Execution::serial());
    ASSERT_TRUE(violations.empty()) << violations.front().relation;
  }
}

TEST_P(Subdivide, GivesTheSameBitsOnAllThreads) {
  const auto soup = shapes::terrain(60, 50);
  ASSERT_TRUE(soup);
  const auto built = build(soup->face_list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  const auto one =
      subdivide(built->mesh, soup->positions(), {GetParam(), 2, {}}, Execution::serial());
  ASSERT_TRUE(one);
  for (const int count : kThreadCounts) {
    Threads threads(count);
    for (const Index grain : {0, 7}) {
      const auto many =
          subdivide(built->mesh, soup->positions(), {GetParam(), 2, {}}, threads.execution(grain));
      ASSERT_TRUE(many);
      EXPECT_EQ(digest(many->mesh, Execution::serial()), digest(one->mesh, Execution::serial()));
      EXPECT_EQ(to_vector(many->positions), to_vector(one->positions));
    }
  }
}

TEST_P(Subdivide, KeepsTheFormOfTheBoundary) {
  const auto built = build_plain(hexagon_of_triangles());
  ASSERT_TRUE(built);
  Random random(3);
  const auto xyz = random_points(7, random);
  const auto closed = close_boundary(built->mesh, Execution::serial());
  ASSERT_TRUE(closed);
  for (const int levels : {0, 2}) {
    const SubdivisionOptions options{GetParam(), levels, {}};
    const auto open = subdivide(built->mesh, positions_of(xyz), options, Execution::serial());
    const auto found = subdivide(*closed, positions_of(xyz), options, Execution::serial());
    ASSERT_TRUE(open && found);
    EXPECT_EQ(found->mesh.form(), Form::closed);
    const auto expected = close_boundary(open->mesh, Execution::serial());
    ASSERT_TRUE(expected);
    EXPECT_EQ(digest(found->mesh, Execution::serial()), digest(*expected, Execution::serial()));
    EXPECT_EQ(to_vector(found->positions), to_vector(open->positions));
  }
}

TEST_P(Subdivide, CommutesWithAffineMaps) {
  const auto built = build_plain(hexagon_of_triangles());
  ASSERT_TRUE(built);
  Random random(5);
  const auto xyz = random_points(7, random);
  const auto mapped = [](std::vector<float> points) {
    for (std::size_t i = 0; i < points.size(); i += 3) {
      const float x = points[i];
      const float y = points[i + 1];
      const float z = points[i + 2];
      points[i] = 2 * x - y + 3;
      points[i + 1] = x + 0.5F * z;
      points[i + 2] = z - 4 * y - 1;
    }
    return points;
  };
  const SubdivisionOptions options{GetParam(), 3, {}};
  const auto plain = subdivide(built->mesh, positions_of(xyz), options, Execution::serial());
  const auto after = mapped(xyz);
  const auto found = subdivide(built->mesh, positions_of(after), options, Execution::serial());
  ASSERT_TRUE(plain && found);
  const auto expected = mapped(to_vector(plain->positions));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_NEAR(found->positions[i], expected[i], 1e-4);
  }
}

TEST_P(Subdivide, RefusesWhatItCannotDo) {
  const auto built = build_plain(tetrahedron());
  ASSERT_TRUE(built);
  const std::vector<float> xyz(12, 0.0F);
  const auto error_of = [&](const Positions& positions, int levels, std::span<const float> sharp) {
    const auto found =
        subdivide(built->mesh, positions, {GetParam(), levels, sharp}, Execution::serial());
    return found ? Error{} : found.error();
  };
  const Error few = error_of({xyz.data(), 3}, 1, {});
  EXPECT_EQ(few.code, ErrorCode::count_mismatch);
  EXPECT_EQ(few.value, 3);
  EXPECT_EQ(few.limit, 4);
  EXPECT_EQ(error_of({xyz.data(), 4, 8}, 1, {}).code, ErrorCode::bad_stride);
  EXPECT_EQ(error_of({nullptr, 4}, 1, {}).code, ErrorCode::null_pointer);
  const std::vector<float> sharpness(5, 1.0F);
  const Error sharp = error_of(positions_of(xyz), 1, sharpness);
  EXPECT_EQ(sharp.code, ErrorCode::count_mismatch);
  EXPECT_EQ(sharp.value, 5);
  EXPECT_EQ(sharp.limit, GetParam() == SubdivisionScheme::sqrt3 ? 0 : 12);
  const Error many = error_of(positions_of(xyz), 1000, {});
  EXPECT_EQ(many.code, ErrorCode::too_many_elements);
  EXPECT_GT(many.value, many.limit);
}

TEST(SubdivideTriangles, RefusesOtherFaces) {
  const auto built = build_plain(mixed_row());
  ASSERT_TRUE(built);
  const std::vector<float> xyz(27, 0.0F);
  for (const auto scheme : {SubdivisionScheme::loop, SubdivisionScheme::sqrt3}) {
    const auto found =
        subdivide(built->mesh, positions_of(xyz), {scheme, 1, {}}, Execution::serial());
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::not_triangles);
    EXPECT_EQ(found.error().element, 0);
    EXPECT_EQ(found.error().value, 5);
    EXPECT_EQ(found.error().count, 2);
  }
}

TEST(CatmullClark, MovesACubeToTheKnownPoints) {
  const auto built = build_plain(cube());
  ASSERT_TRUE(built);
  const auto xyz = cube_points();
  const auto found = subdivide(built->mesh, positions_of(xyz), {}, Execution::serial());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->mesh.vertex_count(), 26);
  EXPECT_EQ(found->mesh.face_count(), 24);
  std::array<int, 4> seen{};
  for (Index v = 0; v < 26; ++v) {
    std::array<double, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = std::abs(double{found->positions[static_cast<std::size_t>(3 * v) + k]});
    }
    std::sort(p.begin(), p.end());
    const std::array<std::array<double, 3>, 3> known = {
        {{5.0 / 9, 5.0 / 9, 5.0 / 9}, {0, 0, 1}, {0, 0.75, 0.75}}};
    const std::size_t kind = v < 8 ? 0 : v < 14 ? 1 : 2;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(p[k], known[kind][k], 1e-6) << v;
    ++seen[kind];
  }
  EXPECT_EQ(seen, (std::array<int, 4>{8, 6, 12, 0}));
}

TEST(CatmullClark, KeepsACubeWhoseEdgesStaySharp) {
  const auto built = build_plain(cube());
  ASSERT_TRUE(built);
  const auto xyz = cube_points();
  const std::vector<float> sharpness(24, std::numeric_limits<float>::infinity());
  const auto found =
      subdivide(built->mesh, positions_of(xyz), {SubdivisionScheme::catmull_clark, 3, sharpness},
                Execution::serial());
  ASSERT_TRUE(found);
  for (Index v = 0; v < found->mesh.vertex_count(); ++v) {
    const float* p = found->positions.data() + 3 * static_cast<std::size_t>(v);
    EXPECT_EQ(std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}), 1.0F) << v;
  }
}

TEST(Sqrt3, CutsBoundaryEdgesInThreeAtEverySecondLevel) {
  const auto built = build_plain({{{0, 1, 2}}, 3});
  ASSERT_TRUE(built);
  const std::vector<float> xyz = {0, 0, 0, 9, 0, 0, 0, 9, 0};
  const auto boundary_count = [&](int levels) {
    const auto found = subdivide(built->mesh, positions_of(xyz),
                                 {SubdivisionScheme::sqrt3, levels, {}}, Execution::serial());
    const auto opposite = found->mesh.opposite();
    return std::count(opposite.begin(), opposite.end(), kInvalidIndex);
  };
  EXPECT_EQ(boundary_count(1), 3);
  EXPECT_EQ(boundary_count(2), 9);
  EXPECT_EQ(boundary_count(3), 9);
  EXPECT_EQ(boundary_count(4), 27);
}

}  // namespace
}  // namespace hedgerow::test
