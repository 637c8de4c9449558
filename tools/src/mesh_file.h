#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hedgerow/build.h"
#include "hedgerow/point2.h"
#include "hedgerow/soup.h"
#include "hedgerow/winged_edge.h"
#include "run.h"

namespace hedgerow::tool {

/// A mesh as it was read, and how long that took.
struct MeshFile {
  std::string path;
  Soup soup;
  double read_ms = 0;
};

/// Reads any format that the program knows, with the policies of the run. What is odd but not wrong
/// goes to standard error. Throws `Failure` with the place of the error.
[[nodiscard]] MeshFile read_mesh(Run& run, const std::string& path);

/// Points in the plane as they were read, and how long that took.
struct PointsFile {
  std::string path;
  std::vector<Point2> points;
  double read_ms = 0;
};

/// Reads .xy or .csv, as `read_mesh` does meshes.
[[nodiscard]] PointsFile read_points(Run& run, const std::string& path);

/// Throws `Failure` (usage) unless `path` has the extension of a format that can be written.
void check_output_path(const std::string& path);
/// The same for commands that write one format only, e.g. ".ply".
void check_output_path(const std::string& path, const std::string& extension);

/// Writes the whole file or leaves what was there; says on standard error what the format cannot
/// hold. `normals` has three floats a vertex or is empty. Returns the bytes written.
/// Throws `Failure`.
std::int64_t write_mesh(Run& run, const std::string& path, const Soup& soup,
                        const Buffer<float>& normals = {});
/// From winged-edge tables to winged-edge tables: every number stays as it is. Throws `Failure`.
[[nodiscard]] WingedEdgeTables read_tables(Run& run, const std::string& path);
std::int64_t write_tables(const std::string& path, const WingedEdgeTables& tables);
/// A text file, whole or not at all. Throws `Failure`.
void write_text(const std::string& path, const std::string& text);

/// Connectivity of a mesh, and how long it took to build.
struct BuiltMesh {
  BuildOutput output;
  double build_ms = 0;

  [[nodiscard]] const Connectivity& mesh() const noexcept { return output.mesh; }
};

/// Builds with `policies`; the columns may view the soup, which must outlive the result.
/// Throws `Failure` naming `path`.
[[nodiscard]] BuiltMesh build_mesh(const Run& run, const std::string& path, const Soup& soup,
                                   const Policies& policies);
[[nodiscard]] BuiltMesh build_mesh(const Run& run, const MeshFile& file);

/// Throws `Failure` (defects) if --strict was given and there are any.
void enforce_strict(const Run& run, const std::string& path, const BuildOutput& output);

/// Positions of the vertices that the connectivity has; empty if they are those of the input.
/// A split vertex repeats its position.
[[nodiscard]] Buffer<float> kept_positions(const BuildOutput& output,
                                           const Buffer<float>& positions);

/// The kept faces and their vertices as a soup of its own: what the connectivity stands for.
/// `positions` are those of the input.
[[nodiscard]] Soup kept_soup(const BuildOutput& output, const Buffer<float>& positions);

/// The faces of a mesh in canonical form as a soup of its own, over the positions of its vertices.
[[nodiscard]] Soup soup_of(const Connectivity& mesh, Buffer<float> xyz);

/// What a command that works on one mesh starts from.
struct OpenedMesh {
  MeshFile file;
  BuiltMesh built;  ///< may view the soup of `file`
  Soup kept;        ///< what the connectivity stands for

  [[nodiscard]] const Connectivity& mesh() const noexcept { return built.mesh(); }
};

/// Reads and builds with the policies of the run: two steps of the progress, "reading" and
/// "building". Throws `Failure`; under --strict also if there are defects.
[[nodiscard]] OpenedMesh open_mesh(Run& run, const std::string& path);

/// "face 7, half-edge 21": the element ids of a defect.
[[nodiscard]] std::string defect_text(const Defect& defect);
[[nodiscard]] Json defect_json(const Defect& defect);

}  // namespace hedgerow::tool
