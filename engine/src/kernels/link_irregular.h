#pragma once

#include <cstdint>
#include <span>

#include "hedgerow/defect.h"
#include "hedgerow/topology.h"
#include "kernels/link_vertices.h"

namespace hedgerow::kernels {

/// One side of an edge at the vertex being linked.
struct Spoke {
  Index neighbour;   ///< the other end of the edge
  Index corner;      ///< which corner of the vertex
  Index halfedge;    ///< the half-edge on the edge: leaving the vertex, or entering it
  bool is_outgoing;  ///< which of the two
};

/// Memory for one vertex of `k` corners. What does not fit is the caller's bug.
struct IrregularScratch {
  std::span<Spoke> spokes;    ///< 4 k: 2 k sorted, and room to sort
  std::span<Index> follower;  ///< k
  std::span<Index> preceder;  ///< k
  std::span<Index> group;     ///< k
  std::span<Defect> defects;  ///< 2 k + 1 (edges, duplicate faces, the vertex)
  std::span<FanStart> fans;   ///< k
};

/// What one vertex came to.
struct IrregularResult {
  LinkStats stats;
  Index fan_count = 0;     ///< fans[1 .. fan_count) of the scratch are the extra ones
  Index defect_count = 0;  ///< in the scratch; `face` is not set
};

/// Links one vertex of any valence and any defect: the general path beside `link_vertices`.
///
/// Sorts the two spokes of each corner by neighbour; each run of equal neighbours is one edge, seen
/// whole. An edge seen from its smaller end is reported if it is bad, and faces that share the edge
/// and their third vertex are reported as duplicates (of triangles; see duplicate_faces.h).
/// `is_cut`, if not null, tells half-edges that take no part in pairing.
/// Complexity O(k): radix sort above a small size; `stats.step_count` counts the moves.
/// \pre corners are ascending by half-edge. Writes opposite of the half-edges that leave v, and
///      outgoing of v.
[[nodiscard]] IrregularResult link_irregular(VertexId v, std::span<const Corner> corners,
                                             bool is_triangles, const std::uint8_t* is_cut,
                                             Index* opposite, Index& outgoing,
                                             const IrregularScratch& scratch) noexcept;

}  // namespace hedgerow::kernels
