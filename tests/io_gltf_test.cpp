#include <cmath>

#include <gtest/gtest.h>

#include "hedgerow/io/read.h"
#include "json_text.h"
#include "support/io_cases.h"

namespace hedgerow::test {
namespace {

using io::Format;

// Six points, then the indices 0 1 2 2 1 3 as bytes (and two bytes of padding).
std::string buffer_bytes() {
  Bytes bytes;
  for (int i = 0; i < 18; ++i) bytes.value(static_cast<float>(i));
  for (const int i : {0, 1, 2, 2, 1, 3, 0, 0}) bytes.value(static_cast<std::uint8_t>(i));
  return bytes.str();
}

struct Asset {
  std::string buffer = R"({"byteLength":80})";
  std::string views = R"({"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":8})";
  std::string points = R"({"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"})";
  std::string indices = R"({"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"})";
  std::string primitives = R"({"attributes":{"POSITION":0},"indices":1})";
  std::string more;

  [[nodiscard]] std::string json() const {
    return R"({"asset":{"version":"2.0"},"buffers":[)" + buffer + R"(],"bufferViews":[)" + views +
           R"(],"accessors":[)" + points + ',' + indices + R"(],"meshes":[{"primitives":[)" +
           primitives + "]}]" + more + '}';
  }
  [[nodiscard]] std::string glb() const {
    std::string text = json();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string binary = buffer_bytes();
    return Bytes()
        .text("glTF")
        .value(std::uint32_t{2})
        .value(static_cast<std::uint32_t>(28 + text.size() + binary.size()))
        .value(static_cast<std::uint32_t>(text.size()))
        .text("JSON")
        .text(text)
        .value(static_cast<std::uint32_t>(binary.size()))
        .text(std::string("BIN\0", 4))
        .text(binary)
        .str();
  }
  // "CODE" of the failure, or the outcome of success.
  [[nodiscard]] std::string outcome_word(const io::ReadOptions& options = {}) const {
    const std::string word = outcome(glb(), Format::glb, options);
    return word.substr(0, word.find('@'));
  }
};

TEST(IoGltf, ReadsTrianglesStripsAndFans) {
  Asset asset;
  EXPECT_EQ(asset.outcome_word(), "ok 6 2 6");
  asset.primitives = R"({"attributes":{"POSITION":0},"indices":1,"mode":5})";
  const auto strip = read_exact(asset.glb(), Format::glb);
  ASSERT_TRUE(strip) << io::to_string(strip.error());
  // 1 2 2 and 2 2 1 lie between them, so the last one is the fourth, which is turned.
  EXPECT_EQ(faces_of(strip->soup), (std::vector<std::vector<Index>>{{0, 1, 2}, {1, 2, 3}}));
  asset.primitives = R"({"attributes":{"POSITION":0},"mode":6},{"attributes":{"POSITION":0}})";
  const auto fan = read_exact(asset.glb(), Format::glb);
  ASSERT_TRUE(fan) << io::to_string(fan.error());
  EXPECT_EQ(faces_of(fan->soup),
            (std::vector<std::vector<Index>>{
                {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {6, 7, 8}, {9, 10, 11}}));
  asset.primitives = R"({"attributes":{"POSITION":0},"mode":1})";
  EXPECT_EQ(asset.outcome_word(), "ok 0 0 0");
}

TEST(IoGltf, AppliesSparseAccessorsAndStrides) {
  Asset asset;
  asset.points =
      R"({"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","sparse":{"count":1,)"
      R"("indices":{"bufferView":1,"byteOffset":5,"componentType":5121},"values":{"bufferView":0}}})";
  const auto sparse = read_exact(asset.glb(), Format::glb);
  ASSERT_TRUE(sparse) << io::to_string(sparse.error());
  EXPECT_EQ(sparse->soup.xyz[9], 0.0f);  // element 3 is element 0 now
  EXPECT_EQ(sparse->soup.xyz[12], 12.0f);
  asset = Asset();
  asset.views =
      R"({"buffer":0,"byteLength":72,"byteStride":24},{"buffer":0,"byteOffset":72,"byteLength":8})";
  asset.points = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
  asset.indices = R"({"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"})";
  const auto strided = read_exact(asset.glb(), Format::glb);
  ASSERT_TRUE(strided) << io::to_string(strided.error());
  EXPECT_EQ(strided->soup.xyz[3], 6.0f);
}

TEST(IoGltf, RefusesWhatLeavesItsBounds) {
  const auto with = [](std::string Asset::*field, const char* text) {
    Asset asset;
    asset.*field = text;
    return asset.outcome_word();
  };
  EXPECT_EQ(
      with(&Asset::points, R"({"bufferView":0,"componentType":5126,"count":7,"type":"VEC3"})"),
      "bad-accessor");
  EXPECT_EQ(
      with(&Asset::points,
           R"({"bufferView":0,"componentType":5126,"count":6148914691236517206,"type":"VEC3"})"),
      "bad-accessor");
  EXPECT_EQ(with(&Asset::points,
                 R"({"bufferView":0,"byteOffset":4,"componentType":5126,"count":6,"type":"VEC3"})"),
            "bad-accessor");
  EXPECT_EQ(
      with(&Asset::points, R"({"bufferView":9,"componentType":5126,"count":6,"type":"VEC3"})"),
      "bad-accessor");
  EXPECT_EQ(
      with(&Asset::points, R"({"bufferView":0,"componentType":5123,"count":6,"type":"VEC3"})"),
      "bad-accessor");
  EXPECT_EQ(
      with(&Asset::indices, R"({"bufferView":1,"componentType":5120,"count":6,"type":"SCALAR"})"),
      "bad-accessor");
  EXPECT_EQ(
      with(&Asset::indices, R"({"bufferView":1,"componentType":5125,"count":2,"type":"SCALAR"})"),
      "index-out-of-range");
  EXPECT_EQ(with(&Asset::views,
                 R"({"buffer":0,"byteLength":99},{"buffer":0,"byteOffset":72,"byteLength":8})"),
            "bad-accessor");
  EXPECT_EQ(with(&Asset::views,
                 R"({"buffer":7,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":8})"),
            "bad-accessor");
  EXPECT_EQ(with(&Asset::primitives, R"({"attributes":{"POSITION":5}})"), "bad-accessor");
  EXPECT_EQ(with(&Asset::primitives, R"({"attributes":{"POSITION":0},"mode":7})"), "bad-gltf");
  EXPECT_EQ(with(&Asset::buffer, R"({"byteLength":999})"), "bad-gltf");
  EXPECT_EQ(with(&Asset::points, R"({"componentType":5126,"count":4000000000,"type":"VEC3"})"),
            "count-too-large");
  EXPECT_EQ(with(&Asset::more, R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"),
            "unsupported-feature");
}

TEST(IoGltf, CopiesSharedPointsOnceForEachPrimitiveButNotWithoutBound) {
  Asset asset;
  asset.primitives += ',' + asset.primitives;
  EXPECT_EQ(asset.outcome_word(), "ok 12 4 12");
  // Four million zeros, which no buffer holds, shared by many primitives.
  asset = Asset();
  asset.points = R"({"componentType":5126,"count":4000000,"type":"VEC3"})";
  EXPECT_EQ(asset.outcome_word(), "ok 4000000 2 6");
  asset.primitives += ',' + asset.primitives;
  EXPECT_EQ(asset.outcome_word(), "count-too-large");
}

TEST(IoGltf, KeepsAnIndexThatLeavesItsPrimitiveFromReachingTheNextOne) {
  Asset asset;
  asset.points = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
  asset.primitives += ',' + asset.primitives;
  EXPECT_EQ(asset.outcome_word(), "index-out-of-range");
  io::ReadOptions options;
  options.keep_out_of_range = true;
  const auto kept = read_exact(asset.glb(), Format::glb, options);
  ASSERT_TRUE(kept);
  EXPECT_EQ(faces_of(kept->soup).at(1), (std::vector<Index>{2, 1, kInvalidIndex}));
}

TEST(IoGltf, LocatesTheFaultInTheText) {
  EXPECT_EQ(outcome("{\n  \"asset\": }", Format::gltf), "bad-json@2:12");
  EXPECT_EQ(outcome("[]  ", Format::gltf), "bad-gltf@1:1");
  EXPECT_EQ(outcome("", Format::gltf), "empty-file@1:1");
  EXPECT_EQ(outcome("{\"asset\":" + std::string(100000, '['), Format::gltf), "bad-json@1:209");
  const std::string text =
      "{\"asset\":{\"version\":\"2.0\"},\n\"meshes\":[{\"primitives\":[\n"
      "{\"attributes\":{\"POSITION\":4}}]}]}";
  EXPECT_EQ(outcome(text, Format::gltf), "bad-accessor@3:27");
}

TEST(IoGltf, FindsTheValueOfAPointer) {
  const std::string_view text = R"({"a":[1,{"x":"]}\"","b":[true, null]}],"c":2})";
  EXPECT_EQ(text.substr(io::locate_json(text, "/a/1/b/1"), 4), "null");
  EXPECT_EQ(text.substr(io::locate_json(text, "/c"), 1), "2");
  EXPECT_EQ(io::locate_json(text, "/a/7"), text.find('['));
  EXPECT_EQ(io::locate_json(text, ""), 0u);
}

