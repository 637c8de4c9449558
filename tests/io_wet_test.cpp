#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/io/winged_edge.h"
#include "support/io_cases.h"
#include "support/winged_cube.h"

namespace hedgerow::test {
namespace {

using io::Format;

std::string cube_text() {
  std::string text = "wet 1\nvertices 8\n";
  for (std::size_t v = 0; v < 8; ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      text += std::to_string(static_cast<int>(kWingedCubeXyz[3 * v + axis])) + ' ';
    }
    text += std::to_string(v + 1) + '\n';
  }
  text += "faces 6\n";
  for (const int edge : kWingedCubeFaces) text += std::to_string(edge) + '\n';
  text += "edges 12\n# start end prev_cw next_cw prev_ccw next_ccw face_cw face_ccw\n";
  for (const auto& row : kWingedCube) {
    for (int c = 0; c < 8; ++c) text += (c > 0 ? " " : "") + std::to_string(row[c]);
    text += '\n';
  }
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Wet, ReadsTheWorkedTableOfACubeAndWritesTheSameText) {
  const auto tables = io::read_winged_edges_bytes(cube_text(), "cube.wet");
  ASSERT_TRUE(tables) << to_string(tables.error());
  ASSERT_EQ(tables->edge_count(), 12);
  const WingedEdgeTables expected = winged_cube();
  for (std::size_t e = 0; e < 12; ++e) EXPECT_EQ(tables->edges[e], expected.edges[e]);
  const TemporaryFolder folder;
  ASSERT_TRUE(io::write_winged_edges(folder / "out.wet", *tables));
  EXPECT_EQ(file_contents(folder / "out.wet"), cube_text());
}

TEST(Wet, ComesBackTheSameThroughHalfedges) {
  const auto tables = io::read_winged_edges_bytes(cube_text(), "cube.wet");
  ASSERT_TRUE(tables);
  const auto halfedges = build_connectivity(*tables);
  ASSERT_TRUE(halfedges);
  const auto back = build_winged_edges(halfedges->mesh, halfedges->numbering,
                                       {tables->xyz.data(), tables->vertex_count()});
  ASSERT_TRUE(back);
  const TemporaryFolder folder;
  ASSERT_TRUE(io::write_winged_edges(folder / "out.wet", *back));
  EXPECT_EQ(file_contents(folder / "out.wet"), cube_text());
}

TEST(Wet, GivesTheFacesOfATableAndTheTableOfFaces) {
  EXPECT_EQ(outcome(cube_text(), Format::wet), "ok 8 6 24");
  const auto cube = read_exact(cube_text(), Format::wet);
  ASSERT_TRUE(cube);
  EXPECT_EQ(faces_of(cube->soup)[0], (std::vector<Index>{0, 1, 2, 3}));
  const TemporaryFolder folder;
  io::WriteInput input;
  input.positions = cube->soup.positions();
  input.faces = cube->soup.face_list();
  ASSERT_TRUE(io::write(folder / "out.WET", input));
  const auto again = io::read(folder / "out.WET");
  ASSERT_TRUE(again);
  EXPECT_EQ(faces_of(again->soup), faces_of(cube->soup));
}

TEST(Wet, SkipsCommentsAndEmptyLinesAndKeepsABoundaryAndAnIsolatedVertex) {
  const std::string text =
      "# one triangle\nwet 1 # version\n\nvertices 4\n0 0 0 1\n1 0 0 1 # x\n0 1 0 2\n5 5 5 0\n"
      "faces 1\n3\nedges 3\n1 2 3 2 0 0 1 0\n# between\n2 3 1 3 0 0 1 0\n3 1 2 1 0 0 1 0";
  EXPECT_EQ(outcome(text, Format::wet), "ok 4 1 3");
}

TEST(Wet, NamesRowColumnFoundAndConsistentValue) {
  const auto message = [](const std::string& from, const std::string& to) {
    const auto tables = io::read_winged_edges_bytes(replaced(cube_text(), from, to), "cube.wet");
    return tables ? std::string("ok") : to_string(tables.error());
  };
  EXPECT_EQ(message("2 3 1 3 11 10 1 6", "2 3 1 9 11 10 1 6"),
            "cube.wet:21:7: error: inconsistent-table: edges row 2, column next_cw: found 9, "
            "consistent would be 3");
  EXPECT_EQ(message("2 3 1 3 11 10 1 6", "2 3 1 3 11 10 1 99999999999"),
            "cube.wet:21:17: error: inconsistent-table: edges row 2, column face_ccw: found "
            "99999999999, consistent would be 6");
  EXPECT_EQ(message("2 3 1 3 11 10 1 6", "-4 3 1 3 11 10 1 6"),
            "cube.wet:21:1: error: inconsistent-table: edges row 2, column start: found -4, "
            "consistent would be 2");
  EXPECT_EQ(message("faces 6\n1\n", "faces 6\n7\n"),
            "cube.wet:12:1: error: inconsistent-table: faces row 1, column edge: found 7, "
            "consistent would be 1");
  EXPECT_EQ(message("0 0 1 1\n", "0 0 1 7\n"),
            "cube.wet:3:7: error: inconsistent-table: vertices row 1, column edge: found 7, "
            "consistent would be 1");
}

TEST(Wet, NamesThePlaceOfWhatIsMalformed) {
  const auto spoilt = [](const std::string& from, const std::string& to) {
    return outcome(replaced(cube_text(), from, to), Format::wet);
  };
  EXPECT_EQ(outcome("", Format::wet), "empty-file@1:1");
  EXPECT_EQ(spoilt("wet 1", "web 1"), "bad-header@1:1");
  EXPECT_EQ(spoilt("wet 1", "wet 2"), "unsupported-variant@1:5");
  EXPECT_EQ(spoilt("vertices 8", "vertices -8"), "bad-count@2:10");
  EXPECT_EQ(spoilt("vertices 8", "vertices 800000"), "count-too-large@2:10");
  EXPECT_EQ(spoilt("vertices 8", "vertices 7"), "unexpected-word@10:1");
  EXPECT_EQ(spoilt("0 0 1 1\n", "0 0 1\n"), "missing-value@3:6");
  EXPECT_EQ(spoilt("0 0 1 1\n", "0 0 1 1 1\n"), "unexpected-word@3:9");
  EXPECT_EQ(spoilt("0 0 1 1\n", "0 zero 1 1\n"), "bad-number@3:3");
  EXPECT_EQ(spoilt("0 0 1 1\n", "0 nan 1 1\n"), "non-finite@3:3");
  EXPECT_EQ(spoilt("2 3 1 3 11", "2 3 1 x 11"), "bad-number@21:7");
  EXPECT_EQ(outcome(cube_text() + "1\n", Format::wet), "unexpected-word@32:1");
  EXPECT_EQ(outcome("wet 1\nvertices 0\nfaces 0\n", Format::wet), "unexpected-end@4:1");
  EXPECT_EQ(outcome("wet 1\nvertices 0\nfaces 0\nedges 0\n", Format::wet), "ok 0 0 0");
}

TEST(Wet, RefusesToWriteABowtie) {
  const std::string text = "OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n-1 0 0\n3 0 1 2\n3 0 3 4\n";
  const auto mesh = read_exact(text, Format::off);
  ASSERT_TRUE(mesh);
  io::WriteInput input;
  input.positions = mesh->soup.positions();
  input.faces = mesh->soup.face_list();
  const TemporaryFolder folder;
  const auto written = io::write(folder / "out.wet", input);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, io::IoErrorCode::bad_mesh);
  EXPECT_NE(written.error().message.find("vertex 0"), std::string::npos);
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace hedgerow::test
