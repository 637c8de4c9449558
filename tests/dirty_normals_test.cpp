#include "hedgerow/dirty_normals.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "support/allocations.h"
#include "support/normal_meshes.h"
#include "support/random_faces.h"
#include "support/serial.h"
#include "support/threads.h"

namespace hedgerow {
namespace {

using test::Random;

struct Normals {
  std::vector<float> faces;
  std::vector<float> vertices;
  friend bool operator==(const Normals& a, const Normals& b) {
    const auto is_same = [](const std::vector<float>& x, const std::vector<float>& y) {
      return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0;
    };
    return is_same(a.faces, b.faces) && is_same(a.vertices, b.vertices);
  }
};
NormalsOut out_of(std::vector<float>& xyz) {
  return {xyz.data(), static_cast<std::int64_t>(xyz.size() / 3)};
}

Normals full_pass(const Connectivity& mesh, Positions positions, const NormalOptions& options) {
  Normals normals{std::vector<float>(3 * static_cast<std::size_t>(mesh.face_count()), 7.0F),
                  std::vector<float>(3 * static_cast<std::size_t>(mesh.vertex_count()), 7.0F)};
  Workspace workspace;
  EXPECT_TRUE(face_normals(mesh, positions, out_of(normals.faces), options, test::kSerial));
  EXPECT_TRUE(gather_vertex_normals(mesh, positions, out_of(normals.vertices), options,
                                    test::kSerial, workspace));
  return normals;
}

void update(const Connectivity& mesh, Positions positions, const NormalOptions& options,
            const DirtySet& dirty, const Execution& execution, Normals& normals) {
  Workspace workspace;
  ASSERT_TRUE(
      update_face_normals(mesh, positions, out_of(normals.faces), options, dirty, execution));
  ASSERT_TRUE(update_vertex_normals(mesh, positions, out_of(normals.vertices), options, dirty,
                                    execution, workspace));
}

std::vector<Soup> soups_to_move() {
  std::vector<Soup> all;
  all.push_back(test::wavy_grid(40));
  all.push_back(test::wavy_fan(400));
  all.push_back(test::sphere(4));
  all.push_back(test::cube_of_quads());
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    all.push_back(test::random_soup(seed, 60, 50, seed % 2 == 0 ? 3 : 6));
  }
  return all;
}

std::vector<Index> move_some(Soup& soup, Random& random, Index count) {
  std::vector<Index> moved;
  for (Index i = 0; i < count; ++i) {
    const Index v = random.below(soup.vertex_count());
    moved.push_back(v);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Some fall together, so that faces and vertices lose their direction.
      float& x = soup.xyz[3 * static_cast<std::size_t>(v) + axis];
      x = random.one_in(5) ? 0.0F : x + static_cast<float>(random.below(100)) / 100;
    }
  }
  return moved;
}

TEST(DirtyNormals, AreThoseOfAFullPassToTheLastBit) {
  int partial = 0;
  for (const Soup& original : soups_to_move()) {
    for (const bool is_closed : {false, true}) {
      Soup soup = test::copy_of(original);
      Connectivity mesh = test::mesh_of(soup);
      if (is_closed) mesh = std::move(*close_boundary(mesh, test::kSerial));
      DirtySet dirty(mesh);
      Random random(static_cast<std::uint64_t>(soup.vertex_count()));
      for (const NormalWeight weight : test::kWeights) {
        for (const DegeneratePolicy policy : {DegeneratePolicy::zero, DegeneratePolicy::axis}) {
          NormalOptions options;
          options.weight = weight;
          options.degenerate = policy;
          Normals normals = full_pass(mesh, soup.positions(), options);
          for (int frame = 0; frame < 4; ++frame) {
            const auto moved = move_some(soup, random, random.below(soup.vertex_count() / 8 + 2));
            ASSERT_TRUE(dirty.find(mesh, MovedVertices::list(moved)));
            partial += !dirty.is_all() && !moved.empty();
            update(mesh, soup.positions(), options, dirty, test::kSerial, normals);
            ASSERT_TRUE(normals == full_pass(mesh, soup.positions(), options));
          }
        }
      }
    }
  }
  EXPECT_GT(partial, 500);
}

