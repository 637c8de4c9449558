#pragma once

#include "hedgerow/buffer.h"
#include "hedgerow/index.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"
#include "hedgerow/soup.h"

namespace hedgerow {

/// Which vertices become one.
struct Weld {
  Buffer<Index> new_to_old;  ///< the smallest vertex of each group: its position is kept; ascending
  Buffer<Index> old_to_new;

  [[nodiscard]] Index vertex_count() const noexcept {
    return static_cast<Index>(new_to_old.size());
  }
  [[nodiscard]] Index merged_count() const noexcept {
    return static_cast<Index>(old_to_new.size() - new_to_old.size());
  }
};

/// Groups of vertices that lie within `distance` of one another, directly or by way of others. This
/// is the one rule that depends neither on the order of the vertices nor on that of the work; a row
/// of vertices with less than `distance` between neighbours becomes one, however long it is.
///
/// Distances are compared in double; vertices at the same position (-0 is 0) are one at any
/// distance, 0 included. A position that is not a number is like no other; infinite coordinates are
/// like themselves only.
///
/// Pre        distance >= 0, in the unit of the positions.
/// Complexity O(n log n), whatever the distance and however many vertices lie at one place: cells
///            of half the distance are joined as they are, and pairs of cells are halved until
///            their boxes tell. On the calling thread. Throws std::bad_alloc.
/// Errors     null_pointer, bad_stride, too_many_elements.
[[nodiscard]] Result<Weld> find_weld(Positions positions, double distance);

/// The faces on the welded vertices. Faces stay, with the corners they had: one that now meets a
/// vertex twice, or has the vertices of another, is for the builder to report.
///
/// Complexity O(V + corners). Throws std::bad_alloc. \pre `weld` is of the positions of `soup`.
[[nodiscard]] Soup welded(const Soup& soup, const Weld& weld);

}  // namespace hedgerow
