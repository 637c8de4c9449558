#pragma once

#include <string>

#include "hedgerow/connectivity.h"
#include "mesh_file.h"
#include "planar_picture.h"
#include "run.h"

namespace hedgerow::tool {

/// True for .svg, upper or lower case.
[[nodiscard]] bool is_picture_path(const std::string& path);
/// Throws `Failure` (usage) unless `path` has the extension of a mesh that can be written, or .svg.
void check_planar_output_path(const std::string& path);

/// Writes a picture, or a mesh with z = 0. Throws `Failure`; naming `input` where a coordinate is
/// too large for the floats of a mesh file.
void write_planar(Run& run, const std::string& input, const std::string& output,
                  const PlanarDrawing& drawing);

/// Points that repeat an earlier one: how many, and the first.
struct Repeated {
  Index count = 0;
  Index first = kInvalidIndex;
};
/// Throws `Failure` (defects) if --strict was given and there are any.
void enforce_distinct(const Run& run, const PointsFile& file, const Repeated& repeated);

/// Undirected edges of a mesh in the default form. O(H).
[[nodiscard]] Index edge_count(const Connectivity& mesh) noexcept;

}  // namespace hedgerow::tool
