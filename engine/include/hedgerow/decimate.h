#pragma once

#include <cstdint>
#include <limits>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/edit.h"
#include "hedgerow/execution.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"

namespace hedgerow {

struct DecimateOptions {
  std::int64_t faces = 0;  ///< stop at so many faces, or fewer by one
  /// Collapse nothing that costs more: twice the area round a vertex times the square of a
  /// distance, in units of the positions.
  double max_cost = std::numeric_limits<double>::infinity();
  /// How much a boundary edge weighs beside the faces: it holds the outline in place. 0: nothing.
  double boundary_weight = 10;
};

/// Why decimation ended.
enum class DecimateEnd : std::uint8_t {
  faces,     ///< there are as few faces as were asked for
  max_cost,  ///< whatever is left costs more
  refused,   ///< whatever is left would fold a face over, or is no collapse of a mesh
};

struct DecimateOutput {
  Connectivity mesh;        ///< in the boundary form of the input
  Buffer<float> positions;  ///< x, y, z of each vertex
  CompactMaps maps;         ///< where each old vertex, half-edge and face is now
  DecimateEnd end = DecimateEnd::faces;
  std::int64_t collapses = 0;
  double largest_cost = 0;  ///< of the collapses that were done
};

/// Collapses edges, the cheapest first, until few faces are left.
///
/// Cost       M. Garland and P. Heckbert, "Surface simplification using quadric error metrics",
///            1997: the sum over the faces that a vertex has met of area times squared distance to
///            their planes, and likewise for planes that stand on boundary edges. To each vertex
///            a thousandth of its area times the squared distance to where it was is added: so the
///            best place is always unique, and on flat parts short edges go first.
/// Order      By cost to within a sixteenth, then as they came to cost that. As quadrics are only
///            ever added to, no cost falls: what has grown is found out when it comes up, and put
///            back.
/// Refused    What `EditMesh::can_collapse` refuses, and what would turn a corner over. Asked again
///            after a collapse beside it. Vertices with several fans stay, with all round them.
/// Pre        `mesh` is sound, as `validate` says. Faces of any degree; a collapse takes a corner
///            from each face of its edge, and a triangle away.
/// Not finite Positions that are not finite give costs that are not: such edges stay.
/// Complexity O(E) places in the queue and evaluations, if valences stay small. Scratch: 104 bytes
///            a vertex and 10 an edge, besides an `EditMesh`.
/// Errors     count_mismatch: too few positions; bad_stride; null_pointer; those of `EditMesh::of`
///            and `compact`. Throws std::bad_alloc.
/// Threads    Costs at the start on those of `execution`, the rest on the calling one; same bytes.
/// Lifetime   The result shares nothing with its input.
[[nodiscard]] Result<DecimateOutput> decimate(const Connectivity& mesh, const Positions& positions,
                                              const DecimateOptions& options,
                                              const Execution& execution);

}  // namespace hedgerow
