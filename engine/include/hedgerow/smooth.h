#pragma once

#include <cstdint>

#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"
#include "hedgerow/workspace.h"

namespace hedgerow {

enum class SmoothWeights : std::uint8_t {
  umbrella,   ///< every neighbour the same
  cotangent,  ///< by the angles across the edge: does not slide vertices along the surface
};

enum class SmoothUpdate : std::uint8_t {
  double_buffered,  ///< all vertices from the positions before: parallel
  in_place,         ///< each from the newest, in ascending order, on one thread
};

struct SmoothOptions {
  int iterations = 1;
  float step = 1;  ///< how far to go to the mean of the neighbours, above 0 and at most 1
  SmoothWeights weights = SmoothWeights::umbrella;
  SmoothUpdate update = SmoothUpdate::double_buffered;
};

/// Where positions are read and written: x, y, z each `stride_bytes` apart, as in `Positions`.
using MutablePositions = NormalsOut;

/// Moves each vertex towards the mean of its neighbours, `iterations` times.
///
/// Stays      A vertex on the boundary, with several fans, or without a neighbour; and one whose
///            mean is not finite.
/// Weights    umbrella: G. Taubin, "A signal processing approach to fair surface design", 1995.
///            cotangent: M. Meyer et al., "Discrete differential-geometry operators for
///            triangulated 2-manifolds", 2002; of a negative weight nothing is left, so that a
///            vertex never leaves the hull of its neighbours. Angles at the positions before each
///            move.
/// Sums       cotangent: in double, clockwise from `outgoing`. umbrella: in float, in that order
///            but for vertex v - 1, which changes places with the last; in double where that leads
///            to nothing finite.
/// Pre        `mesh` is sound, as `validate` says; 0 < step <= 1.
/// Complexity O(iterations H). Double-buffered: reads the mesh and one copy of the positions and
///            writes the other, 12 bytes a vertex; the copy is the scratch. In place: no scratch.
/// Errors     count_mismatch: too few positions; bad_stride; null_pointer; not_triangles: with
///            cotangent weights, the first face that is none; scratch_too_small. Then nothing has
///            moved. Throws std::bad_alloc where `workspace` may grow.
/// Threads    Double-buffered: those of `execution`, same bits for all of them, scalar or SIMD.
[[nodiscard]] Result<void> smooth(const Connectivity& mesh, MutablePositions positions,
                                  const SmoothOptions& options, const Execution& execution,
                                  Workspace& workspace);

}  // namespace hedgerow
