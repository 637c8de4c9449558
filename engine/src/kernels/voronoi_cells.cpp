#include "kernels/voronoi_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/join_sets.h"
#include "kernels/predicates.h"

namespace hedgerow::kernels {
namespace {

const Point2& at(const Point2* points, VertexId v) noexcept { return points[v.value]; }

// Whether a point is inside by a millionth of the box, so by more than a checked centre errs.
bool is_well_inside(const Point2& point, const Box2& box) noexcept {
  constexpr double kMargin = 1e-6;
  const double margin = kMargin * std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  return point[0] > box.low[0] + margin && point[0] < box.high[0] - margin &&
         point[1] > box.low[1] + margin && point[1] < box.high[1] - margin;
}

struct Centre {
  Point2 point;
  double certainty;  // of the area: its share in what it is the difference of
};

// From the corner across the longest side: from another one, two sides next to a short one would be
// nearly equal, and what is left of their difference is mostly rounding.
Centre centre_from(const Point2& a, const Point2& b, const Point2& c) noexcept {
  const double bx = b[0] - a[0];
  const double by = b[1] - a[1];
  const double cx = c[0] - a[0];
  const double cy = c[1] - a[1];
  const double b_lift = bx * bx + by * by;
  const double c_lift = cx * cx + cy * cy;
  const double area = bx * cy - by * cx;
  const double half = 0.5 / area;
  return {{a[0] + (cy * b_lift - by * c_lift) * half, a[1] + (bx * c_lift - cx * b_lift) * half},
          std::abs(area) / (std::abs(bx * cy) + std::abs(by * cx))};
}

double squared_distance(const Point2& a, const Point2& b) noexcept {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

Centre centre_of(const Point2& a, const Point2& b, const Point2& c) noexcept {
  const double bc = squared_distance(b, c);
  const double ca = squared_distance(c, a);
  const double ab = squared_distance(a, b);
  if (bc >= ca && bc >= ab) return centre_from(a, b, c);
  return ca >= ab ? centre_from(b, c, a) : centre_from(c, a, b);
}

}  // namespace

unsigned axis_outside(const Point2& point, const Box2& box) noexcept {
  for (unsigned axis = 0; axis < 2; ++axis) {
    const double low = box.low[axis];
    const double high = box.high[axis];
    const bool is_inside = point[axis] > low && point[axis] < high && 2 * low - point[axis] < low &&
                           2 * high - point[axis] > high;
    if (!is_inside) return axis;
  }
  return 2;
}

Point2 checked_centre(const Point2& a, const Point2& b, const Point2& c) noexcept {
  const Centre centre = centre_of(a, b, c);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  return centre.certainty > 1e-6 ? centre.point : Point2{kNan, kNan};
}

Point2 centre(const Point2& a, const Point2& b, const Point2& c) noexcept {
  return centre_of(a, b, c).point;
}

void scatter_reaching(const TriangleView& mesh, const Point2* points, const Box2& box,
                      char* reaches) noexcept {
  for (Index h = 0; h < mesh.halfedge_count(); h += 3) {
    const VertexId a = mesh.origin[HalfedgeId(h)];
    const VertexId b = mesh.origin[HalfedgeId(h + 1)];
    const VertexId c = mesh.origin[HalfedgeId(h + 2)];
    const Point2 middle = checked_centre(at(points, a), at(points, b), at(points, c));
    if (is_well_inside(middle, box)) continue;
    for (const VertexId v : {a, b, c}) reaches[v.value] = 1;
  }
  for (HalfedgeId h(0); h.value < mesh.halfedge_count(); ++h.value) {
    if (mesh.opposite[h].valid()) continue;
    reaches[mesh.origin[h].value] = 1;
  }
}

void join_centres(const TriangleView& mesh, const MirroredSites& sites, const Point2* centres,
                  bool is_rounded, double least, Index* parents) noexcept {
  const auto near = [&](Index f, Index g) {
    return std::max(std::abs(centres[f][0] - centres[g][0]),
                    std::abs(centres[f][1] - centres[g][1])) <= least;
  };
  const auto is_foreign = [&](VertexId v, VertexId w) {
    return sites.is_site(v) && !sites.is_site(w) && sites.owner[w.value] != v.value;
  };
  for (HalfedgeId h(0); h.value < mesh.halfedge_count(); ++h.value) {
    const HalfedgeId o = mesh.opposite[h];
    if (!o.valid() || o < h) continue;
    const VertexId v = mesh.origin[h];
    const VertexId w = mesh.origin[o];
    if (!sites.is_site(v) && !sites.is_site(w)) continue;
    const Index f = mesh.face(h).value;
    const Index g = mesh.face(o).value;
    const bool is_same = (is_rounded && (is_foreign(v, w) || is_foreign(w, v)) && near(f, g)) ||
                         incircle(at(sites.points, v), at(sites.points, w),
                                  at(sites.points, mesh.origin[mesh.prev(h)]),
                                  at(sites.points, mesh.origin[mesh.prev(o)])) == 0;
    if (is_same) join_sets(parents, f, g);
  }
}

}  // namespace hedgerow::kernels
