#pragma once

#include <cstdint>
#include <span>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"

namespace hedgerow {

enum class SubdivisionScheme : std::uint8_t {
  catmull_clark,  ///< polygons of any degree to quads: E. Catmull and J. Clark, 1978
  loop,           ///< triangles in four: C. Loop, "Smooth subdivision surfaces", 1987
  sqrt3,          ///< triangles in three: L. Kobbelt, "sqrt(3)-subdivision", 2000
};

struct SubdivisionOptions {
  SubdivisionScheme scheme = SubdivisionScheme::catmull_clark;
  int levels = 1;  ///< 0 copies the mesh
  /// Sharpness of the edge of each half-edge with a face, or empty: no creases. Of two opposite
  /// half-edges the larger counts; what is not above 0 is smooth. Not for sqrt3.
  std::span<const float> sharpness;
};

struct SubdivisionOutput {
  Connectivity mesh;        ///< in the boundary form of the input
  Buffer<float> positions;  ///< x, y, z of each vertex
  Buffer<float> sharpness;  ///< what is left of it, for each half-edge with a face; or empty
};

/// Refines a mesh `levels` times and moves its vertices.
///
/// Pre        options.levels >= 0; `mesh` is sound, as `validate` says.
/// Numbers    Vertices keep theirs. Catmull-Clark adds one a face, then one an edge, in the order
///            of the smaller half-edge; half-edge h becomes face h, with its origin as corner 0.
///            Loop adds one an edge; face f becomes 4f + k at corner k and 4f + 3 in the middle.
///            sqrt3 adds one a face, or where a boundary edge is cut in three, two; half-edge h
///            becomes face h. The connectivity is what `build` makes of these faces, to the byte.
/// Boundary   A cubic B-spline curve that depends on the boundary alone (corners of one face are
///            rounded, too). sqrt3 leaves it alone at odd levels and cuts each edge in three, by
///            Kobbelt's rule, at even ones.
/// Creases    T. DeRose, M. Kass and T. Truong, "Subdivision surfaces in character animation",
///            1998: sharpness falls by one a level; below one the smooth and the sharp point are
///            blended, at a vertex by the mean over its sharp edges. One sharp edge is a dart,
///            which is smooth; more than two make a corner, which stays.
/// Not manifold  Edges that the builder cut are boundary, each of their half-edges by itself. A
///            vertex with several fans stays where it is; so does an isolated one.
/// Sums       In double, in the order of rotation from `outgoing`; rounded to float at each level.
/// Complexity O(V + H) of the output. Catmull-Clark writes 16 bytes an output half-edge, Loop and
///            sqrt3 8, and all of them 16 a vertex. Scratch: one index for each half-edge
///            of a level.
/// Errors     not_triangles, of Loop and sqrt3; count_mismatch: too few positions, or not as much
///            sharpness as half-edges with a face (limit 0 for sqrt3); bad_stride; null_pointer;
///            too_many_elements: half-edges before any work, vertices before a level is allocated;
///            those of `open_boundary`. Throws std::bad_alloc.
/// Threads    Those of `execution`; same bytes for all of them.
/// Lifetime   The result shares nothing with its input.
[[nodiscard]] Result<SubdivisionOutput> subdivide(const Connectivity& mesh,
                                                  const Positions& positions,
                                                  const SubdivisionOptions& options,
                                                  const Execution& execution);

}  // namespace hedgerow