TEST(IoGltf, ReadsBuffersOnlyFromItsOwnDirectory) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "in");
  put_file(folder / "in/good name.bin", buffer_bytes());
  put_file(folder / "outside.bin", buffer_bytes());
  const auto word = [&](const std::string& uri) {
    Asset asset;
    asset.buffer = R"({"byteLength":80,"uri":")" + uri + "\"}";
    put_file(folder / "in/a.gltf", asset.json());
    const auto result = io::read(folder / "in/a.gltf");
    return result ? std::string("ok") : std::string(io::name(result.error().code));
  };
  EXPECT_EQ(word("good%20name.bin"), "ok");
  EXPECT_EQ(word("missing.bin"), "cannot-open");
  for (const char* uri :
       {"../outside.bin", "%2e%2e/outside.bin", "in/../../outside.bin", "/etc/passwd",
        "file:///etc/passwd", "http://example.org/a.bin", "..\\\\outside.bin"}) {
    EXPECT_EQ(word(uri), "forbidden-uri") << uri;
  }
}

TEST(IoGlb, ChecksItsContainer) {
  const std::string good = Asset().glb();
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_NE(outcome(good.substr(0, size), Format::glb).substr(0, 2), "ok") << size;
  }
  std::string other = good;
  other[0] = 'x';
  EXPECT_EQ(outcome(other, Format::glb), "bad-header@0");
  other = good;
  other[4] = 1;
  EXPECT_EQ(outcome(other, Format::glb), "unsupported-variant@4");
  other = good;
  other[15] = 1;
  EXPECT_EQ(outcome(other, Format::glb), "size-mismatch@12");
  other = good;
  other[16] = 'X';
  EXPECT_EQ(outcome(other, Format::glb), "bad-header@16");
}

}  // namespace
}  // namespace hedgerow::test
