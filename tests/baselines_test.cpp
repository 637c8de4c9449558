#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "baselines/bandwidth.h"
#include "baselines/pointer_mesh.h"
#include "baselines/pointer_winged_mesh.h"
#include "baselines/struct_mesh.h"
#include "hedgerow/build.h"
#include "hedgerow/face_list.h"
#include "hedgerow/normals.h"
#include "hedgerow/shapes.h"
#include "hedgerow/subdivide.h"

namespace hedgerow::test {
namespace {

using baselines::PointerHalfedgeMesh;
using baselines::PointerWingedEdgeMesh;
using baselines::StructHalfedgeMesh;

struct Input {
  std::vector<float> xyz;
  std::vector<Index> corners;
  std::vector<Index> offsets;

  [[nodiscard]] FaceList faces() const {
    const auto vertex_count = static_cast<std::int64_t>(xyz.size() / 3);
    return offsets.empty() ? FaceList::triangles<Index>(corners, vertex_count)
                           : FaceList::polygons<Index>(corners, offsets, vertex_count);
  }
  [[nodiscard]] Positions positions() const {
    return {xyz.data(), static_cast<std::int64_t>(xyz.size() / 3)};
  }
};

Input tetrahedron_input() {
  return {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, {}};
}

/// Two triangles and a quad in one row, lying in z = 0, and one vertex unused.
Input strip_input() {
  return {{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0, 9, 9, 9},
          {0, 1, 2, 1, 3, 2, 1, 4, 5, 3},
          {0, 3, 6, 10}};
}

/// Triangles over few vertices, so that edges with one, two and more half-edges of any direction
/// occur; no triangle has a vertex twice.
Input random_triangles(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> vertex(0, 11);
  std::uniform_real_distribution<float> coordinate(-1, 1);
  Input input;
  for (int i = 0; i < 36; ++i) input.xyz.push_back(coordinate(random));
  while (input.corners.size() < 60) {
    const std::array<Index, 3> face = {vertex(random), vertex(random), vertex(random)};
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    input.corners.insert(input.corners.end(), face.begin(), face.end());
  }
  return input;
}

template <class Mesh>
class Baseline : public testing::Test {};
using Meshes = testing::Types<PointerHalfedgeMesh, PointerWingedEdgeMesh, StructHalfedgeMesh>;
TYPED_TEST_SUITE(Baseline, Meshes);

TYPED_TEST(Baseline, PairsTheHalfedgesOfATetrahedron) {
  const Input input = tetrahedron_input();
  const TypeParam mesh(input.faces(), input.positions());
  EXPECT_EQ(mesh.origin(), input.corners);
  EXPECT_EQ(mesh.opposite(), (std::vector<Index>{9, 6, 3, 2, 8, 10, 1, 11, 4, 0, 5, 7}));
  EXPECT_EQ(mesh.outgoing(), (std::vector<Index>{0, 2, 1, 5}));
  EXPECT_EQ(mesh.boundary_loop_count(), 0);
  EXPECT_EQ(mesh.component_count(), 1);
}

TYPED_TEST(Baseline, LeavesTheBoundaryOfPolygonsWithoutOpposite) {
  const Input input = strip_input();
  const TypeParam mesh(input.faces(), input.positions());
  EXPECT_EQ(mesh.face_count(), 3);
  EXPECT_EQ(mesh.opposite(), (std::vector<Index>{-1, 5, -1, 9, -1, 1, -1, -1, -1, 3}));
  // Each boundary vertex starts its fan: the half-edge before its outgoing one has no opposite.
  EXPECT_EQ(mesh.outgoing(), (std::vector<Index>{0, 1, 5, 9, 7, 8, -1}));
  EXPECT_EQ(mesh.boundary_loop_count(), 1);
  EXPECT_EQ(mesh.component_count(), 1);
}

TYPED_TEST(Baseline, PairsNothingOnAnEdgeWithThreeHalfedgesOrTwoThatRunTheSameWay) {
  Input input;
  input.xyz.assign(15, 0.0F);
  input.corners = {0, 1, 2, 1, 0, 3, 0, 1, 4};
  EXPECT_EQ(TypeParam(input.faces(), input.positions()).opposite(), std::vector<Index>(9, -1));
  input.corners = {0, 1, 2, 0, 1, 3};
  EXPECT_EQ(TypeParam(input.faces(), input.positions()).opposite(), std::vector<Index>(6, -1));
}

TYPED_TEST(Baseline, SumsTheIdsOfTheOneRing) {
  const Input input = strip_input();
  const TypeParam mesh(input.faces(), input.positions());
  std::vector<std::uint32_t> sums(7, 99);
  mesh.fill_one_ring_sums(sums);
  EXPECT_EQ(sums, (std::vector<std::uint32_t>{1 + 2, 0 + 2 + 3 + 4, 0 + 1 + 3, 1 + 2 + 5, 1 + 5,
                                              3 + 4, 0}));
}

TYPED_TEST(Baseline, GivesAFlatPatchTheSameNormalEverywhereWithEveryWeight) {
  const Input input = strip_input();
  TypeParam mesh(input.faces(), input.positions());
  mesh.compute_face_normals();
  EXPECT_EQ(mesh.face_normals(), (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}));
  for (const NormalWeight weight :
       {NormalWeight::uniform, NormalWeight::area, NormalWeight::angle, NormalWeight::max}) {
    mesh.compute_vertex_normals(weight);
    const std::vector<float> normals = mesh.vertex_normals();
    for (std::size_t v = 0; v < 7; ++v) {
      EXPECT_FLOAT_EQ(normals[3 * v + 2], v == 6 ? 0.0F : 1.0F) << "vertex " << v;
    }
  }
}

TYPED_TEST(Baseline, WeighsTheFacesOfACornerAsAsked) {
  // At vertex 0 all three corners are right angles between unit edges, so all weights are equal.
  const Input input = tetrahedron_input();
  TypeParam mesh(input.faces(), input.positions());
  mesh.compute_face_normals();
  for (const NormalWeight weight :
       {NormalWeight::uniform, NormalWeight::area, NormalWeight::angle, NormalWeight::max}) {
    mesh.compute_vertex_normals(weight);
    const std::vector<float> normals = mesh.vertex_normals();
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(normals[i], -0.57735027F, 1e-6F);
  }
}

TEST(Baselines, AgreeWithEachOtherAndTheEngineOnRandomTriangles) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Input input = random_triangles(seed);
    PointerHalfedgeMesh pointers(input.faces(), input.positions());
    StructHalfedgeMesh structs(input.faces(), input.positions());
    EXPECT_EQ(pointers.opposite(), structs.opposite());
    PointerWingedEdgeMesh winged(input.faces(), input.positions());
    EXPECT_EQ(winged.opposite(), structs.opposite());
    EXPECT_EQ(winged.outgoing(), structs.outgoing());
    EXPECT_EQ(winged.boundary_loop_count(), structs.boundary_loop_count());
    EXPECT_EQ(winged.component_count(), structs.component_count());
    winged.compute_face_normals();
    winged.compute_vertex_normals(NormalWeight::angle);
    EXPECT_EQ(pointers.outgoing(), structs.outgoing());
    EXPECT_EQ(pointers.boundary_loop_count(), structs.boundary_loop_count());
    EXPECT_EQ(pointers.component_count(), structs.component_count());
    const Result<BuildOutput> built = build(input.faces(), BuildOptions{}, Execution::serial());
    ASSERT_TRUE(built.has_value());
    EXPECT_TRUE(std::ranges::equal(pointers.opposite(), built->mesh.opposite()));
    const std::vector<Index> outgoing = pointers.outgoing();
    for (Index v = 0; v < 12; ++v) {
      const bool has_one_fan = extra_fans(built->mesh.fans(), VertexId(v)).empty();
      if (!has_one_fan) continue;
      EXPECT_EQ(outgoing[static_cast<std::size_t>(v)],
                built->mesh.outgoing()[static_cast<std::size_t>(v)])
          << "vertex " << v;
    }
    pointers.compute_face_normals();
    structs.compute_face_normals();
    EXPECT_EQ(pointers.face_normals(), structs.face_normals());
    pointers.compute_vertex_normals(NormalWeight::angle);
    structs.compute_vertex_normals(NormalWeight::angle);
    EXPECT_EQ(pointers.vertex_normals(), structs.vertex_normals());
    EXPECT_EQ(winged.vertex_normals(), structs.vertex_normals());
  }
}

