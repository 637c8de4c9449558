#include "hedgerow/reorder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/build.h"
#include "hedgerow/digest.h"
#include "hedgerow/normals.h"
#include "hedgerow/shapes.h"
#include "hedgerow/validate.h"
#include "support/numbers.h"
#include "support/plain_build.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"
#include "support/reorder_cases.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

constexpr std::array kMethods = {ReorderMethod::hilbert, ReorderMethod::morton,
                                 ReorderMethod::breadth_first, ReorderMethod::vertex_cache,
                                 ReorderMethod::fronts};

bool is_permutation_of(std::span<const Index> values, Index count) {
  std::vector<Index> sorted = to_vector(values);
  std::sort(sorted.begin(), sorted.end());
  std::vector<Index> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), Index{0});
  return sorted == all;
}

// Every relation of the old mesh, found again under the new numbers.
void expect_same_mesh(const Connectivity& old_mesh, const ReorderOutput& output) {
  const Reordering& order = output.reordering;
  ASSERT_TRUE(is_permutation_of(order.vertices_new_to_old.span(), old_mesh.vertex_count()));
  ASSERT_TRUE(is_permutation_of(order.faces_new_to_old.span(), old_mesh.face_count()));
  ASSERT_TRUE(is_permutation_of(order.halfedges_new_to_old.span(), old_mesh.halfedge_count()));
  ASSERT_EQ(order.vertices_old_to_new.size(), order.vertices_new_to_old.size());
  const auto vertex = [&](VertexId v) {
    return VertexId(order.vertices_old_to_new[static_cast<std::size_t>(v.value)]);
  };
  const auto old_halfedge = [&](HalfedgeId h) {
    return h.valid() ? HalfedgeId(order.halfedges_new_to_old[static_cast<std::size_t>(h.value)])
                     : HalfedgeId();
  };
  for (Index v = 0; v < old_mesh.vertex_count(); ++v) {
    const Index there = vertex(VertexId(v)).value;
    ASSERT_EQ(order.vertices_new_to_old[static_cast<std::size_t>(there)], v);
  }
  old_mesh.visit([&](const auto& before) {
    output.mesh.visit([&](const auto& after) {
      ASSERT_EQ(after.face_count(), before.face_count());
      for (Index i = 0; i < after.halfedge_count(); ++i) {
        const HalfedgeId h(i);
        const HalfedgeId old = old_halfedge(h);
        ASSERT_EQ(after.origin[h], vertex(before.origin[old]));
        ASSERT_EQ(old_halfedge(after.next(h)), before.next(old));
        ASSERT_EQ(old_halfedge(after.opposite[h]), before.opposite[old]);
        const FaceId f = after.face(h);
        ASSERT_EQ(order.faces_new_to_old[static_cast<std::size_t>(f.value)],
                  before.face(old).value);
        ASSERT_EQ(h == after.first(f), old == before.first(before.face(old)));
      }
    });
  });
}

void expect_stored_columns(const Connectivity& mesh, const ReferenceMesh& expected) {
  EXPECT_EQ(to_vector(mesh.origin()), expected.origin);
  EXPECT_EQ(to_vector(mesh.opposite()), expected.opposite);
  EXPECT_EQ(to_vector(mesh.outgoing()), expected.outgoing);
  EXPECT_EQ(std::vector<FanStart>(mesh.fans().begin(), mesh.fans().end()), expected.fans);
}

class EveryMethod : public ::testing::TestWithParam<ReorderMethod> {};

std::string method_name(const ::testing::TestParamInfo<ReorderMethod>& instance) {
  constexpr std::array kNames = {"hilbert", "morton", "breadth_first", "vertex_cache", "fronts"};
  return kNames[static_cast<std::size_t>(instance.param)];
}
INSTANTIATE_TEST_SUITE_P(Reorder, EveryMethod, ::testing::ValuesIn(kMethods), method_name);

