#pragma once

#include <string>

#include "hedgerow/connectivity.h"
#include "run.h"

namespace hedgerow::tool {

/// {"vertices", "faces", "halfedges"} of a mesh.
[[nodiscard]] Json counts_json(const Connectivity& mesh);
/// The counts of two meshes side by side, as an aligned table.
[[nodiscard]] std::string before_after_text(const Connectivity& before, const Connectivity& after,
                                            bool colour);

}  // namespace hedgerow::tool