template <class Mesh>
class BaselineEdits : public testing::Test {};
using EditedMeshes = testing::Types<PointerHalfedgeMesh, StructHalfedgeMesh>;
TYPED_TEST_SUITE(BaselineEdits, EditedMeshes);

template <class Mesh>
std::vector<std::uint32_t> ring_sums(const Mesh& mesh) {
  std::vector<std::uint32_t> sums(static_cast<std::size_t>(mesh.vertex_count()));
  mesh.fill_one_ring_sums(sums);
  return sums;
}

// A closed mesh, one with a boundary, and one whose boundary touches every vertex.
std::vector<Soup> shapes_to_edit() {
  std::vector<Soup> soups;
  soups.push_back(std::move(*shapes::icosphere(2)));
  soups.push_back(std::move(*shapes::terrain(7, 5)));
  soups.push_back(std::move(*shapes::strip(9)));
  return soups;
}

TYPED_TEST(BaselineEdits, SubdivideAsTheEngineDoes) {
  for (const Soup& soup : shapes_to_edit()) {
    TypeParam mesh(soup.face_list(), soup.positions());
    const Index old_halfedges = mesh.halfedge_count();
    const Index old_faces = mesh.face_count();
    for (Index f = 0; f < old_faces; ++f) mesh.split_face(f);
    const std::vector<Index> opposite = mesh.opposite();
    std::int64_t refused = 0;
    for (Index h = 0; h < old_halfedges; ++h) {
      if (opposite[static_cast<std::size_t>(h)] < h) refused += mesh.flip(h) ? 0 : 1;
    }
    const auto built = build(soup.face_list(), BuildOptions{}, Execution::serial());
    SubdivisionOptions options;
    options.scheme = SubdivisionScheme::sqrt3;
    const auto expected = subdivide(built->mesh, soup.positions(), options, Execution::serial());
    ASSERT_TRUE(expected.has_value());
    const TypeParam fresh(face_list(expected->mesh),
                          {expected->positions.data(), expected->mesh.vertex_count()});
    EXPECT_EQ(mesh.face_count(), fresh.face_count());
    EXPECT_EQ(ring_sums(mesh), ring_sums(fresh));
    EXPECT_EQ(mesh.boundary_loop_count(), fresh.boundary_loop_count());
    // Boundary edges, and no other.
    EXPECT_EQ(refused, std::ranges::count(built->mesh.opposite(), kInvalidIndex));
  }
}

