#include <algorithm>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "hedgerow/io/read.h"
#include "support/io_cases.h"
#include "support/shared_folder.h"

namespace hedgerow::test {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

std::vector<Row> rows_of(const std::filesystem::path& path) {
  std::istringstream lines(file_contents(path));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = split_line(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = split_line(line);
    Row row;
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) row[names[i]] = cells[i];
    rows.push_back(row);
  }
  return rows;
}

long number(const std::string& cell) { return cell.empty() ? 0 : std::stol(cell); }

// Faces that the builder will drop are in the file all the same.
bool is_degenerate(std::vector<Index> face) {
  std::ranges::sort(face);
  return face.size() < 3 || std::ranges::adjacent_find(face) != face.end();
}

TEST(IoShared, ReadsEveryMeshWithTheCountsOfTheManifest) {
  const auto shared = shared_folder();
  if (!shared) GTEST_SKIP() << kNoSharedFolder;
  for (const Row& row : rows_of(*shared / "meshes" / "MANIFEST.csv")) {
    SCOPED_TRACE(row.at("file"));
    const auto output = io::read(*shared / "meshes" / row.at("file"));
    ASSERT_TRUE(output.has_value()) << io::to_string(output.error());
    std::map<std::string, long> found;
    for (const auto& face : faces_of(output->soup)) {
      // Of glTF the manifest counts all faces, degenerate or not.
      if (!row.at("degenerate_faces").empty() && is_degenerate(face)) {
        ++found["degenerate_faces"];
      } else {
        ++found["faces"];
        ++found[face.size() == 3 ? "triangles" : face.size() == 4 ? "quads" : "polygons"];
      }
    }
    EXPECT_EQ(output->soup.vertex_count(), number(row.at("vertices")));
    for (const char* field : {"faces", "triangles", "quads", "polygons", "degenerate_faces"}) {
      if (!row.at(field).empty()) {
        EXPECT_EQ(found[field], number(row.at(field))) << field;
      }
    }
  }
}

TEST(IoShared, TreatsEveryBadFileAsTheManifestSays) {
  const auto shared = shared_folder();
  if (!shared) GTEST_SKIP() << kNoSharedFolder;
  for (const Row& row : rows_of(*shared / "bad" / "MANIFEST.csv")) {
    SCOPED_TRACE(row.at("file"));
    const auto path = *shared / "bad" / row.at("file");
    if (!io::format_of(path)) continue;  // the buffer of a glTF file
    const auto output = io::read(path);
    if (!output) {
      EXPECT_NE(row.at("expect"), "accept") << io::to_string(output.error());
      const io::IoError& error = output.error();
      const bool has_place = error.byte >= 0 || (error.line > 0 && error.column > 0);
      EXPECT_TRUE(has_place);
      EXPECT_FALSE(error.message.empty());
    } else {
      EXPECT_NE(row.at("expect"), "reject");
    }
    io::ReadOptions lenient;
    lenient.keep_out_of_range = true;
    lenient.keep_non_finite = true;
    const auto kept = io::read(path, lenient);
    EXPECT_TRUE(kept || !output) << "kept more, but accepted less";
    if (row.at("expect") == "accept") {
      EXPECT_EQ(output->soup.vertex_count(), number(row.at("vertices")));
      EXPECT_EQ(output->soup.face_count(), number(row.at("faces")));
    }
  }
}

}  // namespace
}  // namespace hedgerow::test