// Polygons, boundaries, bowties, bad edges and isolated vertices, all at random.
TEST_P(EveryMethod, GivesTheSameMeshAsTheOracleBuilds) {
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const ReferenceMesh reference = random_reference_mesh(seed);
    const Connectivity mesh = to_connectivity(reference, random.one_in(2));
    const std::vector<float> xyz = random_positions(mesh.vertex_count(), random);
    const Result<ReorderOutput> output =
        reorder(mesh, {xyz.data(), mesh.vertex_count()}, GetParam(), Execution::serial());
    ASSERT_TRUE(output);
    ASSERT_NO_FATAL_FAILURE(expect_same_mesh(mesh, *output));
    expect_stored_columns(output->mesh,
                          reference_mesh(faces_of(output->mesh), mesh.vertex_count()));
    EXPECT_TRUE(validate(output->mesh, Execution::serial()).empty());
    EXPECT_EQ(output->mesh.is_triangle_mesh(), mesh.is_triangle_mesh());
    if (HasFailure()) return;
  }
}

// A build from the new face list would pair what the policy has cut.
TEST_P(EveryMethod, KeepsWhatThePoliciesOfTheBuildHaveCut) {
  const std::vector<Index> corners = {0, 1, 2, 0, 1, 2, 0, 2, 3};
  BuildOptions options;
  options.policies[DefectKind::duplicate_face] = Action::cut;
  const Result<BuildOutput> output =
      build(FaceList::triangles<Index>(corners, 4), options, Execution::serial());
  ASSERT_TRUE(output);
  ASSERT_EQ(output->mesh.opposite()[2], 6) << "the face that is kept whole still has a neighbour";
  const std::vector<float> xyz = {3, 0, 0, 2, 1, 0, 1, 0, 1, 0, 1, 1};
  const Result<ReorderOutput> found =
      reorder(output->mesh, {xyz.data(), 4}, GetParam(), Execution::serial());
  ASSERT_TRUE(found);
  expect_same_mesh(output->mesh, *found);
  EXPECT_TRUE(validate(found->mesh, Execution::serial()).empty());
}

TEST(Reorder, SortsFacesByTheirSmallestVertex) {
  const Result<Soup> soup = shapes::generate(shapes::Shape::gyroid, 3000);
  ASSERT_TRUE(soup);
  const Soup mixed = shapes::shuffled(*soup, 5);
  const Connectivity mesh = built(mixed);
  for (const ReorderMethod method :
       {ReorderMethod::hilbert, ReorderMethod::morton, ReorderMethod::breadth_first}) {
    const auto output = reorder(mesh, mixed.positions(), method, Execution::serial());
    ASSERT_TRUE(output);
    std::pair<Index, Index> last{-1, -1};
    const auto faces = faces_of(output->mesh);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const std::pair<Index, Index> key{*std::min_element(faces[f].begin(), faces[f].end()),
                                        output->reordering.faces_new_to_old[f]};
      ASSERT_LT(last, key);
      last = key;
    }
  }
}

TEST_P(EveryMethod, BringsAShuffledGridBackNearTheOrderedOne) {
  const Result<Soup> soup = shapes::grid(150, 150);
  ASSERT_TRUE(soup);
  const Locality ordered = locality(built(*soup));
  const Soup mixed = shapes::shuffled(*soup, 11);
  const Result<ReorderOutput> output =
      reorder(built(mixed), mixed.positions(), GetParam(), Execution::serial());
  ASSERT_TRUE(output);
  EXPECT_GT(output->before.lines_per_face, 2.5);
  EXPECT_GT(output->before.mean_index_gap, 5000);
  EXPECT_LT(output->after.lines_per_face, 2.5 * ordered.lines_per_face);
  EXPECT_LT(output->after.mean_index_gap, 6 * ordered.mean_index_gap);
}