TEST(DirtyNormals, LeaveAloneWhatHasNoDirectionWhereTheyAreToKeepIt) {
  Soup soup = test::wavy_grid(20);
  const Connectivity mesh = test::mesh_of(soup);
  NormalOptions options;
  options.degenerate = DegeneratePolicy::keep;
  Normals normals = full_pass(mesh, soup.positions(), options);
  const Normals before = normals;
  // All of the faces at vertex 30 fall to a point, and with them all of its neighbours' corners.
  std::vector<Index> moved;
  for (const Index v : {29, 30, 31, 49, 50, 51, 9, 10, 11}) {
    moved.push_back(v);
    std::fill_n(soup.xyz.data() + 3 * v, 3, 1.0F);
  }
  DirtySet dirty(mesh);
  ASSERT_TRUE(dirty.find(mesh, MovedVertices::list(moved)));
  Workspace workspace;
  const auto stats = update_vertex_normals(mesh, soup.positions(), out_of(normals.vertices),
                                           options, dirty, test::kSerial, workspace);
  ASSERT_TRUE(stats);
  EXPECT_GE(stats->degenerate_count, 1);
  const auto v = static_cast<std::size_t>(stats->first_degenerate);
  EXPECT_TRUE(std::equal(normals.vertices.begin() + static_cast<std::ptrdiff_t>(3 * v),
                         normals.vertices.begin() + static_cast<std::ptrdiff_t>(3 * v + 3),
                         before.vertices.begin() + static_cast<std::ptrdiff_t>(3 * v)));
}

TEST(DirtyNormals, AreTheSameBitsForEveryThreadCountAndGrain) {
  Soup soup = test::wavy_grid(120);
  const Connectivity mesh = test::mesh_of(soup);
  Random random(5);
  Normals start = full_pass(mesh, soup.positions(), {});
  const auto moved = move_some(soup, random, mesh.vertex_count() / 20);
  const Normals expected = full_pass(mesh, soup.positions(), {});
  DirtySet dirty(mesh);
  ASSERT_TRUE(dirty.find(mesh, MovedVertices::list(moved)));
  ASSERT_FALSE(dirty.is_all());
  for (const int count : test::kThreadCounts) {
    test::Threads threads(count);
    for (const Index grain : {0, 1, 100}) {
      Normals normals = start;
      update(mesh, soup.positions(), {}, dirty, threads.execution(grain), normals);
      EXPECT_TRUE(normals == expected) << count << " threads, grain " << grain;
    }
  }
}

std::vector<Index> list(std::span<const Index> ids) { return {ids.begin(), ids.end()}; }

TEST(DirtySets, AreTheFacesAtMovedVerticesAndTheirVertices) {
  for (const Soup& soup : soups_to_move()) {
    const Connectivity mesh = test::mesh_of(soup);
    if (mesh.vertex_count() < 50) continue;
    DirtySet dirty(mesh);
    Random random(static_cast<std::uint64_t>(mesh.face_count()));
    for (int round = 0; round < 5; ++round) {
      std::vector<Index> moved;
      std::vector<std::uint64_t> words(static_cast<std::size_t>(mesh.vertex_count()) / 64 + 1, 0);
      for (Index i = random.below(mesh.vertex_count() / 10); i > 0; --i) {
        moved.push_back(random.below(mesh.vertex_count()));
        words[static_cast<std::size_t>(moved.back()) / 64] |= std::uint64_t{1}
                                                              << (moved.back() % 64);
      }
      std::set<Index> faces;
      std::set<Index> vertices;
      const FaceList all = face_list(mesh);
      const auto* corners = static_cast<const Index*>(all.corners);
      for (Index f = 0; f < mesh.face_count(); ++f) {
        const IndexRange range = all.corner_range(f);
        const bool is_dirty = std::any_of(corners + range.begin, corners + range.end, [&](Index v) {
          return std::ranges::count(moved, v) > 0;
        });
        if (!is_dirty) continue;
        faces.insert(f);
        vertices.insert(corners + range.begin, corners + range.end);
      }
      for (const auto& way : {MovedVertices::list(moved), MovedVertices::bitmap(words)}) {
        ASSERT_TRUE(dirty.find(mesh, way));
        ASSERT_FALSE(dirty.is_all());
        EXPECT_EQ(list(dirty.faces()), std::vector<Index>(faces.begin(), faces.end()));
        EXPECT_EQ(list(dirty.vertices()), std::vector<Index>(vertices.begin(), vertices.end()));
      }
    }
  }
}

