// The same bits from every schedule, strategy, input format, index width and compiler.
//
// To renew the table after a change that is meant to change results, run
//   HEDGEROW_PRINT_DIGESTS=1 hedgerow_tests --gtest_filter='*Golden.*OnOneThread*'
// and paste its rows over kGolden. A row that changes without such a reason is a bug. The digests
// are those of little-endian machines.

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/digest.h"
#include "hedgerow/normals.h"
#include "hedgerow/reorder.h"
#include "hedgerow/shapes.h"
#include "hedgerow/workspace.h"
#include "support/plain_build.h"
#include "support/threads.h"

namespace hedgerow::test {
namespace {

constexpr std::int64_t kTriangles = 6'000;
constexpr std::uint64_t kShuffleSeed = 1;

struct Digests {
  std::uint64_t positions = 0;
  std::uint64_t mesh = 0;
  std::uint64_t reordered = 0;       ///< all four methods
  std::uint64_t face_normals = 0;    ///< by both polygon methods
  std::uint64_t vertex_normals = 0;  ///< all four weights
};

struct Row {
  shapes::Shape shape;
  bool is_shuffled;
  Digests expected;
};

constexpr std::array kGolden = [] {
  using enum shapes::Shape;
  return std::array{
      Row{grid,
          false,
          {0x309cc3d185becb2bU, 0x08b012a55a3bb1bcU, 0x791231dc51a41904U, 0xdcaa8656d1f4ed0cU,
           0xd49657f9ed12fd41U}},
      Row{grid,
          true,
          {0x4f95f0a07d9e7568U, 0x56c611aa3e5d7436U, 0xd8ce363c6b1b054aU, 0x7c627a97d6132025U,
           0x0fe2ffa93e4fac4eU}},
      Row{quad_grid,
          false,
          {0x309cc3d185becb2bU, 0x324e359a056ce6e6U, 0x3ec42b4552647ad1U, 0xd69d5c251be6005cU,
           0x29a9b4caa9d2f393U}},
      Row{quad_grid,
          true,
          {0x4f95f0a07d9e7568U, 0x7103d5cce4ab86d8U, 0xf0159ebbf7bec164U, 0x4bee337f0545554fU,
           0x6befa9faa7005ef4U}},
      Row{torus,
          false,
          {0x6032e268ce8927d1U, 0x520ab4d010f75cfaU, 0x85bc23588be224c5U, 0x0d007d5e81412c6bU,
           0x25b10f297f2ee890U}},
      Row{torus,
          true,
          {0x07bf1948d3fb4b95U, 0xe2ed57de4d401012U, 0x894631ade7b7ceeeU, 0x741b72b415dca4f0U,
           0x76224c1055b7ffedU}},
      Row{icosphere,
          false,
          {0xf0df18cad3278fceU, 0x2c8087c71abf2b09U, 0xb87b3771420b50c4U, 0x4ae06c990aa1870aU,
           0x8278088408af8bf2U}},
      Row{icosphere,
          true,
          {0x7b269c78d5420d0dU, 0xdc2ca89a4071664dU, 0xa86ecbf55562e5acU, 0xc78c169bbe2f4d99U,
           0xd5dce080272c24d1U}},
      Row{fan,
          false,
          {0xadb85666c05c5eadU, 0xdcee06f5a54867b1U, 0x542c8d229972c616U, 0x767601ede0f56aa9U,
           0x13689da404bb475eU}},
      Row{fan,
          true,
          {0x768f77bdaaee5c20U, 0x691c09352576697cU, 0x553f676aa970ce7aU, 0x5dfce34d2764749cU,
           0xa3d287c040915f1cU}},
      Row{strip,
          false,
          {0xecf742df07964f4aU, 0x2ce1fd93830df665U, 0x3561267d6a49671cU, 0xb5d600de70390819U,
           0x731da9f79aac6446U}},
      Row{strip,
          true,
          {0x060080674ebb85d1U, 0xac61fb30811ebffbU, 0x5fcc8bcc37c36029U, 0x1756dcaa344b6500U,
           0x9e575a3365eaf187U}},
      Row{mobius,
          false,
          {0x42eb5add2d44fd41U, 0xa855c4fc9b5ae90eU, 0x6b9a0ce654c66e99U, 0xddceb9266e95ba37U,
           0xbe4ab9c419f98818U}},
      Row{mobius,
          true,
          {0xadb96f96e3bb4914U, 0x820633dcfbb955beU, 0x9793075aa6a08e20U, 0xa497b7436b077595U,
           0xfcaa97466af5d754U}},
      Row{klein,
          false,
          {0x997e9b2921a787f3U, 0x7205197d7f3feefdU, 0xcfb8dcb401c60e64U, 0xe93dc96bf35027e8U,
           0xe22d580d9019a37eU}},
      Row{klein,
          true,
          {0x7886ed8f9d096f69U, 0x412bf1f9b7dbb297U, 0xc932e5cb043b4ad5U, 0x6d61cf70da36248bU,
           0xd23701386b2aaffaU}},
      Row{terrain,
          false,
          {0x84fb254bbe44fb13U, 0x08b012a55a3bb1bcU, 0x8e1a5846364460a6U, 0x375de8c21b937b9eU,
           0x742543b25128c894U}},
      Row{terrain,
          true,
          {0x390d045d34ea749bU, 0x56c611aa3e5d7436U, 0x156247735da2e296U, 0x0a04d12c8e9cfad9U,
           0x3c8efcde1bc5ac55U}},
      Row{gyroid,
          false,
          {0xdc144598b3e6b011U, 0x42bbe42312d54b83U, 0xa840ef61c7053ddfU, 0x50988256f7ab69e2U,
           0xb0c56ba5c7592a7cU}},
      Row{gyroid,
          true,
          {0xb7d477b29081df9bU, 0x6f27f2b97c5354e5U, 0x8bb6048aeba4d996U, 0x7e6cf6ee0968d9c2U,
           0xb13835bb20c7d76fU}},
  };
}();

constexpr std::array kReorderMethods = {ReorderMethod::hilbert, ReorderMethod::morton,
                                        ReorderMethod::breadth_first, ReorderMethod::vertex_cache,
                                        ReorderMethod::fronts};
constexpr std::array kWeights = {NormalWeight::uniform, NormalWeight::area, NormalWeight::angle,
                                 NormalWeight::max};

std::uint64_t digest_of(const std::vector<std::uint64_t>& digests) {
  return digest(std::as_bytes(std::span(digests)));
}

std::uint64_t digest_of(const std::vector<float>& values) {
  return digest(std::as_bytes(std::span(values)));
}

Soup soup_of(const Row& row) {
  Result<Soup> soup = shapes::generate(row.shape, kTriangles);
  EXPECT_TRUE(soup);
  return row.is_shuffled ? shapes::shuffled(*soup, kShuffleSeed) : std::move(*soup);
}

Connectivity build_with(const FaceList& faces, BuildStrategy strategy, const Execution& execution) {
  BuildOptions options;
  options.strategy = strategy;
  Result<BuildOutput> output = build(faces, options, execution);
  EXPECT_TRUE(output);
  return std::move(output->mesh);
}

std::uint64_t reordered(const Connectivity& mesh, const Soup& soup, const Execution& execution) {
  std::vector<std::uint64_t> digests;
  for (const ReorderMethod method : kReorderMethods) {
    const auto output = reorder(mesh, soup.positions(), method, execution);
    EXPECT_TRUE(output);
    digests.push_back(digest(output->mesh, execution));
  }
  return digest_of(digests);
}

NormalsOut output_to(std::vector<float>& normals) {
  return {normals.data(), static_cast<std::int64_t>(normals.size() / 3)};
}

std::uint64_t face_normals_of(const Connectivity& mesh, const Soup& soup,
                              const Execution& execution) {
  std::vector<std::uint64_t> digests;
  for (const PolygonMethod method : {PolygonMethod::newell, PolygonMethod::wedge_mean}) {
    std::vector<float> normals(3 * static_cast<std::size_t>(mesh.face_count()));
    NormalOptions options;
    options.polygon = method;
    EXPECT_TRUE(face_normals(mesh, soup.positions(), output_to(normals), options, execution));
    digests.push_back(digest_of(normals));
  }
  return digest_of(digests);
}

enum class VertexMethod : std::uint8_t { gather, scatter };

std::uint64_t vertex_normals_of(const Connectivity& mesh, const Soup& soup, VertexMethod method,
                                const Execution& execution) {
  std::vector<std::uint64_t> digests;
  Workspace workspace;
  for (const NormalWeight weight : kWeights) {
    std::vector<float> normals(3 * static_cast<std::size_t>(mesh.vertex_count()));
    NormalOptions options;
    options.weight = weight;
    const NormalsOut out = output_to(normals);
    EXPECT_TRUE(
        method == VertexMethod::gather
            ? gather_vertex_normals(mesh, soup.positions(), out, options, execution, workspace)
            : scatter_vertex_normals(face_list(mesh), soup.positions(), out, options, execution,
                                     workspace));
    digests.push_back(digest_of(normals));
  }
  return digest_of(digests);
}

std::string row_name(const ::testing::TestParamInfo<Row>& instance) {
  std::string word = name(instance.param.shape);
  for (char& c : word) c = c == '-' ? '_' : c;
  return word + (instance.param.is_shuffled ? "_shuffled" : "");
}

void print(const Row& row, const Digests& found) {
  const auto hex = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::string word = name(row.shape);
  for (char& c : word) c = c == '-' ? '_' : c;
  std::printf("    Row{%s, %s, {0x%016llxU, 0x%016llxU, 0x%016llxU, 0x%016llxU, 0x%016llxU}},\n",
              word.c_str(), row.is_shuffled ? "true" : "false", hex(found.positions),
              hex(found.mesh), hex(found.reordered), hex(found.face_normals),
              hex(found.vertex_normals));
}

class Golden : public ::testing::TestWithParam<Row> {};

INSTANTIATE_TEST_SUITE_P(Determinism, Golden, ::testing::ValuesIn(kGolden), row_name);

TEST_P(Golden, DigestsComeFromAPlainRunOnOneThread) {
  const Soup soup = soup_of(GetParam());
  const Connectivity mesh = built(soup);
  const Execution serial = Execution::serial();
  const Digests found{digest(std::as_bytes(soup.xyz.span())), digest(mesh, serial),
                      reordered(mesh, soup, serial), face_normals_of(mesh, soup, serial),
                      vertex_normals_of(mesh, soup, VertexMethod::gather, serial)};
  if (std::getenv("HEDGEROW_PRINT_DIGESTS") != nullptr) print(GetParam(), found);
  const Digests& expected = GetParam().expected;
  EXPECT_EQ(found.positions, expected.positions);
  EXPECT_EQ(found.mesh, expected.mesh);
  EXPECT_EQ(found.reordered, expected.reordered);
  EXPECT_EQ(found.face_normals, expected.face_normals);
  EXPECT_EQ(found.vertex_normals, expected.vertex_normals);
}

TEST_P(Golden, DigestsComeFromEveryThreadCountGrainAndStrategy) {
  const Soup soup = soup_of(GetParam());
  const Digests& expected = GetParam().expected;
  for (const int count : kThreadCounts) {
    Threads threads(count);
    for (const Index grain : {0, 100}) {
      SCOPED_TRACE(std::to_string(count) + " threads, grain " + std::to_string(grain));
      const Execution execution = threads.execution(grain);
      for (const BuildStrategy strategy :
           {BuildStrategy::automatic, BuildStrategy::window, BuildStrategy::partition}) {
        const Connectivity mesh = build_with(soup.face_list(), strategy, execution);
        EXPECT_EQ(digest(mesh, execution), expected.mesh);
      }
    }
    const Execution execution = threads.execution(100);
    const Connectivity mesh = built(soup);
    EXPECT_EQ(reordered(mesh, soup, execution), expected.reordered);
    EXPECT_EQ(face_normals_of(mesh, soup, execution), expected.face_normals);
    for (const VertexMethod method : {VertexMethod::gather, VertexMethod::scatter}) {
      EXPECT_EQ(vertex_normals_of(mesh, soup, method, execution), expected.vertex_normals);
    }
  }
}

template <class Integer>
std::uint64_t built_from(const Soup& soup, BuildStrategy strategy, const Execution& execution) {
  const std::vector<Integer> corners(soup.corners.begin(), soup.corners.end());
  const std::span<const Integer> view(corners);
  const FaceList faces =
      soup.offsets.empty()
          ? FaceList::triangles<Integer>(view, soup.vertex_count())
          : FaceList::polygons<Integer>(view, soup.offsets.span(), soup.vertex_count());
  return digest(build_with(faces, strategy, execution), execution);
}

TEST_P(Golden, DigestsComeFromEveryIndexFormat) {
  const Soup soup = soup_of(GetParam());
  ASSERT_LT(soup.vertex_count(), 65'536) << "too many for 16 bits";
  const std::uint64_t expected = GetParam().expected.mesh;
  Threads threads(3);
  for (const Execution& execution : {Execution::serial(), threads.execution(100)}) {
    for (const BuildStrategy strategy : {BuildStrategy::window, BuildStrategy::partition}) {
      EXPECT_EQ(built_from<std::uint16_t>(soup, strategy, execution), expected);
      EXPECT_EQ(built_from<std::int32_t>(soup, strategy, execution), expected);
      EXPECT_EQ(built_from<std::uint32_t>(soup, strategy, execution), expected);
      EXPECT_EQ(built_from<std::int64_t>(soup, strategy, execution), expected);
    }
  }
}

}  // namespace
}  // namespace hedgerow::test
