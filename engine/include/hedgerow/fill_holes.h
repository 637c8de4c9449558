#pragma once

#include "hedgerow/edit.h"
#include "hedgerow/index.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"

namespace hedgerow {

struct FillOptions {
  Index max_edges = 500;  ///< holes with more stay open: the work grows with the cube
};

/// What became of the holes. `found` is the sum of the next three.
struct FillReport {
  Index found = 0;
  Index filled = 0;
  Index too_long = 0;  ///< more than `max_edges`
  Index refused = 0;   ///< they touch themselves, or every filling would double an edge or a face
  Index triangles = 0;
};

/// Closes holes by triangles between the corners that they have.
///
/// Choice     The triangulation of least area: G. Barequet and M. Sharir, "Filling gaps in the
///            boundary of a polyhedron", 1995; so a flat hole is covered without folds, whatever
///            its outline. Diagonals that are edges of the mesh already are left out. Of several,
///            the one whose first corners come first, from the smallest half-edge of the hole on.
/// Edits      `EditMesh::add_face` and `connect`: ids of all that was there stay. A mesh that
///            records tells of the last edit only. A hole is filled wholly or not at all.
/// Pre        The mesh is sound.
/// Complexity O(n^3) time and O(n^2) memory for a hole of n edges, on the calling thread.
/// Errors     count_mismatch: too few positions; bad_stride; null_pointer: nothing has changed.
///            Throws std::bad_alloc.
/// Threads    As of the mesh: one writer.
[[nodiscard]] Result<FillReport> fill_holes(EditMesh& mesh, const Positions& positions,
                                            const FillOptions& options = {});

}  // namespace hedgerow
