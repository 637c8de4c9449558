// Small seeds, damaged in seeded ways: whatever comes out, no reader may leave its buffer, and what
// it accepts must be a mesh. Meant for the sanitizers; the exact-size blocks are theirs to watch.
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/io/points.h"
#include "hedgerow/io/read.h"
#include "support/io_cases.h"

namespace hedgerow::test {
namespace {

using io::Format;

constexpr int kRounds = 4000;
constexpr std::size_t kLargestInput = 4096;

struct Seed {
  Format format;
  std::string bytes;
};

std::string binary_ply(bool is_big) {
  Bytes bytes(is_big);
  bytes.text(std::string("ply\nformat binary_") + (is_big ? "big" : "little") +
             "_endian 1.0\nelement vertex 4\nproperty float x\nproperty double y\n"
             "property short z\nelement face 2\nproperty uchar c\n"
             "property list uchar int vertex_indices\nproperty list int short t\nend_header\n");
  for (int v = 0; v < 4; ++v) {
    bytes.value(static_cast<float>(v)).value(1.5).value(static_cast<std::int16_t>(v));
  }
  for (int f = 0; f < 2; ++f) {
    bytes.value(std::uint8_t{1}).value(std::uint8_t{3}).value(0).value(1).value(2 + f);
    bytes.value(1).value(std::int16_t{5});
  }
  return bytes.str();
}

std::string strip_ply() {
  Bytes bytes;
  bytes.text(
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\nelement tristrips 1\n"
      "property list int int vertex_indices\nend_header\n");
  for (int i = 0; i < 12; ++i) bytes.value(static_cast<float>(i));
  bytes.value(6);
  for (const int i : {0, 1, 2, -1, 3, 2}) bytes.value(i);
  return bytes.str();
}

std::string binary_stl() {
  Bytes bytes;
  bytes.text(std::string(80, 's')).value(std::uint32_t{2});
  for (int f = 0; f < 2; ++f) {
    for (int i = 0; i < 12; ++i) bytes.value(static_cast<float>(i % 5));
    bytes.value(std::uint16_t{0});
  }
  return bytes.str();
}

std::string binary_off() {
  Bytes bytes;
  bytes.text("OFF BINARY\n").value(3).value(1).value(0);
  for (int i = 0; i < 9; ++i) bytes.value(static_cast<float>(i));
  bytes.value(3).value(0).value(1).value(2);
  return bytes.str();
}

const char* const kGltfJson =
    R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":44BUFFER}],"bufferViews":[)"
    R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8}],"accessors":[)"
    R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,"indices":)"
    R"({"bufferView":1,"componentType":5121},"values":{"bufferView":0}}},)"
    R"({"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],"meshes":[{"primitives":)"
    R"([{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"mode":5}]}]})";

std::string gltf_json(const std::string& uri) {
  std::string json = kGltfJson;
  json.replace(json.find("BUFFER"), 6, uri);
  return json;
}

std::string glb() {
  std::string json = gltf_json("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  Bytes bytes;
  bytes.text("glTF").value(2).value(static_cast<std::int32_t>(28 + json.size() + 44));
  bytes.value(static_cast<std::int32_t>(json.size())).text("JSON").text(json);
  bytes.value(44).text(std::string("BIN\0", 4));
  for (int i = 0; i < 9; ++i) bytes.value(static_cast<float>(i));
  for (const int i : {0, 1, 2, 0, 0, 0, 0, 0}) bytes.value(static_cast<std::uint8_t>(i));
  return bytes.str();
}

std::vector<Seed> seeds() {
  const std::string data =
      "\"uri\":\"data:application/octet-stream;base64," + std::string(56, 'A') + "AAA=\"";
  return {
      {Format::obj,
       "# c\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\nv 1e1 -.5 +3\nf 1/1 2//2 3/3/3\nf -1 -2 \\\n-3 -4\nl 1 "
       "2\n"},
      {Format::off,
       "COFF\n4 2 0\n0 0 0 1 1 1 1\n1 0 0\n0 1 0\n1 1 1 # c\n3 0 1 2 255 0 0\n4 0 1 2 3\n"},
      {Format::off, binary_off()},
      {Format::ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
       "property list char int t\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 5\n"},
      {Format::ply, binary_ply(false)},
      {Format::ply, binary_ply(true)},
      {Format::ply, strip_ply()},
      {Format::stl,
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
       "endloop\nendfacet\nendsolid a\n"},
      {Format::stl, binary_stl()},
      {Format::gltf, gltf_json("," + data)},
      {Format::glb, glb()},
      {Format::wet,
       "wet 1\nvertices 4\n0 0 0 1\n1 0 0 1\n0 1 0 2\n5 5 5 0\nfaces 1\n3\nedges 3\n"
       "1 2 3 2 0 0 1 0 # c\n2 3 1 3 0 0 1 0\n3 1 2 1 0 0 1 0\n"},
  };
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string damaged(std::string bytes) {
    const std::size_t changes = 1 + below(4);
    for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) change(bytes);
    if (bytes.size() > kLargestInput) bytes.resize(kLargestInput);
    return bytes;
  }

 private:
  std::size_t below(std::size_t limit) { return random_() % limit; }

  void change(std::string& bytes) {
    static const char* const kWords[] = {"-1",         "0",
                                         "4294967296", "99999999999999999999",
                                         "nan",        "1e999",
                                         " ",          "\n",
                                         "\\\n",       "\r",
                                         "#",          "/",
                                         "\"",         "[",
                                         "{",          "255",
                                         "2147483647", "property list int int q\n"};
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(below(2) == 0 ? below(256) : 255 * below(2));
        break;
      case 2:
        bytes.erase(at, 1 + below(8));
        break;
      case 3:
        bytes.insert(at, kWords[below(std::size(kWords))]);
        break;
      case 4:
        bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(30)));
        break;
      default:
        bytes.resize(below(4) == 0 ? at : bytes.size());
        break;
    }
  }

  std::mt19937 random_;
};

