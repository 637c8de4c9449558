#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/defect.h"
#include "hedgerow/execution.h"
#include "hedgerow/face_list.h"
#include "hedgerow/result.h"
#include "kernels/face_columns.h"

namespace hedgerow::detail {

/// The faces of one build on their way from the caller's list to columns, and where they came from.
struct InputFaces {
  ColumnStorage corners;
  ColumnStorage first;  ///< empty: all triangles
  Index vertex_count = 0;
  Buffer<Index> faces_new_to_old;     ///< empty: none was dropped
  Buffer<Index> vertices_new_to_old;  ///< empty: none was added or dropped

  [[nodiscard]] kernels::FaceColumns columns() const noexcept;
  [[nodiscard]] Index input_face(Index f) const noexcept {
    return faces_new_to_old.empty() ? f : faces_new_to_old[static_cast<std::size_t>(f)];
  }
};

/// Views or copies the list into native columns; a polygon list of nothing but triangles becomes a
/// triangle list. \pre check(faces) has passed.
[[nodiscard]] InputFaces take_faces(const FaceList& faces, bool borrow, const Execution& execution);

/// Removes the faces with keep[f] == 0 and notes where the others came from.
void drop_faces(InputFaces& faces, std::span<const std::uint8_t> keep);

/// Gives the corners listed in `halfedges` new vertices, one each, in that order.
void split_corners(InputFaces& faces, std::span<const Index> halfedges);

/// Replaces the corners, and appends vertices that were split from `new_vertices[i]` (old numbers).
void replace_corners(InputFaces& faces, Buffer<Index>&& corners,
                     std::span<const Index> new_vertices);

/// Renumbers without the vertices that no face uses.
void drop_isolated_vertices(InputFaces& faces);

/// Finds the defects that a face has on its own (out of range, too few corners, repeated vertex;
/// the first that applies), appends them to `defects` in face order, and applies the policies.
/// Errors: the first with policy `fail`, by kind and then by face; `faces` is then unchanged.
[[nodiscard]] Result<void> repair_single_faces(InputFaces& faces, const FaceList& list,
                                               const Policies& policies,
                                               std::vector<Defect>& defects);

/// The error that says what `defect` says.
[[nodiscard]] Error error_of(const Defect& defect, std::int64_t limit, std::int64_t count) noexcept;

}  // namespace hedgerow::detail
