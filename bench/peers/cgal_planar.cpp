#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "peers/planar.h"

namespace hedgerow::bench {

using PlanarKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Index count_cgal_triangles(std::span<const Point2> points) {
  std::vector<PlanarKernel::Point_2> theirs;
  theirs.reserve(points.size());
  for (const Point2& p : points) theirs.emplace_back(p[0], p[1]);
  const CGAL::Delaunay_triangulation_2<PlanarKernel> delaunay(theirs.begin(), theirs.end());
  return static_cast<Index>(delaunay.number_of_faces());
}

}  // namespace hedgerow::bench
