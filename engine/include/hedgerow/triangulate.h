#pragma once

#include <array>
#include <span>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/point2.h"
#include "hedgerow/result.h"

namespace hedgerow {

/// Points in the plane as a mesh of triangles.
struct Triangulation {
  /// Canonical, default form, its boundary the convex hull. Vertex i is point i; points that repeat
  /// an earlier one are isolated, and so are all if they lie on one line.
  Connectivity mesh;
  /// same_as[i] is the first point with the coordinates of point i. Empty: no two have the same.
  Buffer<Index> same_as;
};

/// The Delaunay triangulation of points in the plane: no point lies inside the circle through the
/// corners of a triangle, and all corners turn left.
///
/// By divide and conquer: L. Guibas and J. Stolfi, 1985; cut in both directions as R. Dwyer, 1987;
/// signs exact as J. Shewchuk, 1997. Of the ways to divide four or more points on one circle one is
/// taken, always the same for the same points in the same order.
///
/// Pre        Any points. -0 is 0.
/// Complexity O(n log n); O(n) steps but for the sort where points are spread evenly. Scratch about
///            160 bytes a point (32-bit indices).
/// Errors     coordinate_out_of_range: element = first point that is not finite, or has a
///            coordinate other than 0 of a magnitude outside 2^-200 .. 2^200, where products of
///            four overflow or vanish; too_many_elements: limit = kMaxCount / 6. Throws
///            std::bad_alloc. On either, nothing has happened.
/// Threads    Those of `execution`; same bytes for all of them.
[[nodiscard]] Result<Triangulation> triangulate(std::span<const Point2> points,
                                                const Execution& execution);

/// A triangulation with edges that it was told to have.
struct ConstrainedTriangulation {
  Connectivity mesh;          ///< as of `Triangulation`
  Buffer<Index> same_as;      ///< as of `Triangulation`
  Buffer<Index> constrained;  ///< half-edges on such edges, ascending, both sides of each
};

/// The same with given edges, from point to point: as near to Delaunay as they let it be. No point
/// that can be seen from inside a triangle, across none of these edges, is inside its circle. An
/// edge that passes points on its way becomes several. Points on one line have no faces, so no
/// edges.
///
/// After S. Sloan, "A fast algorithm for generating constrained Delaunay triangulations", 1993.
///
/// Complexity As `triangulate`; besides, for each given edge, the square of the edges that it
///            crosses at the worst. On the calling thread.
/// Errors     As `triangulate`; index_out_of_range: element = edge, value = the point, limit =
///            their number; repeated_vertex: element = edge, value = its end, where it begins, too;
///            crossing_edges: element = edge, value = an earlier one that it crosses. Throws
///            std::bad_alloc. On either, nothing has happened.
[[nodiscard]] Result<ConstrainedTriangulation> triangulate_constrained(
    std::span<const Point2> points, std::span<const std::array<Index, 2>> edges,
    const Execution& execution);

}  // namespace hedgerow
