#pragma once

#include "hedgerow/index.h"
#include "kernels/planar_pieces.h"

/// From the sides of a finished triangulation to the columns of a mesh, in the order of the sides,
/// which is that of the points. On one thread.
namespace hedgerow::kernels {

/// `Side::corner` of the sides with the outside on their left.
inline constexpr Index kOutside = -2;

/// Marks the sides round the outside, to which `side` belongs.
void mark_outside(Index side, Side* sides) noexcept;

/// Numbers the triangles: the sides of triangle f become half-edges 3 f .. 3 f + 2. Returns the
/// number of half-edges. \pre corner is -1 or `kOutside`.
Index number_corners(Index side_count, Side* sides) noexcept;

/// Fills origin and opposite. `order` gives the number of a point in the mesh.
void fill_triangles(Index side_count, const Side* sides, const Index* order, Index* origin,
                    Index* opposite) noexcept;

/// The half-edge that starts the rotation of each point: its smallest, or where it is on the
/// outside the first (I5, I6); -1 without triangles. `starts` has an entry for each point.
void fill_starts(IndexRange points, Index side_count, const Side* sides, Index* starts) noexcept;

}  // namespace hedgerow::kernels
