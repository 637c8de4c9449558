#pragma once

#include <cstdint>
#include <vector>

#include "build/input_faces.h"
#include "build/pair.h"
#include "hedgerow/defect.h"

/// The policies that change the face list after it has been classified.
namespace hedgerow::detail {

/// keep[f] == 0 for the faces that the `skip` policies drop; empty if there is none.
///
/// Edges first: on a non-manifold edge the smallest half-edge and the smallest one against it stay,
/// on an inconsistent edge the smallest; the faces of the others go. Only where no edge asks for
/// it, vertices: the faces joined across shared edges with the smallest half-edge stay. Complexity
/// O(H log defects).
[[nodiscard]] std::vector<std::uint8_t> faces_to_drop(const kernels::FaceColumns& faces,
                                                      const PairOutput& paired,
                                                      const Policies& policies);

/// Gives each extra fan of the vertices that the `split` policies name a vertex of its own. True if
/// there was any. A fan whose two ends lay on one edge may close when it is paired again.
[[nodiscard]] bool split_fans(InputFaces& faces, const PairOutput& paired,
                              const Policies& policies);

}  // namespace hedgerow::detail
