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

enum class DecimateOrder : std::uint8_t {
  queue,   ///< one after the other, on the calling thread
  rounds,  ///< in parts of the mesh at once, up to a cost that rises from round to round
};

struct DecimateOptions {
  std::int64_t faces = 0;  ///< stop at so many faces, or fewer by one
  /// Collapse nothing that costs more: twice the area round a vertex times the square of a
  /// distance, in units of the positions.
  double max_cost = std::numeric_limits<double>::infinity();
  /// How much a boundary edge weighs beside the faces: it holds the outline in place. 0: nothing.
  double boundary_weight = 10;
  DecimateOrder order = DecimateOrder::queue;
  /// Of `rounds`: how many vertices one part has. The result depends on it.
  Index part_vertices = Index{1} << 13;
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
  double largest_cost = 0;      ///< of the collapses that were done
  double total_cost = 0;        ///< of the vertices that are left, for being where they are
  std::int64_t rounds = 0;      ///< 0 for a queue
  std::int64_t candidates = 0;  ///< edges that came up in a round and cost little enough
  std::int64_t accepted = 0;    ///< of those, collapsed; a queue did the other collapses
  std::int64_t postponed = 0;   ///< of those, whose ring reaches out of their part
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
/// Rounds     Each collapses what costs less than the queue would have to go up to, part by part:
///            each part has a queue of its own. The last collapses, about one of thirty, and those
///            about which a round cannot know whether they go too far, are left to one queue. So
///            it ends at the same number of faces, and for the same reasons.
/// Refused    What `EditMesh::can_collapse` refuses, and what would turn a corner over. Asked again
///            after a collapse beside it. Vertices with several fans stay, with all round them.
/// Pre        `mesh` is sound, as `validate` says. Faces of any degree; a collapse takes a corner
///            from each face of its edge, and a triangle away.
/// Not finite Positions that are not finite give costs that are not: such edges stay.
/// Complexity O(E) places in the queue and evaluations, if valences stay small. Scratch: 104 bytes
///            a vertex and 12 an edge, besides an `EditMesh`; for rounds 48 and 36 more.
/// Errors     count_mismatch: too few positions; bad_stride; null_pointer; those of `EditMesh::of`
///            and `compact`. Throws std::bad_alloc.
/// Threads    Costs at the start, and rounds, on those of `execution`, the rest on the calling one;
///            same bytes.
/// Lifetime   The result shares nothing with its input.
[[nodiscard]] Result<DecimateOutput> decimate(const Connectivity& mesh, const Positions& positions,
                                              const DecimateOptions& options,
                                              const Execution& execution);

}  // namespace hedgerow
