#pragma once

#include <cstdint>

#include "decimate/shrinking_mesh.h"
#include "hedgerow/buffer.h"
#include "hedgerow/decimate.h"
#include "hedgerow/execution.h"
#include "hedgerow/positions.h"

namespace hedgerow::decimation {

/// Collapses edges in parallel rounds, and leaves the last few to a queue.
///
/// A round takes the cheapest edges, so many that each of them could be collapsed without going
/// below the faces that are asked for. As no cost falls and each collapse takes an edge away, a
/// queue of all edges would have to go up to that cost, too. Then vertices are cut into parts by
/// their places, and each part empties a queue of its own up to that cost; edges whose ring reaches
/// out of the part wait for the next round, which cuts in other places. What is done depends on
/// the parts and not on who works on them.
///
/// \pre `costs` has a number for each half-edge: of one of each edge that cost or less, of others
/// not a finite one. Kept like that. Adds to the counts of `output`; returns the faces that are
/// left. Throws std::bad_alloc, between rounds.
std::int64_t collapse_in_rounds(ShrinkingMesh& mesh, Buffer<float>& costs,
                                const Positions& positions, const DecimateOptions& options,
                                const Execution& execution, DecimateOutput& output);

}  // namespace hedgerow::decimation
