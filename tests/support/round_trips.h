#pragma once

#include <string>

#include "hedgerow/connectivity.h"

namespace hedgerow::test {

/// Takes the mesh, in both boundary forms, to every representation that has a place for it and
/// back, and compares every byte. Empty if all came back; else which did not and how. Polygons have
/// no place in the representations of triangles, nor a vertex with several fans in winged-edge
/// tables; that these refuse them is compared, too.
///
/// \pre `mesh` is in the default form and sound
[[nodiscard]] std::string find_lossy_round_trip(const Connectivity& mesh);

}  // namespace hedgerow::test