// Next to the boundary, too, where a vertex has to know where its fan begins.
TYPED_TEST(BaselineEdits, FlipToAndFro) {
  for (const Soup& soup : shapes_to_edit()) {
    TypeParam mesh(soup.face_list(), soup.positions());
    const Index loops = mesh.boundary_loop_count();
    const std::vector<Index> opposite = mesh.opposite();
    const auto corner = [&](Index h, Index k) {
      return soup.corners[static_cast<std::size_t>(h / 3 * 3 + (h % 3 + k) % 3)];
    };
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      const Index o = opposite[static_cast<std::size_t>(h)];
      std::vector<std::uint32_t> expected = ring_sums(mesh);
      const std::vector<std::uint32_t> before = expected;
      if (!mesh.flip(h)) {
        EXPECT_EQ(ring_sums(mesh), before);
        continue;
      }
      const auto sum = [&](Index v) -> std::uint32_t& {
        return expected[static_cast<std::size_t>(v)];
      };
      const auto number = [](Index v) { return static_cast<std::uint32_t>(v); };
      const Index a = corner(h, 0);
      const Index b = corner(h, 1);
      const Index c = corner(h, 2);
      const Index d = corner(o, 2);
      sum(a) -= number(b);
      sum(b) -= number(a);
      sum(c) += number(d);
      sum(d) += number(c);
      EXPECT_EQ(ring_sums(mesh), expected) << h;
      EXPECT_EQ(mesh.boundary_loop_count(), loops) << h;
      // Three times more: the half-edge is where it was.
      for (int i = 0; i < 3; ++i) EXPECT_TRUE(mesh.flip(h));
      EXPECT_EQ(ring_sums(mesh), before) << h;
    }
  }
}

