#pragma once

#include <span>

#include "hedgerow/index.h"
#include "hedgerow/point2.h"

namespace hedgerow::bench {

/// Triangulates with CGAL, exact signs, points sorted along a curve by it; returns the number of
/// triangles. Present only if CMake found it.
[[nodiscard]] Index count_cgal_triangles(std::span<const Point2> points);

}  // namespace hedgerow::bench
