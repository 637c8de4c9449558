#pragma once

#include <utility>

#include "hedgerow/edit.h"
#include "support/meshes.h"

namespace hedgerow::test {

/// An editable mesh of faces that are all good.
[[nodiscard]] inline EditMesh edit_mesh(const PlainFaces& list) {
  return std::move(*EditMesh::of(to_connectivity(reference_of(list)), Execution::serial()));
}

}  // namespace hedgerow::test
