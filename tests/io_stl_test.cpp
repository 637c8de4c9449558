#include <cmath>

#include <gtest/gtest.h>

#include "hedgerow/io/read.h"
#include "support/io_cases.h"
#include "weld.h"

namespace hedgerow::test {
namespace {

using io::Format;

std::string binary_stl(std::string_view head, std::uint32_t declared, int stored, float last = 0) {
  Bytes bytes;
  std::string name(head);
  name.resize(80, '\0');
  bytes.text(name).value(declared);
  for (int f = 0; f < stored; ++f) {
    for (int i = 0; i < 3; ++i) bytes.value(NAN);  // normals are nobody's business
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, last}) bytes.value(x);
    bytes.value(std::uint16_t{7});
  }
  return bytes.str();
}

const std::string kFacet =
    "facet normal nan 0 0\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 -0\n endloop\n"
    "endfacet\n";

TEST(IoStl, TellsBinaryFromAsciiBySize) {
  EXPECT_EQ(outcome(binary_stl("solid x", 2, 2), Format::stl), "ok 3 2 6");
  EXPECT_EQ(outcome(binary_stl("", 0, 0), Format::stl), "ok 0 0 0");
  EXPECT_EQ(outcome(binary_stl("solid x", 2, 2) + '\n', Format::stl), "ok 3 2 6");
  EXPECT_EQ(outcome(binary_stl("", 2, 3), Format::stl), "size-mismatch@80");
  EXPECT_EQ(outcome(binary_stl("", 3, 2), Format::stl), "size-mismatch@80");
  EXPECT_EQ(outcome(binary_stl("", 0xffffffff, 2), Format::stl), "size-mismatch@80");
  EXPECT_EQ(outcome(binary_stl("", 1, 1, INFINITY), Format::stl), "non-finite@128");
  EXPECT_EQ(outcome("short", Format::stl), "unexpected-end@5");
  EXPECT_EQ(outcome("", Format::stl), "empty-file@0");
}

TEST(IoStl, ReadsAscii) {
  const std::pair<std::string, std::string> cases[] = {
      {"solid a name\n" + kFacet + "endsolid a name\n", "ok 3 1 3"},
      {"solid\n" + kFacet + kFacet + "endsolid\nsolid b\n" + kFacet + "endsolid", "ok 3 3 9"},
      {"  SOLID\nFACET NORMAL 0 0 0 OUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 1 1 0\n",
       "unexpected-word@3:1"},
      {"solid\nFacet Normal 0 0 0\nOuter Loop\nVertex 0 0 0\nVertex 1 0 0\nVertex 1 1 0\nEndLoop\n"
       "EndFacet\nEndSolid\n",
       "ok 3 1 3"},
      {"solid\n", "ok 0 0 0"},
      {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", "missing-value@4:11"},
      {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n", "bad-number@4:12"},
      {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n", "non-finite@4:12"},
      {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0 0\n", "unexpected-word@4:14"},
      {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\n", "bad-face-degree@3:11"},
      {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\n"
       "vertex 0 0 0\n",
       "bad-face-degree@7:1"},
      {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "unexpected-end@5:1"},
      {"solid\nfaces\n", "unexpected-word@2:1"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_EQ(outcome(text, Format::stl), expected) << text;
}

TEST(IoStl, NumbersWeldedVerticesByFirstOccurrence) {
  const auto result = read_exact(
      "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nfacet normal 0 0 0\nouter loop\nvertex 1 0 -0\nvertex 5 5 5\nvertex -0 1 0\n"
      "endloop\nendfacet\nendsolid\n",
      Format::stl);
  ASSERT_TRUE(result);
  EXPECT_EQ(faces_of(result->soup), (std::vector<std::vector<Index>>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(result->soup.xyz[9], 5.0f);
}

TEST(IoWeld, KeepsApartWhatDiffersWhileTheTableGrows) {
  io::Welder welder(0);
  constexpr int kSide = 40;
  for (int round = 0; round < 2; ++round) {
    Index expected = 0;
    for (int x = 0; x < kSide; ++x) {
      for (int y = 0; y < kSide; ++y) {
        for (int z = 0; z < kSide; ++z) {
          const float xyz[3] = {static_cast<float>(x), static_cast<float>(-y),
                                static_cast<float>(z) * 0.25f};
          ASSERT_EQ(welder.add(xyz), expected++);
        }
      }
    }
  }
  EXPECT_EQ(welder.size(), static_cast<std::size_t>(kSide * kSide * kSide));
}

}  // namespace
}  // namespace hedgerow::test
