#pragma once

#include <cstdint>
#include <string>

#include "hedgerow/query.h"
#include "mesh_file.h"
#include "run.h"

namespace hedgerow::tool {

/// Everything that `inspect` says about a mesh.
struct Inspection {
  Summary summary;
  std::int64_t degenerate_faces = 0;
  std::int64_t zero_area_faces = 0;
  Buffer<Defect> defects;
  std::int64_t connectivity_bytes = 0;
  std::int64_t peak_bytes = 0;
  double read_ms = 0;
  double build_ms = 0;
  double validate_ms = 0;
  std::int64_t violation_count = 0;  ///< of I1 to I8; anything but 0 is a bug of the engine
  std::uint64_t digest = 0;
};

/// Takes the defects out of `built`.
[[nodiscard]] Inspection inspect_mesh(const Run& run, const MeshFile& file, BuiltMesh& built);
/// The object of CLI.md, with its field names.
[[nodiscard]] Json inspection_json(const Inspection& inspection);
[[nodiscard]] std::string inspection_text(const Inspection& inspection, bool colour);

}  // namespace hedgerow::tool
