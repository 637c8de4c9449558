#pragma once

#include <cstdint>

#include "hedgerow/index.h"
#include "hedgerow/point2.h"
#include "hedgerow/topology.h"

/// From the triangulation of sites and of their mirror images to the cells of the sites.
namespace hedgerow::kernels {

/// The sides of a box at which points are mirrored: bit 2 k + 1 is the upper one of axis k.
inline constexpr unsigned kBoxSides = 4;

/// The mirror image of a point at a side.
[[nodiscard]] inline Point2 mirrored(Point2 point, const Box2& box, unsigned side) noexcept {
  const unsigned axis = side / 2;
  const double at = side % 2 == 0 ? box.low[axis] : box.high[axis];
  point[axis] = 2 * at - point[axis];
  return point;
}

/// The axis along which a point is not within the box, mirror images told apart; 2: it is within.
[[nodiscard]] unsigned axis_outside(const Point2& point, const Box2& box) noexcept;

/// The centre of a circle through three points, relative errors about 1e-9 of the radius or less;
/// or not a number, where rounding might make them larger.
[[nodiscard]] Point2 checked_centre(const Point2& a, const Point2& b, const Point2& c) noexcept;

/// The same, as near as rounding lets it be; not a number for points on a line.
[[nodiscard]] Point2 centre(const Point2& a, const Point2& b, const Point2& c) noexcept;

/// Marks the sites whose cells may reach the box: those of triangles whose centre is not well
/// inside, or uncertain, and of the hull. Writes `reaches` of any site, so on one thread.
void scatter_reaching(const TriangleView& mesh, const Point2* points, const Box2& box,
                      char* reaches) noexcept;

/// Who the points of the second triangulation are: sites first, then mirror images.
struct MirroredSites {
  const Point2* points;
  const Index* owner;        ///< the site that point i is an image of, or i itself
  const std::uint8_t* side;  ///< at which the image is; of no meaning for sites
  Index site_count;

  [[nodiscard]] bool is_site(VertexId v) const noexcept { return v.value < site_count; }
};

/// Joins triangles that stand for one vertex: across an edge whose two triangles have all corners
/// on one circle; with `is_rounded`, also across one from a site to another site's image where the
/// centres differ by `least` or less, which without rounding are the same point of the box.
/// `parents` are the sets of join_sets.h. On one thread.
void join_centres(const TriangleView& mesh, const MirroredSites& sites, const Point2* centres,
                  bool is_rounded, double least, Index* parents) noexcept;

}  // namespace hedgerow::kernels
