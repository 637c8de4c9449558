#pragma once

#include <cstddef>
#include <cstdint>

#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/face_list.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"
#include "hedgerow/workspace.h"

namespace hedgerow {

/// How much each corner adds to its vertex. N is the area vector of the face (for a triangle the
/// cross product of two edges, length twice the area), n its unit vector, a and b the two edge
/// vectors at the corner.
///
/// Rounding   The area vector of a triangle is computed at its first corner, which turns it by some
///            2^-24 / sin(angle there): 2e-5 on a needle with a tip of 0.003. `max`, which gives
///            needles the most weight, computes it at the largest angle, where the sine is largest,
///            too. Tested on fans of needles.
enum class NormalWeight : std::uint8_t {
  uniform,  ///< n
  area,     ///< N
  angle,    ///< angle(a, b) n: Thurmer and Wuthrich 1998; interior angle, so above pi where reflex
  max,      ///< a x b / (|a|^2 |b|^2): sine over lengths, exact on a sphere; Max 1999
};

/// What to write where there is no direction: a face of zero area, a vertex whose sum is zero or
/// that is on no face.
enum class DegeneratePolicy : std::uint8_t {
  zero,  ///< (0, 0, 0)
  keep,  ///< leave what the output holds, e.g. last frame's normal
  axis,  ///< (0, 0, 1)
};

/// The area vector of a polygon with more than three corners. M. Newell's sum: Sutherland, Sproull
/// and Schumacker, "A characterization of ten hidden-surface algorithms", 1974.
enum class PolygonMethod : std::uint8_t {
  newell,      ///< Newell's sum, taken about the first corner so that far-away meshes keep digits
  wedge_mean,  ///< the mean of the cross products of the two edge vectors at each corner
};

struct NormalOptions {
  NormalWeight weight = NormalWeight::area;
  DegeneratePolicy degenerate = DegeneratePolicy::zero;
  PolygonMethod polygon = PolygonMethod::newell;
};

/// Counted while writing; the same for every method and thread count.
struct NormalStats {
  std::int64_t degenerate_count = 0;  ///< outputs without a direction (zero or not finite)
  Index first_degenerate = kInvalidIndex;

  friend constexpr bool operator==(const NormalStats&, const NormalStats&) noexcept = default;
};

/// Largest error of the corner angle that `NormalWeight::angle` uses, in radians, for edge vectors
/// whose float cross and dot products are exact; twice that for the largest angle of a triangle,
/// which is what the two others leave of half a turn. Tested against long double.
inline constexpr double kAngleErrorBound = 3e-7;

/// One unit normal per face, in the direction from which its corners run counter-clockwise.
///
/// Layout     Lengths are those of the positions; normals are plain floats of length 1, within
///            5 * 2^-24. Coordinates may have any finite size: sums that would overflow or lose
///            digits in float are made again in double.
/// Pre        positions.count >= vertex count; out.count >= face count; out overlaps no input.
/// Complexity O(H). Bytes a triangle: reads 12 + its share of 12 a vertex, writes 12.
/// Errors     null_pointer, bad_stride, count_mismatch; index_out_of_range from the face list.
/// Threads    Those of `execution`; same bits for all of them, scalar or SIMD.
[[nodiscard]] Result<NormalStats> face_normals(const FaceList& faces, Positions positions,
                                               NormalsOut out, const NormalOptions& options,
                                               const Execution& execution);
[[nodiscard]] Result<NormalStats> face_normals(const Connectivity& mesh, Positions positions,
                                               NormalsOut out, const NormalOptions& options,
                                               const Execution& execution);

/// One unit normal per vertex by walking the half-edges round it (default or closed form).
///
/// Each vertex reads its neighbours and writes itself, so any partition of the vertices is
/// race-free. The sum runs over its corners in ascending half-edge id, in float: the same bits as
/// `scatter_vertex_normals`. Polygons read face vectors that a first pass leaves in the workspace;
/// triangles keep what the faces near the walk add in a window there.
///
/// Pre        positions.count and out.count >= vertex count; out overlaps no input; a sound mesh.
/// Complexity O(V + H). Bytes a vertex on a closed triangle mesh: 76. Two threads are used from
///            16,385 vertices on.
/// Scratch    A thread: up to 256 KB for the window (384 KB for `angle` and `max`), and a bit for
///            each half-edge. Polygons: a vector for each face.
/// Errors     null_pointer, bad_stride, count_mismatch, scratch_too_small.
/// Threads    Those of `execution`; same bits for all of them, scalar or SIMD.
[[nodiscard]] Result<NormalStats> gather_vertex_normals(const Connectivity& mesh,
                                                        Positions positions, NormalsOut out,
                                                        const NormalOptions& options,
                                                        const Execution& execution,
                                                        Workspace& workspace);
/// What the call above with these arguments asks of a fixed workspace.
[[nodiscard]] std::size_t gather_vertex_normals_scratch_bytes(const Connectivity& mesh,
                                                              const NormalOptions& options,
                                                              const Execution& execution);

/// One unit normal per vertex from the face list alone: each face adds to its corners, then each
/// sum is normalised.
///
/// Pre        positions.count and out.count >= faces.vertex_count; out overlaps no input.
/// Race-free in parallel because blocks of vertices are owned by one task, which visits the runs of
/// faces that touch them in ascending order and adds to its own vertices only; so the order of each
/// sum is that of the serial loop. Faces on the edge between tasks are computed for each. Where
/// faces and vertices are in one order, the sums of a task are those of a window that slides along.
/// Complexity O(V + H) for faces in a local order. On shuffled input every block visits every
///            face: O(threads * H), which two threads still gain from.
///            Bytes a vertex on a closed triangle mesh: 48.
/// Errors     null_pointer, bad_stride, count_mismatch, index_out_of_range, scratch_too_small.
/// Threads    Those of `execution`; same bits for all of them, scalar or SIMD.
[[nodiscard]] Result<NormalStats> scatter_vertex_normals(const FaceList& faces, Positions positions,
                                                         NormalsOut out,
                                                         const NormalOptions& options,
                                                         const Execution& execution,
                                                         Workspace& workspace);
/// What the call above with these arguments asks of a fixed workspace.
[[nodiscard]] std::size_t scatter_vertex_normals_scratch_bytes(const FaceList& faces,
                                                               const NormalOptions& options,
                                                               const Execution& execution);

/// The face list that a mesh in canonical form was built from: `origin` and `first`, not copied.
/// Lifetime   That of the mesh.
[[nodiscard]] FaceList face_list(const Connectivity& mesh) noexcept;

/// Angle between two vectors from the length of their cross product and their dot product, in
/// radians [0, pi]; polynomial arithmetic only, so the same bits everywhere. 0 for (0, 0).
[[nodiscard]] float angle_between(float cross_length, float dot) noexcept;

}  // namespace hedgerow
