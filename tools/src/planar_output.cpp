#include "planar_output.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "failure.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

Buffer<float> flat_positions(const std::string& input, std::span<const Point2> points) {
  Buffer<float> xyz(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double value = points[i][axis];
      if (std::abs(value) > double{std::numeric_limits<float>::max()}) {
        throw Failure{ExitStatus::input,
                      input,
                      "coordinate-out-of-range",
                      fmt::format("{} of vertex {} is {}, more than the floats of a mesh file hold",
                                  axis == 0 ? 'x' : 'y', i, value),
                      {"a picture (.svg) has room for it"}};
      }
      xyz[3 * i + axis] = static_cast<float>(value);
    }
    xyz[3 * i + 2] = 0;
  }
  return xyz;
}

}  // namespace

bool is_picture_path(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".svg";
}

void check_planar_output_path(const std::string& path) {
  if (!is_picture_path(path)) check_output_path(path);
}

void write_planar(Run& run, const std::string& input, const std::string& output,
                  const PlanarDrawing& drawing) {
  if (is_picture_path(output)) {
    write_text(output, planar_svg(drawing));
  } else {
    write_mesh(run, output, soup_of(drawing.mesh, flat_positions(input, drawing.vertices)));
  }
}

void enforce_distinct(const Run& run, const PointsFile& file, const Repeated& repeated) {
  if (!run.options().strict || repeated.count == 0) return;
  throw Failure{ExitStatus::defects,
                file.path,
                "defects",
                fmt::format("{} points repeat an earlier one; the first is point {}",
                            grouped(repeated.count), repeated.first),
                {}};
}

Index edge_count(const Connectivity& mesh) noexcept {
  const auto opposite = mesh.opposite();
  const auto boundary = std::count(opposite.begin(), opposite.end(), kInvalidIndex);
  return (mesh.halfedge_count() + static_cast<Index>(boundary)) / 2;
}

}  // namespace hedgerow::tool
