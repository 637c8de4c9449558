#pragma once

#include <span>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/point2.h"
#include "hedgerow/result.h"

namespace hedgerow {

/// The cells of sites in the plane as a mesh of polygons: the dual of their triangulation, cut off
/// at a box.
struct Voronoi {
  /// Canonical, default form, its boundary the box. A vertex is a point with three sites or more at
  /// the same distance, or where an edge between two ends on the box, or a corner of it.
  Connectivity mesh;
  Buffer<Point2> points;  ///< of the vertices
  /// The site of each face, ascending: face i is site i where no two sites are at the same place;
  /// else the first one there has the face.
  Buffer<Index> sites;
};

/// A box with all sites well inside: theirs, and a tenth of its longer side, or 1 where that is
/// nothing, all round. The unit box round the origin if there are no sites.
/// \pre coordinates are finite
[[nodiscard]] Box2 box_round(std::span<const Point2> sites) noexcept;

/// The Voronoi diagram of `sites` within `box`: each cell holds the points nearest to its site.
///
/// The connectivity follows from exact signs. Sites whose cells reach the box are mirrored at its
/// sides, and the diagram of all of them has no other edges there than the sides: so every cell is
/// bounded, and whether an edge meets the box is never asked of rounded numbers. Four sites or more
/// on one circle share a vertex. Coordinates of vertices are rounded; of those on the box, one
/// exactly to its side.
///
/// Complexity O(n log n), as `triangulate`; twice that where all cells reach the box.
/// Errors     As `triangulate`; site_outside_box: element = first site that is not inside, or so
///            near a side that its mirror image rounds onto it; value = 0 for x, 1 for y. Throws
///            std::bad_alloc. On either, nothing has happened.
/// Threads    Those of `execution`; same bytes for all of them.
[[nodiscard]] Result<Voronoi> voronoi(std::span<const Point2> sites, const Box2& box,
                                      const Execution& execution);

/// The area of a cell: those of all cells add up to the box, but for rounding.
[[nodiscard]] double cell_area(const Voronoi& diagram, FaceId cell) noexcept;

}  // namespace hedgerow
