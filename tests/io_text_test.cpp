// What text may look like, in the formats that have it: OBJ and OFF.
#include <clocale>
#include <cmath>
#include <limits>
#include <locale>

#include <gtest/gtest.h>

#include "hedgerow/io/read.h"
#include "support/io_cases.h"

namespace hedgerow::test {
namespace {

using io::Format;

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(IoObj, ReadsWhatTheFormatAllows) {
  const TextCase cases[] = {
      {"", "ok 0 0 0"},
      {"# nothing\n\n  # else", "ok 0 0 0"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", "ok 3 1 3"},
      {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", "ok 3 1 3"},
      {"v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", "ok 3 1 3"},
      {"v 0 0 0\rv 1 0 0\r\nv 0 1 0\n\rf 1 2 3\n", "ok 3 1 3"},
      {"\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "ok 3 1 3"},
      {"f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "ok 3 1 3"},
      {"\tv\v0\f0 0  \nV 1 0 0\t\n v 0 1 0\n  F  1\t2 3 # face\n", "ok 3 1 3"},
      {"v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0 0 1#x\nf 1/1 2//2 3/3/3", "ok 3 1 3"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/ 2// 3/1/\n", "ok 3 1 3"},
      {"v 0 0 \\\n0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n2\\\n 3\n", "ok 3 1 3"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 9 9 9\nf -1 -2 -3\n", "ok 4 2 6"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3 4\nf 1\nf\nf 1 1 2\n", "ok 4 4 8"},
      {"v +1 -.5 1.\nv 1e2 1E-2 -0\nvt 0 0\nvn 0 0 1\ng a b\nusemtl c\\\nd\n", "ok 2 0 0"},
      {"# path c:\\\nv 0 0 0\n", "ok 1 0 0"},
      {"v 1 2 3\nwhatever 4\n", "ok 1 0 0"},
  };
  for (const TextCase& c : cases) EXPECT_EQ(outcome(c.text, Format::obj), c.outcome) << c.text;
}

TEST(IoObj, LocatesWhatIsWrong) {
  const TextCase cases[] = {
      {"v 0 0\n", "missing-value@1:6"},
      {"v 0 0 # 0\n", "missing-value@1:7"},
      {"v 0 x 0\n", "bad-number@1:5"},
      {"\xEF\xBB\xBFv 0 x 0\n", "bad-number@1:5"},
      {"v 0 0 0\r\nv 0 1,5 0\r\n", "bad-number@2:5"},
      {"v 0 0 0\rv 0 0x1p3 0\r", "bad-number@2:5"},
      {"v 0 0 1d3\n", "bad-number@1:7"},
      {"v 0 0 1e\n", "bad-number@1:7"},
      {"v 0 0 +-1\n", "bad-number@1:7"},
      {"v 0 0 0 red\n", "bad-number@1:9"},
      {"v 0 nan 0\n", "non-finite@1:5"},
      {"v 0 -inf 0\n", "non-finite@1:5"},
      {"v 0 0 1e400\n", "non-finite@1:7"},
      {"v 0 0 0\nf 0 1 1\n", "index-out-of-range@2:3"},
      {"v 0 0 0\nf 1 1 -2\n", "index-out-of-range@2:7"},
      {"v 0 0 0\nf 1 1 2\nf 1 1 1\n", "index-out-of-range@2:7"},
      {"f 1 1 1\n", "index-out-of-range@1:3"},
      {"v 0 0 0\nf 1 1 2147483648\n", "index-out-of-range@2:7"},
      {"v 0 0 0\nf 1 1 4294967297\n", "index-out-of-range@2:7"},
      {"v 0 0 0\nf 1 1 9223372036854775808\n", "index-out-of-range@2:7"},
      {"v 0 0 0\nf 1 1 99999999999999999999999\n", "index-out-of-range@2:7"},
      {"v 0 0 0\nf 1 a 1\n", "bad-number@2:5"},
      {"v 0 0 0\nf 1 1/x 1\n", "bad-number@2:5"},
      {"v 0 0 0\nf 1 1/1/1/1 1\n", "bad-number@2:5"},
      {"v 0 0 0\nf 1 1.0 1\n", "bad-number@2:5"},
      {"version https://example.org\noid 1\n", "unknown-format@1:1"},
      {std::string_view("v 0 0 0\0\n", 9), "nul-byte@1:8"},
      {std::string_view("\xFF\xFEv\0 \0", 6), "utf16-text@1:1"},
      {std::string_view("\0v\0 \0", 5), "utf16-text@1:1"},
      {"\x1f\x8b\x08", "compressed-file@0"},
  };
  for (const TextCase& c : cases) EXPECT_EQ(outcome(c.text, Format::obj), c.outcome) << c.text;
}

TEST(IoObj, SaysInOneLineWhatIsWrongAndWhere) {
  const auto result = read_exact("v 0 0 0\nf 1 1 9\n", Format::obj);
  ASSERT_FALSE(result);
  EXPECT_EQ(io::to_string(result.error()),
            "case.obj:2:7: error: index-out-of-range: face 0 refers to vertex 9, the file has 1");
}

TEST(IoObj, KeepsFacesThatLeaveTheRangeWhenAsked) {
  io::ReadOptions options;
  options.keep_out_of_range = true;
  const auto result = read_exact(
      kThree +
          "f 1 2 4\nf 0 1 2\nf 1 2 -9\nf 1 2 99999999999999999999\nf 1 2 4294967299\nf 1 2 3\n",
      Format::obj, options);
  ASSERT_TRUE(result) << io::to_string(result.error());
  const auto faces = faces_of(result->soup);
  ASSERT_EQ(faces.size(), 6u);
  EXPECT_EQ(faces[0], (std::vector<Index>{0, 1, 3}));
  EXPECT_EQ(faces[1], (std::vector<Index>{kInvalidIndex, 0, 1}));
  EXPECT_EQ(faces[2], (std::vector<Index>{0, 1, -6}));
  EXPECT_EQ(faces[3], (std::vector<Index>{0, 1, kInvalidIndex}));
  const auto wide = static_cast<Index>(sizeof(Index) == 8 ? 4294967298 : kInvalidIndex);
  EXPECT_EQ(faces[4], (std::vector<Index>{0, 1, wide}));
  EXPECT_EQ(faces[5], (std::vector<Index>{0, 1, 2}));
}

TEST(IoObj, KeepsCoordinatesThatAreNotFiniteWhenAsked) {
  io::ReadOptions options;
  options.keep_non_finite = true;
  const auto result = read_exact("v nan -inf 1e400\n", Format::obj, options);
  ASSERT_TRUE(result);
  EXPECT_TRUE(std::isnan(result->soup.xyz[0]));
  EXPECT_EQ(result->soup.xyz[1], -std::numeric_limits<float>::infinity());
  EXPECT_EQ(result->soup.xyz[2], std::numeric_limits<float>::infinity());
}

TEST(IoObj, RoundsNumbersCorrectly) {
  const std::string long_mantissa = "1." + std::string(400, '3') + "e0";
  const auto result =
      read_exact("v 1e-45 1e-400 " + long_mantissa + "\nv 16777217 0.1 -0\n", Format::obj);
  ASSERT_TRUE(result);
  const Buffer<float>& xyz = result->soup.xyz;
  EXPECT_EQ(xyz[0], std::numeric_limits<float>::denorm_min());
  EXPECT_EQ(xyz[1], 0.0f);
  EXPECT_EQ(xyz[2], 1.3333333333f);
  EXPECT_EQ(xyz[3], 16777216.0f);
  EXPECT_EQ(xyz[4], 0.1f);
  EXPECT_TRUE(std::signbit(xyz[5]));
}

TEST(IoObj, ReadsALineOfTenMegabytesAndALargePolygon) {
  constexpr int kCorners = 70000;
  std::string text = "#" + std::string(10'000'000, 'x') + "\n";
  std::string face = "f";
  for (int i = 1; i <= kCorners; ++i) {
    text += "v " + std::to_string(i) + " 0 0\n";
    face += ' ' + std::to_string(i) + "//" + std::to_string(i);
  }
  EXPECT_EQ(outcome(text + face, Format::obj), "ok 70000 1 70000");
}

TEST(IoObj, DoesNotDependOnTheLocale) {
  struct CommaPoint : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaPoint));
  // The C library's locale as well, where a German one is installed.
  const char* old_name = std::setlocale(LC_ALL, nullptr);
  const std::string old = old_name == nullptr ? "C" : old_name;
  static_cast<void>(std::setlocale(LC_ALL, "de_DE.UTF-8"));
  const auto result = read_exact("v 0.5 1234567 0\nf 1 1 x\n", Format::obj);
  const auto good = read_exact("v 0.5 1234567 0\n", Format::obj);
  std::setlocale(LC_ALL, old.c_str());
  std::locale::global(before);
  ASSERT_TRUE(good);
  EXPECT_EQ(good->soup.xyz[0], 0.5f);
  EXPECT_EQ(good->soup.xyz[1], 1234567.0f);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().line, 2);
}

TEST(IoOff, ReadsWhatTheFormatAllows) {
  const TextCase cases[] = {
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "ok 3 1 3"},
      {"OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", "ok 3 1 3"},
      {"3 1 99\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", "ok 3 1 3"},
      {"# c\r\nOFF # c\r\n\r\n3 1 0 # c\r\n0 0 0#c\r\n#c\r\n1 0 0\r\n0 1 0\r\n3 0 1 2 255 0 0 # "
       "r\r\n",
       "ok 3 1 3"},
      {"OFF\r3 1 0\r0 0 0\r1 0 0\r0 1 0\r3 0 1 2 0.5 0.5 0.5 1\r", "ok 3 1 3"},
      {"COFF\n1 0 0\n0 0 0 255 0 0 255\n", "ok 1 0 0"},
      {"NOFF\n1 0 0\n0 0 0 0 0 1\n", "ok 1 0 0"},
      {"STCNOFF\n1 0 0\n0 0 0 0 0 1 1 1 1 1 0.5 0.5\n", "ok 1 0 0"},
      {"OFF\n2 3 0\n0 0 0\n1 1 1\n0\n1 1\n2 0 1\n", "ok 2 3 3"},
      {"OFF\n0 0 0\n", "ok 0 0 0"},
  };
  for (const TextCase& c : cases) EXPECT_EQ(outcome(c.text, Format::off), c.outcome) << c.text;
}

TEST(IoOff, LocatesWhatIsWrong) {
  const TextCase cases[] = {
      {"", "empty-file@1:1"},
      {"OFF", "unexpected-end@1:4"},
      {"OFF\n3 1\n", "count-too-large@2:1"},
      {"OFF\n0 0\n", "missing-value@2:4"},
      {"OFF\n-3 1 0\n", "bad-count@2:1"},
      {"OFF\nx 1 0\n", "bad-count@2:1"},
      {"OFF\n4000000000 1 0\n0 0 0\n", "count-too-large@2:1"},
      {"OFF\n18446744073709551617 1 0\n0 0 0\n", "count-too-large@2:1"},
      {"OFF\n1 9999 0\n0 0 0\n", "count-too-large@2:3"},
      {"OFF\n2 0 0\n0 0 0\n1 0\n", "missing-value@4:4"},
      {"OFF\n2 0 0\n0 0 0\n\n    ", "unexpected-end@5:5"},
      {"OFF\n1 1 0\n0 0 nan\n3 0 0 0\n", "non-finite@3:5"},
      {"OFF\n1 1 0\n0 0 0\n3 0 0 1\n", "index-out-of-range@4:7"},
      {"OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", "index-out-of-range@4:7"},
      {"OFF\n1 1 0\n0 0 0\n3 0 0 9999999999999999999\n", "index-out-of-range@4:7"},
      {"OFF\n1 1 0\n0 0 0\n3 0 0\n", "missing-value@4:6"},
      {"OFF\n1 1 0\n0 0 0\n99999999999999999999 0 0\n", "missing-value@4:25"},
      {"OFF\n1 1 0\n0 0 0\n-1 0 0\n", "bad-face-degree@4:1"},
      {"OFF\n1 1 0\n0 0 0\nx 0 0\n", "bad-number@4:1"},
      {"4OFF\n1 0 0\n0 0 0 1\n", "unsupported-variant@1:1"},
      {"nOFF\n3\n1 0 0\n0 0 0\n", "unsupported-variant@1:1"},
      {"C4nOFF\n", "unsupported-variant@1:1"},
      {"ply\n", "bad-header@1:1"},
  };
  for (const TextCase& c : cases) EXPECT_EQ(outcome(c.text, Format::off), c.outcome) << c.text;
}

std::string binary_off(bool is_big, bool has_colours, std::int32_t index) {
  Bytes bytes(is_big);
  bytes.text("OFF BINARY\n").value(3).value(2).value(0);
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) bytes.value(x);
  for (int f = 0; f < 2; ++f) {
    bytes.value(3).value(0).value(1).value(index);
    if (has_colours) bytes.value(f);
    if (has_colours && f == 1) bytes.value(1.0f);
  }
  return bytes.str();
}

TEST(IoOff, ReadsBinaryOfEitherOrderWithAndWithoutColours) {
  for (const bool is_big : {false, true}) {
    for (const bool has_colours : {false, true}) {
      const std::string bytes = binary_off(is_big, has_colours, 2);
      EXPECT_EQ(outcome(bytes, Format::off), "ok 3 2 6");
      EXPECT_NE(outcome(bytes.substr(0, bytes.size() - 1), Format::off), "ok 3 2 6");
      EXPECT_EQ(outcome(binary_off(is_big, has_colours, 3), Format::off), "index-out-of-range@71");
    }
  }
}

}  // namespace
}  // namespace hedgerow::test