void expect_mesh(const io::ReadOutput& output, bool is_strict) {
  const Soup& soup = output.soup;
  ASSERT_EQ(soup.xyz.size() % 3, 0u);
  if (!soup.offsets.empty()) {
    ASSERT_EQ(soup.offsets[0], 0);
    ASSERT_TRUE(std::ranges::is_sorted(soup.offsets.span()));
    ASSERT_EQ(static_cast<std::size_t>(soup.offsets[soup.offsets.size() - 1]), soup.corners.size());
  } else {
    ASSERT_EQ(soup.corners.size() % 3, 0u);
  }
  if (!is_strict) return;
  for (const Index vertex : soup.corners) {
    ASSERT_GE(vertex, 0);
    ASSERT_LT(vertex, soup.vertex_count());
  }
  for (const float x : soup.xyz) ASSERT_TRUE(std::isfinite(x));
}

TEST(IoFuzz, DamagedFilesAreReadAsMeshesOrRefusedWithAPlace) {
  io::ReadOptions lenient;
  lenient.keep_non_finite = true;
  lenient.keep_out_of_range = true;
  unsigned seed_number = 1;
  for (const Seed& seed : seeds()) {
    SCOPED_TRACE(testing::Message() << io::name(seed.format) << " seed " << seed_number);
    const auto whole = read_exact(seed.bytes, seed.format);
    ASSERT_TRUE(whole) << io::to_string(whole.error());
    Mutator mutator(seed_number++);
    int refused_count = 0;
    for (int round = 0; round < kRounds; ++round) {
      const std::string bytes = mutator.damaged(seed.bytes);
      SCOPED_TRACE(round);
      const auto strict = read_exact(bytes, seed.format);
      if (strict) {
        ASSERT_NO_FATAL_FAILURE(expect_mesh(*strict, true));
      } else {
        ++refused_count;
        const io::IoError& error = strict.error();
        ASSERT_TRUE((error.line > 0 && error.column > 0) || error.byte >= 0)
            << io::to_string(error);
        ASSERT_LE(error.byte, static_cast<std::int64_t>(bytes.size()));
      }
      const auto kept = read_exact(bytes, seed.format, lenient);
      ASSERT_TRUE(kept || !strict);
      if (kept) {
        ASSERT_NO_FATAL_FAILURE(expect_mesh(*kept, false));
      }
    }
    // The damage must have been worth something.
    EXPECT_GT(refused_count, kRounds / 20);
    EXPECT_LT(refused_count, kRounds);
  }
}

TEST(IoFuzz, DamagedPointsAreReadOrRefusedWithAPlace) {
  const std::pair<const char*, std::string> files[] = {
      {"a.xy", "# points\n0 0\n1 0.5 # one\n-1e3\t+2\n3 4 5\n\n0 1\n"},
      {"a.csv", "name,X,\"y\",\"a, b\"\n\"p \"\"0\"\"\",0,0,\nq,1, 0.5 ,7\n# c\nr,-1e3,2\n"},
      {"b.csv", "0,0\r\n1,0.5\r\n3,4,5\r\n0,1"}};
  io::ReadOptions lenient;
  lenient.keep_non_finite = true;
  unsigned seed_number = 100;
  for (const auto& [name, text] : files) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(io::read_points_bytes(text, name));
    Mutator mutator(seed_number++);
    int refused_count = 0;
    for (int round = 0; round < kRounds; ++round) {
      const std::string damaged = mutator.damaged(text);
      const std::vector<char> bytes(damaged.begin(), damaged.end());  // of exactly that size
      SCOPED_TRACE(round);
      const auto strict = io::read_points_bytes(bytes, name);
      const auto kept = io::read_points_bytes(bytes, name, lenient);
      ASSERT_TRUE(kept || !strict);
      if (strict) {
        for (const Point2& p : strict->points) {
          ASSERT_TRUE(std::isfinite(p[0]) && std::isfinite(p[1]));
        }
      } else {
        ++refused_count;
        ASSERT_TRUE(strict.error().line > 0 && strict.error().column > 0)
            << io::to_string(strict.error());
      }
    }
    EXPECT_GT(refused_count, kRounds / 20);
    EXPECT_LT(refused_count, kRounds);
  }
}

}  // namespace
}  // namespace hedgerow::test
