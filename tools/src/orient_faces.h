#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh_file.h"

namespace hedgerow::tool {

/// What orienting a mesh changed and found; faces are numbered as in the input.
struct OrientedFaces {
  std::vector<Index> turned;  ///< ascending
  std::int64_t patch_count = 0;
  std::vector<std::vector<Index>> proofs;  ///< a cycle of faces for each patch without orientation
};

/// Turns faces over so that the faces of each manifold patch agree. Faces that `policies` drops are
/// left out, and stay as they are. Throws `Failure` naming `path`.
[[nodiscard]] OrientedFaces orient_faces(const Run& run, const std::string& path, Soup& soup,
                                         const Policies& policies);

[[nodiscard]] std::string text_of(const OrientedFaces& oriented);
[[nodiscard]] Json json_of(const OrientedFaces& oriented);

}  // namespace hedgerow::tool
