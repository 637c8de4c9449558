#pragma once

#include <cstdint>
#include <vector>

#include "hedgerow/edit.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"

namespace hedgerow {

/// When the edge between two triangles is to be flipped.
enum class DelaunayTest : std::uint8_t {
  /// On a surface: the two angles across it are more than 180 degrees together, by 1e-12 radians
  /// or more, so that rounding does not turn an edge to and fro.
  angle_sum,
  /// In the plane, by x and y alone and exactly: one triangle's circle has the other's far corner
  /// inside, or one is flat, and the flip leaves two triangles that turn the same way.
  in_circle,
};

enum class DelaunayOrder : std::uint8_t {
  rounds,  ///< all edges that fail at once, those that do not meet; in parallel
  queue,   ///< one after the other, first come, first served; on the calling thread
};

struct DelaunayOptions {
  DelaunayTest test = DelaunayTest::angle_sum;
  DelaunayOrder order = DelaunayOrder::rounds;
  /// At most so many flips; negative: 100 for each edge and 1000 more, which no mesh has been seen
  /// to need. A guard: in the plane it ends by itself, on a surface where rounding does not matter.
  std::int64_t max_flips = -1;
  /// Where to append the record of each flip or each round: undo them from the last to the first.
  std::vector<Change>* record = nullptr;
};

struct DelaunayReport {
  std::int64_t rounds = 0;  ///< 0 for a queue
  std::int64_t flips = 0;
  std::int64_t candidates = 0;  ///< edges that failed, counted anew in each round or look
  std::int64_t postponed = 0;   ///< of those, left to the next round
  std::int64_t left = 0;        ///< edges that fail and cannot be flipped, or not any more
  std::int64_t undefined = 0;   ///< edges not to be judged: a coordinate is not finite
  bool is_cut_short = false;    ///< by `max_flips`
};

/// Flips edges of a mesh until each edge between two triangles passes the test, or cannot be
/// flipped: there is such an edge already, or a vertex has several fans. Other faces stay.
///
/// After C. Lawson, "Software for C1 surface interpolation", 1977; in rounds as C. Navarro,
/// N. Hitschfeld and E. Scheihing, "A parallel GPU-based algorithm for Delaunay edge-flips", 2011.
///
/// Complexity O(E) and O(valence) for each flip. The number of flips is O(n^2) at the worst in the
/// plane, and about one a vertex where the mesh is near.
/// Errors     As of any positions: count_mismatch, bad_stride, null_pointer. Nothing has changed.
///            Throws std::bad_alloc between flips: the mesh is sound.
/// Threads    Those of `execution`; same bytes for all of them, in either order.
[[nodiscard]] Result<DelaunayReport> flip_to_delaunay(EditMesh& mesh, const Positions& positions,
                                                      const DelaunayOptions& options,
                                                      const Execution& execution);

}  // namespace hedgerow
