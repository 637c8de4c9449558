#pragma once

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/radial.h"

/// Consistent orientation of the faces of each manifold patch.
namespace hedgerow {

/// Which faces to turn over.
struct Orientation {
  Buffer<Index> flipped;  ///< faces, ascending; none of a patch that cannot be oriented
  Index patch_count = 0;
  Index nonorientable_count = 0;  ///< patches that cannot be oriented: Moebius bands, Klein bottles
  /// Proofs, one for each such patch, in the order of their smallest faces: proof i is
  /// proof_faces[proof_first[i]] .. proof_faces[proof_first[i + 1] - 1].
  Buffer<Index> proof_first;
  /// A cycle of faces, each joined to the next (and the last to the first) across an edge with two
  /// faces; an odd number of these edges is run through in the same direction from both sides.
  Buffer<Index> proof_faces;
};

/// Finds for each patch (`manifold_patches`) the faces to turn over so that the two half-edges of
/// every edge with two faces run in different directions. The smallest face of a patch stays.
///
/// \pre       `cycles` are those of `mesh`.
/// Complexity O(H) on the calling thread: one breadth-first walk. Scratch 16 bytes a face.
/// Errors     Throws std::bad_alloc.
/// Threads    Reads `mesh` and `cycles`; any number at a time.
[[nodiscard]] Orientation find_orientation(const Connectivity& mesh, const RadialCycles& cycles);

}  // namespace hedgerow
