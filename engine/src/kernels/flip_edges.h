#pragma once

#include "kernels/edit_columns.h"

/// Flips of many edges at once.
namespace hedgerow::kernels {

/// An edge to flip, and what depends on columns that other flips write.
struct Flip {
  Index halfedge;
  bool starts_origin;  ///< it is the `outgoing` of its origin,
  bool starts_target;  ///< and its opposite that of its target
};

/// Turns each edge by one corner in its two faces. Writes the half-edges of both, the faces, and
/// where they start there the ends of the edge.
///
/// \pre no two flips have a face in common; each can be done. Then ranges that partition the flips
/// write disjoint elements: half-edges and faces are those of its two faces, and `outgoing` of a
/// vertex is written only by the flip of the half-edge that stands there.
void scatter_flips(IndexRange range, const Flip* flips, const EditColumns& columns) noexcept;

}  // namespace hedgerow::kernels
