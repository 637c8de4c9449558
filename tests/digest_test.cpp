#include "hedgerow/digest.h"

#include <cstdint>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/boundary.h"
#include "hedgerow/build.h"
#include "hedgerow/shapes.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

std::uint64_t digest_of(const ConnectivityColumns& columns) {
  ConnectivityColumns copy;
  const auto copied = [](const ColumnStorage& column) {
    return ColumnStorage(Buffer<Index>::copy_of(column.span()));
  };
  copy.origin = copied(columns.origin);
  copy.opposite = copied(columns.opposite);
  copy.outgoing = copied(columns.outgoing);
  copy.next = copied(columns.next);
  copy.face = copied(columns.face);
  copy.first = copied(columns.first);
  copy.fans = Buffer<FanStart>::copy_of(columns.fans.span());
  copy.form = columns.form;
  copy.all_triangles = false;  // so that the stored columns are the ones that are read
  return digest(Connectivity(std::move(copy)), Execution::serial());
}

TEST(Digest, IsTheSameForStoredAndImplicitColumns) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const ReferenceMesh reference = random_reference_mesh(seed);
    if (!reference.is_all_triangles()) continue;
    const Connectivity implicit = to_connectivity(reference);
    const Connectivity stored = to_connectivity(reference, true);
    EXPECT_EQ(digest(implicit, Execution::serial()), digest(stored, Execution::serial()))
        << "seed " << seed;
  }
}

TEST(Digest, IsTheSameForEveryThreadCountAndGrain) {
  const Result<Soup> soup = shapes::generate(shapes::Shape::gyroid, 100'000);
  ASSERT_TRUE(soup);
  const Result<BuildOutput> built = build(soup->face_list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  const std::uint64_t expected = digest(built->mesh, Execution::serial());
  for (const int threads : kThreadCounts) {
    Threads pool(threads);
    for (const Index grain : {0, 1, 1000, 1 << 20}) {
      EXPECT_EQ(digest(built->mesh, pool.execution(grain)), expected)
          << threads << " threads, grain " << grain;
    }
  }
}

// One entry changed in each column in turn: every one of them counts.
TEST(Digest, ChangesWithEveryColumn) {
  const ReferenceMesh reference = random_reference_mesh(3);
  std::set<std::uint64_t> seen = {digest_of(to_columns(reference, true))};
  const auto add_one = [](ColumnStorage& column) {
    Buffer<Index> changed = Buffer<Index>::copy_of(column.span());
    ++changed[0];
    column = std::move(changed);
  };
  using Member = ColumnStorage ConnectivityColumns::*;
  for (const Member column : {&ConnectivityColumns::origin, &ConnectivityColumns::opposite,
                              &ConnectivityColumns::outgoing, &ConnectivityColumns::next,
                              &ConnectivityColumns::face, &ConnectivityColumns::first}) {
    ConnectivityColumns columns = to_columns(reference, true);
    ASSERT_FALSE((columns.*column).empty());
    add_one(columns.*column);
    EXPECT_TRUE(seen.insert(digest_of(columns)).second);
  }
  ConnectivityColumns columns = to_columns(reference, true);
  columns.fans = Buffer<FanStart>(columns.fans.size() + 1, FanStart{VertexId(0), HalfedgeId(0)});
  EXPECT_TRUE(seen.insert(digest_of(columns)).second);
}

TEST(Digest, TellsDifferentMeshesApart) {
  std::set<std::vector<Index>> origins;
  std::set<std::uint64_t> digests;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const ReferenceMesh reference = random_reference_mesh(seed);
    // Different corners alone make different meshes.
    if (!origins.insert(reference.origin).second) continue;
    digests.insert(digest(to_connectivity(reference), Execution::serial()));
  }
  EXPECT_EQ(digests.size(), origins.size());
  EXPECT_GT(digests.size(), 1000U);
}

TEST(Digest, CoversTheClosedForm) {
  const Result<Soup> soup = shapes::grid(5, 4);
  ASSERT_TRUE(soup);
  const Result<BuildOutput> built = build(soup->face_list(), {}, Execution::serial());
  ASSERT_TRUE(built);
  const Result<Connectivity> closed = close_boundary(built->mesh, Execution::serial());
  ASSERT_TRUE(closed);
  EXPECT_NE(digest(*closed, Execution::serial()), digest(built->mesh, Execution::serial()));
  const Result<Connectivity> opened = open_boundary(*closed, Execution::serial());
  ASSERT_TRUE(opened);
  EXPECT_EQ(digest(*opened, Execution::serial()), digest(built->mesh, Execution::serial()));
}

TEST(Digest, CountsIsolatedVertices) {
  std::set<std::uint64_t> seen;
  for (Index vertices = 0; vertices < 5; ++vertices) {
    const FaceList none = FaceList::triangles<Index>({}, vertices);
    const Result<BuildOutput> built = build(none, {}, Execution::serial());
    ASSERT_TRUE(built);
    EXPECT_TRUE(seen.insert(digest(built->mesh, Execution::serial())).second);
  }
}

TEST(Digest, OfBytesDependsOnEachOfThemAndOnTheirNumber) {
  std::set<std::uint64_t> seen;
  std::vector<std::byte> bytes;
  for (std::size_t size = 0; size <= 40; ++size) {
    EXPECT_TRUE(seen.insert(digest(bytes)).second) << size << " zeros";
    bytes.push_back(std::byte{0});
  }
  for (std::byte& byte : bytes) {
    byte = std::byte{1};
    EXPECT_TRUE(seen.insert(digest(bytes)).second);
    byte = std::byte{0};
  }
}

}  // namespace
}  // namespace hedgerow::test