TYPED_TEST(BaselineEdits, CollapseWhatWasSplit) {
  for (const Soup& soup : shapes_to_edit()) {
    TypeParam mesh(soup.face_list(), soup.positions());
    const TypeParam before(soup.face_list(), soup.positions());
    const Index old_vertices = mesh.vertex_count();
    const Index old_faces = mesh.face_count();
    for (Index f = 0; f < old_faces; ++f) mesh.split_face(f);
    EXPECT_EQ(mesh.vertex_count(), old_vertices + old_faces);
    EXPECT_EQ(mesh.face_count(), 3 * old_faces);
    for (Index v = old_vertices; v < old_vertices + old_faces; ++v) mesh.collapse(v);
    mesh.compact();
    EXPECT_EQ(mesh.vertex_count(), before.vertex_count());
    EXPECT_EQ(mesh.halfedge_count(), before.halfedge_count());
    EXPECT_EQ(mesh.face_count(), before.face_count());
    EXPECT_EQ(ring_sums(mesh), ring_sums(before));
    EXPECT_EQ(mesh.boundary_loop_count(), before.boundary_loop_count());
    EXPECT_EQ(mesh.component_count(), before.component_count());
  }
}

// A vertex with more than three neighbours, whose edges are moved to the one that is kept.
TYPED_TEST(BaselineEdits, CollapseInOneSphere) {
  const Soup soup = *shapes::icosphere(1);
  TypeParam mesh(soup.face_list(), soup.positions());
  mesh.collapse(0);
  mesh.compact();
  EXPECT_EQ(mesh.vertex_count(), soup.vertex_count() - 1);
  EXPECT_EQ(mesh.face_count(), soup.face_count() - 2);
  EXPECT_EQ(mesh.halfedge_count(), 3 * mesh.face_count());
  EXPECT_EQ(mesh.boundary_loop_count(), 0);
  EXPECT_EQ(mesh.component_count(), 1);
  const std::vector<Index> opposite = mesh.opposite();
  for (std::size_t h = 0; h < opposite.size(); ++h) {
    EXPECT_EQ(opposite[static_cast<std::size_t>(opposite[h])], static_cast<Index>(h));
  }
}

TEST(StreamArrays, LeaveTheRightValuesForAnyNumberOfThreads) {
  using baselines::StreamKernel;
  baselines::StreamArrays arrays(std::size_t{100'000});
  EXPECT_EQ(arrays.array_bytes(), 98'304U);
  for (const StreamKernel kernel : {StreamKernel::read, StreamKernel::copy, StreamKernel::triad,
                                    StreamKernel::copy_streaming, StreamKernel::triad_streaming}) {
    for (const int threads : {1, 2}) {
      EXPECT_GT(arrays.run(kernel, threads), 0.0);
      EXPECT_TRUE(arrays.is_correct()) << baselines::name(kernel) << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace hedgerow::test