TEST(DirtySets, OfARangeAreThoseOfTheListOfItsVertices) {
  const Connectivity mesh = test::mesh_of(test::wavy_grid(30));
  DirtySet from_range(mesh);
  DirtySet from_list(mesh);
  ASSERT_TRUE(from_range.find(mesh, MovedVertices::range({40, 43})));
  const std::vector<Index> ids = {42, 40, 41, 42};
  ASSERT_TRUE(from_list.find(mesh, MovedVertices::list(ids)));
  EXPECT_EQ(list(from_range.faces()), list(from_list.faces()));
  EXPECT_EQ(list(from_range.vertices()), list(from_list.vertices()));
  // Nothing moved: nothing is dirty, and what was is forgotten.
  ASSERT_TRUE(from_range.find(mesh, MovedVertices::range({})));
  EXPECT_TRUE(from_range.faces().empty() && from_range.vertices().empty());
}

TEST(DirtySets, NameTheFirstVertexThatDoesNotExistAndStayAsTheyWere) {
  const Connectivity mesh = test::mesh_of(test::wavy_grid(30));
  const Index count = mesh.vertex_count();
  DirtySet dirty(mesh);
  ASSERT_TRUE(dirty.find(mesh, MovedVertices::range({5, 6})));
  const std::vector<Index> before = list(dirty.faces());
  const std::vector<Index> ids = {1, count, 2, -1};
  const auto found = dirty.find(mesh, MovedVertices::list(ids));
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::index_out_of_range);
  EXPECT_EQ(found.error().element, 1);
  EXPECT_EQ(found.error().value, count);
  EXPECT_EQ(found.error().limit, count);
  EXPECT_EQ(found.error().count, 2);
  EXPECT_FALSE(dirty.find(mesh, MovedVertices::range({-1, 3})));
  EXPECT_FALSE(dirty.find(mesh, MovedVertices::range({3, count + 1})));
  const std::vector<std::uint64_t> words(static_cast<std::size_t>(count) / 64 + 2, ~0ULL);
  EXPECT_FALSE(dirty.find(mesh, MovedVertices::bitmap(words)));
  EXPECT_EQ(list(dirty.faces()), before);
}

TEST(DirtySets, AllocateNothingOnceMade) {
  Soup soup = test::wavy_grid(60);
  const Connectivity mesh = test::mesh_of(soup);
  Normals normals = full_pass(mesh, soup.positions(), {});
  DirtySet dirty(mesh);
  Workspace workspace;
  const std::vector<Index> moved = {100, 101, 102, 700};
  const auto frame = [&] {
    ASSERT_TRUE(dirty.find(mesh, MovedVertices::list(moved)));
    ASSERT_TRUE(update_face_normals(mesh, soup.positions(), out_of(normals.faces), {}, dirty,
                                    test::kSerial));
    ASSERT_TRUE(update_vertex_normals(mesh, soup.positions(), out_of(normals.vertices), {}, dirty,
                                      test::kSerial, workspace));
  };
  frame();
  const auto before = test::allocation_count();
  frame();
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace hedgerow
