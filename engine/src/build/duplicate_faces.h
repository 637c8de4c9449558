#pragma once

#include <vector>

#include "hedgerow/defect.h"
#include "hedgerow/execution.h"
#include "kernels/face_columns.h"

namespace hedgerow::detail {

/// All faces with the same set of vertices as an earlier one, ascending by face; `value` is the
/// first face with that set. Polygons can have the same vertices without sharing an edge, so this
/// does not follow from pairing as it does for triangles: faces are grouped by their smallest
/// vertex and compared by an order-free signature first. Complexity O(V + H), and O(n log n) in the
/// n faces that have the same smallest vertex.
[[nodiscard]] std::vector<Defect> find_duplicate_faces(const kernels::FaceColumns& faces,
                                                       const Execution& execution);

}  // namespace hedgerow::detail
