// Random face lists against the oracle: every output of `build`, whatever the policies, the
// strategy, the format of the input and the schedule.

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "support/numbers.h"
#include "support/random_faces.h"
#include "support/reference_mesh.h"

namespace hedgerow::test {
namespace {

// The bytes of one face list in one of the forms that a caller may have it in.
struct StoredFaces {
  std::vector<std::byte> corners;
  std::vector<Index> offsets;
  FaceList list;
};

bool is_all_triangles(const PlainFaces& plain) {
  for (const Corners& face : plain.faces) {
    if (face.size() != 3) return false;
  }
  return true;
}

IndexFormat any_format(const PlainFaces& plain, Random& random) {
  bool is_negative = false;
  for (const Corners& face : plain.faces) {
    for (const std::int64_t v : face) is_negative |= v < 0;
  }
  using enum IndexFormat;
  if (is_negative) return random.one_in(2) ? int32 : int64;
  return random.any_of<IndexFormat>({int32, uint32, uint16, int64, kNativeFormat, kNativeFormat});
}

void append(std::vector<std::byte>& bytes, std::int64_t value, IndexFormat format) {
  const std::size_t size = size_bytes(format);
  bytes.resize(bytes.size() + size);
  std::memcpy(bytes.data() + bytes.size() - size, &value, size);  // little-endian
}

void store(const PlainFaces& plain, Random& random, StoredFaces& stored) {
  const IndexFormat format = any_format(plain, random);
  const bool as_triangles = is_all_triangles(plain) && !random.one_in(4);
  const std::size_t gap =
      random.one_in(3) ? size_bytes(format) * (1 + random.below(std::size_t{3})) : 0;
  const auto fill_gap = [&] {
    stored.corners.resize(stored.corners.size() + gap, std::byte{0xa5});
  };
  stored.offsets = {0};
  for (const Corners& face : plain.faces) {
    for (const std::int64_t v : face) {
      append(stored.corners, v, format);
      if (!as_triangles) fill_gap();
    }
    if (as_triangles) fill_gap();
    stored.offsets.push_back(stored.offsets.back() + static_cast<Index>(face.size()));
  }
  stored.list.corners = stored.corners.data();
  stored.list.format = format;
  stored.list.stride_bytes = (as_triangles ? 3 : 1) * size_bytes(format) + gap;
  stored.list.offsets = as_triangles ? nullptr : stored.offsets.data();
  stored.list.face_count = static_cast<std::int64_t>(plain.faces.size());
  stored.list.vertex_count = plain.vertex_count;
}

// Kept within what the random lists hold, so that most builds get past the first phases.
Policies any_policies(Random& random) {
  Policies policies;
  if (random.one_in(4)) return policies;
  policies[DefectKind::out_of_range] = Action::skip;
  for (std::size_t k = 1; k < kDefectKindCount; ++k) {
    const auto kind = static_cast<DefectKind>(k);
    Action action{};
    do {
      action = static_cast<Action>(random.below(5));
    } while (!is_supported(kind, action) || (action == Action::fail && !random.one_in(6)));
    policies[kind] = action;
  }
  return policies;
}

template <class View>
void expect_same_faces(const View& view, const ReferenceMesh& expected) {
  ASSERT_EQ(view.face_count(), expected.face_count());
  for (Index h = 0; h < expected.halfedge_count(); ++h) {
    const auto i = static_cast<std::size_t>(h);
    ASSERT_EQ(view.next(HalfedgeId(h)).value, expected.next[i]);
    ASSERT_EQ(view.prev(HalfedgeId(h)).value, expected.prev[i]);
    ASSERT_EQ(view.face(HalfedgeId(h)).value, expected.face[i]);
  }
  for (Index f = 0; f < expected.face_count(); ++f) {
    ASSERT_EQ(view.first(FaceId(f)).value, expected.first[static_cast<std::size_t>(f)]);
  }
}

void expect_same(const BuildOutput& output, const ReferenceBuild& expected) {
  const ReferenceMesh& mesh = expected.mesh;
  ASSERT_EQ(to_vector(output.mesh.origin()), mesh.origin);
  ASSERT_EQ(to_vector(output.mesh.opposite()), mesh.opposite);
  ASSERT_EQ(to_vector(output.mesh.outgoing()), mesh.outgoing);
  const std::vector<FanStart> fans(output.mesh.fans().begin(), output.mesh.fans().end());
  ASSERT_EQ(fans, mesh.fans);
  ASSERT_EQ(output.mesh.is_implicit(), mesh.is_all_triangles());
  output.mesh.visit([&](const auto& view) { expect_same_faces(view, mesh); });

  const std::vector<Defect> defects(output.defects.begin(), output.defects.end());
  ASSERT_EQ(defects, expected.defects);
  ASSERT_EQ(to_vector(output.faces_new_to_old.span()), expected.faces_new_to_old);
  ASSERT_EQ(to_vector(output.vertices_new_to_old.span()), expected.vertices_new_to_old);
  ASSERT_EQ(output.stats.edge_count, expected.edge_count);
  ASSERT_EQ(output.stats.boundary_edge_count, expected.boundary_edge_count);
  for (std::size_t k = 0; k < kDefectKindCount; ++k) {
    const auto count = std::count_if(defects.begin(), defects.end(), [&](const Defect& d) {
      return static_cast<std::size_t>(d.kind) == k;
    });
    ASSERT_EQ(output.stats.defect_count[k], count);
  }
}

void expect_same_error(const Error& error, const Error& expected) {
  EXPECT_STREQ(name(error.code), name(expected.code));
  EXPECT_EQ(error.element, expected.element);
  EXPECT_EQ(error.value, expected.value);
  EXPECT_EQ(error.limit, expected.limit);
  EXPECT_EQ(error.count, expected.count);
}

std::string describe(const PlainFaces& plain, const BuildOptions& options) {
  std::string text = "vertices " + std::to_string(plain.vertex_count) + ", faces";
  for (std::size_t f = 0; f < plain.faces.size() && f < 100; ++f) {
    text += " (";
    for (const std::int64_t v : plain.faces[f]) text += " " + std::to_string(v);
    text += " )";
  }
  for (std::size_t k = 0; k < kDefectKindCount; ++k) {
    const auto kind = static_cast<DefectKind>(k);
    text += std::string(", ") + name(kind) + "=" + name(options.policies[kind]);
  }
  return text;
}

void compare_with_oracle(const PlainFaces& plain, std::uint64_t seed) {
  Random random(seed ^ 0x9e3779b97f4a7c15ULL);
  StoredFaces stored;
  store(plain, random, stored);
  BuildOptions options;
  options.policies = any_policies(random);
  options.borrow_corners = random.one_in(2);
  options.strategy = static_cast<BuildStrategy>(random.below(3));
  const Execution execution =
      random.one_in(2)
          ? Execution::serial()
          : Execution::current_arena().with_grain(static_cast<Index>(1 + random.below(8)));
  SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(plain, options));