TEST_P(EveryMethod, IsTheSameForEveryThreadCountAndGrain) {
  const Result<Soup> soup = shapes::generate(shapes::Shape::gyroid, 150'000);
  ASSERT_TRUE(soup);
  const Soup mixed = shapes::shuffled(*soup, 2);
  const Connectivity mesh = built(mixed);
  const auto run = [&](const Execution& execution) {
    const Result<ReorderOutput> output = reorder(mesh, mixed.positions(), GetParam(), execution);
    EXPECT_TRUE(output);
    const Reordering& order = output->reordering;
    return std::array{digest(output->mesh, Execution::serial()),
                      digest(std::as_bytes(order.vertices_new_to_old.span())),
                      digest(std::as_bytes(order.vertices_old_to_new.span())),
                      digest(std::as_bytes(order.faces_new_to_old.span())),
                      digest(std::as_bytes(order.halfedges_new_to_old.span()))};
  };
  const auto expected = run(Execution::serial());
  for (const int threads : kThreadCounts) {
    Threads pool(threads);
    for (const Index grain : {0, 700}) {
      EXPECT_EQ(run(pool.execution(grain)), expected) << threads << " threads, grain " << grain;
    }
  }
}

// Quadratic work would take minutes here.
TEST_P(EveryMethod, TakesAVertexWithManyFacesInItsStride) {
  const Result<Soup> soup = shapes::fan(100'000, shapes::FanEnds::closed);
  ASSERT_TRUE(soup);
  const Soup mixed = shapes::shuffled(*soup, 3);
  const Connectivity mesh = built(mixed);
  const Result<ReorderOutput> output =
      reorder(mesh, mixed.positions(), GetParam(), Execution::serial());
  ASSERT_TRUE(output);
  EXPECT_LT(output->after.lines_per_face, output->before.lines_per_face);
}

TEST_P(EveryMethod, LeavesAnEmptyMeshEmpty) {
  const Connectivity mesh = to_connectivity(reference_mesh({}, 0));
  const Result<ReorderOutput> output = reorder(mesh, {}, GetParam(), Execution::serial());
  ASSERT_TRUE(output);
  EXPECT_EQ(output->mesh.vertex_count(), 0);
  EXPECT_EQ(output->mesh.face_count(), 0);
  EXPECT_EQ(output->after.lines_per_face, 0);
}

TEST_P(EveryMethod, RefusesTheClosedForm) {
  const Result<Soup> soup = shapes::grid(3, 3);
  ASSERT_TRUE(soup);
  const Result<Connectivity> closed = close_boundary(built(*soup), Execution::serial());
  ASSERT_TRUE(closed);
  const Result<ReorderOutput> output =
      reorder(*closed, soup->positions(), GetParam(), Execution::serial());
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().code, ErrorCode::already_closed);
}

TEST(Reorder, RefusesPositionsThatACurveCannotRead) {
  const Result<Soup> soup = shapes::grid(3, 3);
  ASSERT_TRUE(soup);
  const Connectivity mesh = built(*soup);
  const std::array<std::pair<Positions, ErrorCode>, 4> cases = {
      {{{nullptr, 16, 12}, ErrorCode::null_pointer},
       {{soup->xyz.data(), 15, 12}, ErrorCode::count_mismatch},
       {{soup->xyz.data(), 16, 8}, ErrorCode::bad_stride},
       {{soup->xyz.data(), 16, 14}, ErrorCode::bad_stride}}};
  for (const auto& [positions, code] : cases) {
    for (const ReorderMethod method :
         {ReorderMethod::hilbert, ReorderMethod::morton, ReorderMethod::fronts}) {
      const auto output = reorder(mesh, positions, method, Execution::serial());
      ASSERT_FALSE(output);
      EXPECT_EQ(output.error().code, code);
    }
    EXPECT_TRUE(reorder(mesh, positions, ReorderMethod::breadth_first, Execution::serial()));
    EXPECT_TRUE(reorder(mesh, positions, ReorderMethod::vertex_cache, Execution::serial()));
  }
}

TEST(Reorder, ReadsPositionsWithAStride) {
  const Result<Soup> soup = shapes::grid(9, 7);
  ASSERT_TRUE(soup);
  const Connectivity mesh = built(*soup);
  std::vector<float> padded;
  for (Index v = 0; v < soup->vertex_count(); ++v) {
    const float* p = soup->positions()[v];
    padded.insert(padded.end(), {p[0], p[1], p[2], std::nanf("")});
  }
  const auto packed = reorder(mesh, soup->positions(), ReorderMethod::hilbert, Execution::serial());
  const auto strided = reorder(mesh, {padded.data(), soup->vertex_count(), 4 * sizeof(float)},
                               ReorderMethod::hilbert, Execution::serial());
  ASSERT_TRUE(packed && strided);
  EXPECT_EQ(to_vector(packed->reordering.vertices_new_to_old.span()),
            to_vector(strided->reordering.vertices_new_to_old.span()));
}

TEST(Reorder, PutsIsolatedVerticesLastWhereNoPositionsPlaceThem) {
  const Connectivity mesh = to_connectivity(reference_mesh({{1, 5, 3}}, 7));
  for (const ReorderMethod method : {ReorderMethod::breadth_first, ReorderMethod::vertex_cache}) {
    const auto output = reorder(mesh, {}, method, Execution::serial());
    ASSERT_TRUE(output);
    const std::vector<Index> order = to_vector(output->reordering.vertices_new_to_old.span());
    EXPECT_EQ(std::vector<Index>(order.begin() + 3, order.end()), (std::vector<Index>{0, 2, 4, 6}));
  }
}

TEST(BreadthFirst, TakesComponentsByTheirSmallestVertex) {
  const Connectivity mesh = to_connectivity(reference_mesh({{6, 4, 5}, {3, 1, 2}, {2, 1, 0}}, 7));
  const auto output = reorder(mesh, {}, ReorderMethod::breadth_first, Execution::serial());
  ASSERT_TRUE(output);
  const std::vector<Index> order = to_vector(output->reordering.vertices_new_to_old.span());
  EXPECT_EQ(order[0], 0);
  EXPECT_EQ(order[3], 3);
  EXPECT_EQ(order[4], 4);
}

// Misses of a first-in-first-out cache of 16 vertices, each face.
double misses_per_face(const Connectivity& mesh) {
  std::vector<std::int64_t> entered(static_cast<std::size_t>(mesh.vertex_count()), -100);
  std::int64_t clock = 0;
  for (const Index v : mesh.origin()) {
    std::int64_t& time = entered[static_cast<std::size_t>(v)];
    if (clock - time > 16) time = clock++;
  }
  return static_cast<double>(clock) / static_cast<double>(mesh.face_count());
}

TEST(VertexCache, FindsMostVerticesInASmallCache) {
  for (const shapes::Shape shape : {shapes::Shape::grid, shapes::Shape::gyroid}) {
    const Result<Soup> soup = shapes::generate(shape, 20'000);
    ASSERT_TRUE(soup);
    const Soup mixed = shapes::shuffled(*soup, 4);
    const Connectivity mesh = built(mixed);
    const auto output = reorder(mesh, {}, ReorderMethod::vertex_cache, Execution::serial());
    ASSERT_TRUE(output);
    EXPECT_GT(misses_per_face(mesh), 2.9) << name(shape);
    EXPECT_LT(misses_per_face(output->mesh), 0.85) << name(shape);
  }
}

TEST(VertexCache, NumbersVerticesByFirstUse) {
  const Result<Soup> soup = shapes::generate(shapes::Shape::gyroid, 3000);
  ASSERT_TRUE(soup);
  const auto output = reorder(built(*soup), {}, ReorderMethod::vertex_cache, Execution::serial());
  ASSERT_TRUE(output);
  Index seen = 0;
  for (const Index v : output->mesh.origin()) {
    ASSERT_LE(v, seen);
    seen = std::max(seen, v + 1);
  }
}

TEST(Locality, CountsGapsAndLines) {
  // Vertices 0 to 5 share the first line but for 5, which lies across two; 16 starts the fourth.
  const Connectivity near = to_connectivity(reference_mesh({{0, 1, 2}}, 17));
  EXPECT_DOUBLE_EQ(locality(near).mean_index_gap, 4.0 / 3);
  EXPECT_DOUBLE_EQ(locality(near).lines_per_face, 1);
  const Connectivity far = to_connectivity(reference_mesh({{0, 5, 16}}, 17));
  EXPECT_DOUBLE_EQ(locality(far).mean_index_gap, 32.0 / 3);
  EXPECT_DOUBLE_EQ(locality(far).lines_per_face, 3);
}

TEST(FillPermuted, CarriesAnArrayAlong) {
  const std::vector<Index> new_to_old = {2, 0, 1};
  const std::vector<float> old_values = {0, 1, 10, 11, 20, 21};
  std::vector<float> out(6);
  fill_permuted<float>(new_to_old, old_values, out, 2);
  EXPECT_EQ(out, (std::vector<float>{20, 21, 0, 1, 10, 11}));
}

}  // namespace
}  // namespace hedgerow::test
