#include <cmath>

#include <gtest/gtest.h>

#include "hedgerow/io/read.h"
#include "support/io_cases.h"

namespace hedgerow::test {
namespace {

using io::Format;

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "property list uchar int vertex_indices\n";

std::string header(std::string_view format, int vertices, int faces,
                   const std::string& face_properties = kFaces) {
  return "ply\nformat " + std::string(format) + " 1.0\ncomment c\nobj_info o\nelement vertex " +
         std::to_string(vertices) + "\n" + kXyz + "element face " + std::to_string(faces) + "\n" +
         face_properties + "end_header\n";
}

TEST(IoPly, ReadsAsciiInEveryOrder) {
  const std::string cases[] = {
      header("ascii", 3, 1) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
      header("ascii", 3, 1) + "0 0 0\r\n\r\n1 0 0 \r\n\t0 1 0\r\n3 0 1 2",
      "\xEF\xBB\xBFply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty float64 q\r\n"
      "property list uint8 uint32 vertex_index\r\nproperty list char float t\r\n"
      "element vertex 3\r\nproperty char id\r\nproperty double z\r\nproperty short x\r\n"
      "property float32 y\r\nelement edge 1\r\nproperty int a\r\nend_header\r\n"
      "0.5 3 0 1 2 2 0 .5\r\n9 0 0 0\r\n9 0 1 0\r\n9 0 0 1\r\n7\r\n",
  };
  for (const std::string& text : cases) {
    const auto result = read_exact(text, Format::ply);
    ASSERT_TRUE(result) << io::to_string(result.error());
    EXPECT_EQ(faces_of(result->soup), (std::vector<std::vector<Index>>{{0, 1, 2}}));
    EXPECT_TRUE(result->soup.offsets.empty());
    EXPECT_EQ(result->soup.xyz[3], 1.0f);
    EXPECT_EQ(result->soup.xyz[7], 1.0f);
    EXPECT_TRUE(result->warnings.empty());
  }
}

TEST(IoPly, WarnsOfValuesThatNoPropertyDeclares) {
  const auto result =
      read_exact(header("ascii", 3, 1) + "0 0 0\n1 0 0 5\n0 1 0 6\n3 0 1 2 7\n8\n", Format::ply);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->warnings.size(), 2u);
  EXPECT_EQ(result->warnings[0].code, "extra-values");
  EXPECT_EQ(result->warnings[0].count, 3);
  EXPECT_EQ(result->warnings[0].line, 13);
  EXPECT_EQ(result->warnings[1].code, "trailing-bytes");
}

TEST(IoPly, LocatesWhatIsWrongInAscii) {
  const std::string start = header("ascii", 3, 1);  // 11 lines
  const std::pair<std::string, std::string> cases[] = {
      {start + "0 0 0\n1 0 0\n0 1\n3 0 1 2\n", "missing-value@14:4"},
      {start + "0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", "bad-number@13:5"},
      {start + "0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n", "non-finite@13:5"},
      {start + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "index-out-of-range@15:7"},
      {start + "0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n", "index-out-of-range@15:5"},
      {start + "0 0 0\n1 0 0\n0 1 0\n3 0 1.0 2\n", "bad-number@15:5"},
      {start + "0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n", "missing-value@15:8"},
      {start + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", "bad-count@15:1"},
      {start + "0 0 0\n1 0 0\n0 1 0\n   ", "unexpected-end@15:4"},
      {header("ascii", 3, 999) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "count-too-large@9:14"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_EQ(outcome(text, Format::ply), expected) << text;
}

TEST(IoPly, LocatesWhatIsWrongInTheHeader) {
  const TextCase cases[] = {
      {"", "empty-file@1:1"},
      {"plx\n", "bad-header@1:1"},
      {"ply", "bad-header@1:4"},
      {"ply\n", "unexpected-end@2:1"},
      {"ply\nformat ascii 1.0\nelement vertex 0\n", "unexpected-end@4:1"},
      {"ply\nelement vertex 0\nend_header\n", "bad-header@3:1"},
      {"ply\nformat ascii 2.0\n", "unsupported-variant@2:14"},
      {"ply\nformat binary_middle_endian 1.0\n", "unsupported-variant@2:8"},
      {"ply\nformat ascii 1.0\nelement vertex -1\n", "bad-count@3:16"},
      {"ply\nformat ascii 1.0\nelement vertex 1x\n", "bad-count@3:16"},
      {"ply\nformat ascii 1.0\nelement vertex\n", "missing-value@3:15"},
      {"ply\nformat ascii 1.0\nelement vertex 99999999999999999999\n", "count-too-large@3:16"},
      {"ply\nformat ascii 1.0\nproperty float x\n", "bad-header@3:1"},
      {"ply\nformat ascii 1.0\nelement vertex 0\nproperty real x\n", "unknown-type@4:10"},
      {"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty int x\n",
       "duplicate-property@5:14"},
      {"ply\nformat ascii 1.0\nelement vertex 0\nproperty list float int x\n", "bad-property@4:15"},
      {"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nend_header\n",
       "missing-property@3:16"},
      {"ply\nformat ascii 1.0\nelement point 0\nend_header\n", "missing-element@5:1"},
      {"ply\nformat ascii 1.0\nhello\n", "bad-header@3:1"},
      {std::string_view("p\0l\0y\0\n\0", 8), "utf16-text@1:2"},
  };
  for (const TextCase& c : cases) EXPECT_EQ(outcome(c.text, Format::ply), c.outcome) << c.text;
}

TEST(IoPly, RefusesFacesWithoutIntegerIndices) {
  EXPECT_EQ(outcome(header("ascii", 0, 1, "property int q\n") + "1\n", Format::ply),
            "missing-property@9:14");
  EXPECT_EQ(outcome(header("ascii", 0, 1, "property list uchar float vertex_index\n") + "0\n",
                    Format::ply),
            "bad-property@9:14");
}

// One vertex record with the coordinates as this type, then a face.
template <class T>
void expect_type(const std::string& type, bool is_big) {
  Bytes bytes(is_big);
  bytes.text("ply\nformat binary_" + std::string(is_big ? "big" : "little") +
             "_endian 1.0\nelement vertex 3\nproperty uchar flag\nproperty " + type +
             " y\nproperty " + type + " x\nproperty float w\nproperty " + type +
             " z\nelement junk 2\nproperty list ushort double a\nproperty short b\n"
             "element face 1\nproperty list int float t\nproperty list short " +
             (std::is_floating_point_v<T> ? "int" : type) + " vertex_index\nproperty double q\n" +
             "end_header\n");
  for (int v = 0; v < 3; ++v) {
    bytes.value(std::uint8_t{10}).value(static_cast<T>(v)).value(static_cast<T>(v + 1));
    bytes.value(0.5f).value(static_cast<T>(v + 2));
  }
  bytes.value(std::uint16_t{2}).value(1.0).value(2.0).value(std::int16_t{-1});
  bytes.value(std::uint16_t{0}).value(std::int16_t{-1});
  bytes.value(std::int32_t{1}).value(9.0f).value(std::int16_t{3});
  for (int v = 0; v < 3; ++v) {
    if constexpr (std::is_floating_point_v<T>) {
      bytes.value(std::int32_t{v});
    } else {
      bytes.value(static_cast<T>(v));
    }
  }
  bytes.value(1.0);
  const auto result = read_exact(bytes.str(), Format::ply);
  ASSERT_TRUE(result) << type << ": " << io::to_string(result.error());
  EXPECT_EQ(faces_of(result->soup), (std::vector<std::vector<Index>>{{0, 1, 2}})) << type;
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_EQ(result->soup.xyz[3 * v], static_cast<float>(v + 1)) << type;
    EXPECT_EQ(result->soup.xyz[3 * v + 1], static_cast<float>(v)) << type;
    EXPECT_EQ(result->soup.xyz[3 * v + 2], static_cast<float>(v + 2)) << type;
  }
  // Cut anywhere, it is refused.
  const std::size_t body = bytes.str().find("end_header\n") + 11;
  for (std::size_t size = body; size < bytes.str().size(); ++size) {
    EXPECT_NE(outcome(bytes.str().substr(0, size), Format::ply).substr(0, 2), "ok") << size;
  }
}

TEST(IoPly, ReadsEveryTypeInBothByteOrders) {
  for (const bool is_big : {false, true}) {
    expect_type<std::int8_t>("char", is_big);
    expect_type<std::uint8_t>("uint8", is_big);
    expect_type<std::int16_t>("short", is_big);
    expect_type<std::uint16_t>("uint16", is_big);
    expect_type<std::int32_t>("int", is_big);
    expect_type<std::uint32_t>("uint32", is_big);
    expect_type<float>("float", is_big);
    expect_type<double>("float64", is_big);
  }
}

TEST(IoPly, TakesALineFeedAfterACarriageReturnHeaderForData) {
  // The first byte of the body is 10; only where lines end in CR LF does it belong to the header.
  Bytes bytes;
  bytes.text(
      "ply\rformat binary_little_endian 1.0\relement vertex 1\rproperty uchar x\r"
      "property uchar y\rproperty uchar z\rend_header\r\n\x02\x03");
  const auto result = read_exact(bytes.str(), Format::ply);
  ASSERT_TRUE(result) << io::to_string(result.error());
  EXPECT_EQ(result->soup.xyz[0], 10.0f);
  EXPECT_EQ(outcome("ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\n"
                    "property uchar x\r\nproperty uchar y\r\nproperty uchar z\r\nend_header\r\n"
                    "\n\x02\x03",
                    Format::ply),
            "ok 1 0 0");
}

std::string strips(std::initializer_list<int> values) {
  Bytes bytes;
  bytes.text("ply\nformat binary_little_endian 1.0\nelement vertex 6\n" + kXyz +
             "element tristrips 1\nproperty list int int vertex_indices\nend_header\n");
  for (int i = 0; i < 18; ++i) bytes.value(static_cast<float>(i));
  bytes.value(static_cast<std::int32_t>(values.size()));
  for (const int value : values) bytes.value(std::int32_t{value});
  return bytes.str();
}

TEST(IoPly, CutsStripsIntoTrianglesOfOneWinding) {
  const auto result = read_exact(strips({0, 1, 2, 3, 3, 4, 5, -1, 5, 4, 3, -1, 1}), Format::ply);
  ASSERT_TRUE(result) << io::to_string(result.error());
  EXPECT_EQ(faces_of(result->soup),
            (std::vector<std::vector<Index>>{{0, 1, 2}, {2, 1, 3}, {3, 4, 5}, {5, 4, 3}}));
  EXPECT_EQ(outcome(strips({0, 1, 6}), Format::ply).substr(0, 18), "index-out-of-range");
}

TEST(IoPly, LocatesWhatIsWrongInBinary) {
  const std::string start = header("binary_little_endian", 1, 1);
  const std::size_t body = start.size();
  const auto file = [&](float x, std::int32_t index, std::uint8_t count) {
    return Bytes()
        .text(start)
        .value(0.0f)
        .value(x)
        .value(0.0f)
        .value(count)
        .value(0)
        .value(0)
        .value(index)
        .str();
  };
  const auto at = [](const char* code, std::size_t offset) {
    return std::string(code) + '@' + std::to_string(offset);
  };
  EXPECT_EQ(outcome(file(0, 0, 3), Format::ply), "ok 1 1 3");
  EXPECT_EQ(outcome(file(0, 1, 3), Format::ply), at("index-out-of-range", body + 21));
  EXPECT_EQ(outcome(file(0, -1, 3), Format::ply), at("index-out-of-range", body + 21));
  EXPECT_EQ(outcome(file(NAN, 0, 3), Format::ply), at("non-finite", body + 4));
  EXPECT_EQ(outcome(file(0, 0, 4), Format::ply), at("unexpected-end", body + 12));
  EXPECT_EQ(outcome(header("binary_little_endian", 5, 0) + std::string(59, '\0'), Format::ply),
            at("count-too-large", body));
  // Counts and lists that are fine, and a byte too many.
  const auto longer = read_exact(file(0, 0, 3) + "x", Format::ply);
  ASSERT_TRUE(longer);
  EXPECT_EQ(longer->warnings.at(0).code, "trailing-bytes");
}

}  // namespace
}  // namespace hedgerow::test
