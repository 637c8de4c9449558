#pragma once

#include <span>
#include <string>

#include "hedgerow/connectivity.h"
#include "hedgerow/point2.h"

namespace hedgerow::tool {

/// A mesh in the plane, and what a picture shows of it.
struct PlanarDrawing {
  const Connectivity& mesh;
  std::span<const Point2> vertices;
  std::span<const Point2> dots;
  std::span<const Index> constrained;  ///< half-edges to be seen from far
  const char* title;                   ///< plain words: it stands in the file as it is
};

/// The drawing as SVG, y upwards: each edge once, those of the boundary and the constrained ones
/// heavier, and a dot at each of `dots`. About 30 bytes an edge and 40 a dot.
[[nodiscard]] std::string planar_svg(const PlanarDrawing& drawing);

}  // namespace hedgerow::tool
