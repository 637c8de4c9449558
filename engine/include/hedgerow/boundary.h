#pragma once

#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/result.h"

namespace hedgerow {

/// The same mesh in the closed form: a half-edge with face -1 along each boundary edge, `next`
/// running round each hole, `outgoing` of a boundary vertex being a boundary half-edge. The form of
/// the doubly connected edge list (de Berg et al., Computational Geometry, chapter 2).
///
/// Pre        `mesh` is sound, as `validate` says.
/// Numbering  Half-edges of faces keep their numbers. Boundary half-edges follow loop by loop, the
///            loops in the order of the smallest half-edge opposite to them, so that `next` is +1
///            but at the end of a loop.
/// Fans       At a vertex with several open fans, `next` leads from each fan to itself: the
///            boundary half-edge that enters fan i is followed by the one that leaves fan i. So
///            each fan stays one rotation, and the `fans` table still lists the others. `outgoing`
///            and each entry of `fans` name the boundary half-edge of their own fan, if it is open.
/// Complexity O(H). Allocates every column anew: 4 (H + B) indices and V + F more, with B boundary
///            half-edges. The mesh passed in is not changed.
/// Errors     already_closed, too_many_elements. Throws std::bad_alloc.
/// Threads    Those of `execution`; same bytes for all of them.
/// Lifetime   The result shares nothing with `mesh`.
[[nodiscard]] Result<Connectivity> close_boundary(const Connectivity& mesh,
                                                  const Execution& execution);

/// The default form again: drops the half-edges with face -1. Inverse of `close_boundary`, to the
/// last byte (a triangle mesh comes back implicit). A rotation with several boundary half-edges is
/// cut into as many fans.
///
/// Pre        `mesh` is sound, as `validate` says.
/// Complexity O(H); allocates every column anew.
/// Errors     already_open; not_canonical, for dangling edges too, which have no place in the
///            default form: element = the smallest half-edge that cannot stay or go. Throws
///            std::bad_alloc.
/// Threads, lifetime   As `close_boundary`.
[[nodiscard]] Result<Connectivity> open_boundary(const Connectivity& mesh,
                                                 const Execution& execution);

}  // namespace hedgerow
