#pragma once

#include <cstdint>

#include "kernels/corner_blocks.h"

namespace hedgerow::kernels {

/// Counted while linking; sums, so the order of blocks does not matter.
struct LinkStats {
  std::int64_t paired_count = 0;    ///< half-edges that got an opposite
  std::int64_t boundary_count = 0;  ///< edges with a single half-edge, seen from its origin
  std::int64_t bad_edge_count = 0;  ///< edges with several half-edges that do not pair
  std::int64_t step_count = 0;      ///< corners visited plus comparisons made
  Index irregular_count = 0;        ///< vertices left to `link_irregular`

  friend LinkStats operator+(const LinkStats& a, const LinkStats& b) noexcept {
    return {a.paired_count + b.paired_count, a.boundary_count + b.boundary_count,
            a.bad_edge_count + b.bad_edge_count, a.step_count + b.step_count,
            a.irregular_count + b.irregular_count};
  }
};

/// Valence up to which a vertex is linked by comparing all its corners with all.
inline constexpr Index kSmallValence = 16;
/// Corners behind the last one that `link_vertices` may read (and ignore).
inline constexpr Index kCornerPadding = kSmallValence;

/// Pairs the half-edges round each vertex of `block` whose corners form one fan, and sets
/// `outgoing`.
///
/// Corner i of a vertex is followed, in the rotation next[opposite[.]], by the corner j whose
/// source is i's target; then opposite[i.halfedge] = j.incoming. If each target is the source of
/// exactly one corner (but one, on the boundary) the match is a permutation, and one cycle or chain
/// of it is one fan. Vertices where this fails, or with more corners than kSmallValence, are
/// appended to `irregular` and not written; isolated ones too.
///
/// \pre  The corners of block vertex i are corners[ends[i - 1] .. ends[i]), ascending by half-edge
///       (ends[-1] stands for 0); kCornerPadding corners behind the last may be read.
/// \pre  `irregular` holds block.size entries.
/// Race-free: a vertex writes its own `outgoing` and the `opposite` of the half-edges that leave
/// it.
LinkStats link_vertices(VertexBlock block, const Index* ends, const Corner* corners,
                        Index* opposite, Index* outgoing, Index* irregular) noexcept;

/// The plain form that the fast one is tested against.
LinkStats link_vertices_scalar(VertexBlock block, const Index* ends, const Corner* corners,
                               Index* opposite, Index* outgoing, Index* irregular) noexcept;

}  // namespace hedgerow::kernels
