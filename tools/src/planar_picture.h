#pragma once

#include <span>
#include <string>

#include "hedgerow/connectivity.h"
#include "hedgerow/point2.h"

namespace hedgerow::tool {

/// A drawing of a mesh in the plane as SVG, y upwards: each edge once, those of the boundary
/// heavier, and a dot at each of `dots`. About 30 bytes an edge and 40 a dot.
[[nodiscard]] std::string planar_svg(const Connectivity& mesh, std::span<const Point2> vertices,
                                     std::span<const Point2> dots, const std::string& title);

}  // namespace hedgerow::tool
