#pragma once

#include "kernels/edit_columns.h"
#include "kernels/local_edits.h"

/// Many edits at once, without a record.
namespace hedgerow::kernels {

/// Collapses half-edges. Writes what `collapse_edge` does: half-edges of the faces at both ends,
/// holes beside the edge, `outgoing` of the ends and of the vertices across.
///
/// \pre each can be done, and no end of one shares a face or an edge with an end of another. Then
/// ranges that partition them write disjoint elements: each half-edge written has an end of the
/// collapse for origin or target, and `outgoing` of a vertex across is written only by the collapse
/// of the triangle whose half-edge stood there.
void scatter_collapses(IndexRange range, const Collapse* collapses,
                       const EditColumns& columns) noexcept;

/// Splits edges. Writes both half-edges, `prev` of what follows them, the triangles beside them,
/// and the new elements.
///
/// \pre each can be done, no triangle is of two, no edge is given twice, and their new numbers do
/// not meet. Then ranges that partition them write disjoint elements: in a face or hole that is not
/// cut, `next` of the half-edge and `prev` of the one after it.
void scatter_splits(IndexRange range, const Split* splits, const EditColumns& columns) noexcept;

}  // namespace hedgerow::kernels