  const auto expected = reference_build(plain, options.policies);
  const auto output = build(stored.list, options, execution);
  ASSERT_EQ(output.has_value(), expected.has_value());
  if (output) {
    expect_same(*output, *expected);
  } else {
    expect_same_error(output.error(), expected.error());
  }
}

class BuildOracle : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(BuildOracle, AgreesOnAThousandRandomFaceLists) {
  for (std::uint64_t i = 0; i < 1000 && !HasFailure(); ++i) {
    const std::uint64_t seed = 1000 * GetParam() + i;
    compare_with_oracle(random_faces(seed), seed);
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, BuildOracle, ::testing::Range<std::uint64_t>(0, 24));

// Vertices so far apart that they fall into many blocks, in an order that is local or not.
TEST(BuildOracleWide, AgreesOnFacesSpreadOverManyBlocks) {
  for (std::uint64_t seed = 0; seed < 30 && !HasFailure(); ++seed) {
    PlainFaces plain = random_faces(seed);
    for (Corners& face : plain.faces) {
      for (std::int64_t& v : face) v = v < 0 ? v : v * 1499;
    }
    plain.vertex_count = (plain.vertex_count - 1) * 1499 + 1;
    compare_with_oracle(plain, seed);
  }
}

// Every index of a 16-bit list, and numbers that fit no Index.
TEST(BuildOracleWide, TakesUnsignedIndicesForWhatTheyAre) {
  const std::vector<std::uint32_t> corners = {0, 1, 2, 0, 1, 0xffffffffU};
  const auto output =
      build(FaceList::triangles<std::uint32_t>(corners, 3), {}, Execution::serial());
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().code, ErrorCode::index_out_of_range);
  EXPECT_EQ(output.error().element, 1);
  EXPECT_EQ(output.error().value, 0xffffffffLL);
}

}  // namespace
}  // namespace hedgerow::test
