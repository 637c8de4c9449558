#pragma once

#include <cstdint>
#include <span>

#include "kernels/corner_slots.h"

namespace hedgerow::kernels {

/// Counted while linking; sums, so the order of blocks does not matter.
struct LinkStats {
  std::int64_t paired_count = 0;    ///< half-edges that got an opposite
  std::int64_t boundary_count = 0;  ///< edges with a single half-edge, seen from its origin
  std::int64_t bad_edge_count = 0;  ///< edges with several half-edges that do not pair
  std::int64_t step_count = 0;      ///< corners visited plus comparisons made
  Index irregular_count = 0;        ///< vertices left to others

  friend LinkStats operator+(const LinkStats& a, const LinkStats& b) noexcept {
    return {a.paired_count + b.paired_count, a.boundary_count + b.boundary_count,
            a.bad_edge_count + b.bad_edge_count, a.step_count + b.step_count,
            a.irregular_count + b.irregular_count};
  }
};

/// Pairs the half-edges round each vertex of the block whose corners form one closed fan of 3 to
/// CornerSlot::kCapacity corners, and sets `outgoing`.
///
/// Corner i of a vertex is followed, in the rotation next[opposite[.]], by the corner j whose
/// source is i's target; then opposite[i.halfedge] = j.incoming. If each target is the source of
/// exactly one corner and the rotation from the first corner meets all of them, they are one closed
/// fan. All other vertices, isolated ones too, are appended to `irregular`, and neither their
/// `outgoing` nor a half-edge that leaves them is written.
///
/// \pre  `irregular` holds block.size entries.
/// Race-free: a vertex writes its own `outgoing` and the `opposite` of the half-edges that leave
/// it.
LinkStats link_vertices(const CornerSlots& slots, Index* opposite, Index* outgoing,
                        Index* irregular) noexcept;

/// The plain form that the fast one is tested against.
LinkStats link_vertices_scalar(const CornerSlots& slots, Index* opposite, Index* outgoing,
                               Index* irregular) noexcept;

/// All corners of a vertex at a time; the same as the plain form where the build has no AVX2.
/// \pre the processor has AVX2, and indices are 32 bits wide; see `simd_path`.
LinkStats link_vertices_avx2(const CornerSlots& slots, Index* opposite, Index* outgoing,
                             Index* irregular) noexcept;

/// Valence up to which a vertex is linked by comparing all its corners with all.
inline constexpr Index kSmallValence = 16;

/// The same for one vertex of 1 to kSmallValence corners in any fan, closed or open. False: not one
/// fan, nothing was written. A closed fan of two corners is a face on both sides of another and is
/// left as well: the general path looks for duplicate faces.
bool link_fan(std::span<const Corner> corners, Index* opposite, Index& outgoing,
              LinkStats& stats) noexcept;

}  // namespace hedgerow::kernels
