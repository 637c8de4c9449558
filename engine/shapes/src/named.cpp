#include <algorithm>
#include <cmath>

#include "counts.h"
#include "hedgerow/shapes.h"

namespace hedgerow::shapes {

namespace {

constexpr std::array<const char*, kShapes.size()> kNames = {
    "grid",  "quad-grid", "torus", "icosphere", "fan",
    "strip", "mobius",    "klein", "terrain",   "gyroid"};

// The whole number nearest to sqrt(count / per_square), at least `smallest`.
std::int64_t side(std::int64_t count, double per_square, std::int64_t smallest) {
  const double root = std::sqrt(static_cast<double>(count) / per_square);
  return std::max(smallest, static_cast<std::int64_t>(root + 0.5));
}

// Nearest by ratio: 20 * 4^level is at most twice as many as asked for.
std::int64_t nearest_level(std::int64_t triangles) {
  std::int64_t level = 0;
  for (std::int64_t count = 80; count / 2 <= triangles && level < 30; count *= 4) ++level;
  return level;
}

// Triangles of a gyroid of c^3 cubes, divided by c^2; measured at 20 to 200 cells.
constexpr double kGyroidTriangles = 55.4;

}  // namespace

const char* name(Shape shape) noexcept { return kNames[static_cast<std::size_t>(shape)]; }

std::optional<Shape> shape_named(std::string_view word) noexcept {
  for (const Shape shape : kShapes) {
    if (word == name(shape)) return shape;
  }
  return std::nullopt;
}

Result<Soup> generate(Shape shape, std::int64_t triangles) {
  if (auto ok = at_least(1, triangles); !ok) return fail(ok.error());
  switch (shape) {
    case Shape::grid: {
      const std::int64_t n = side(triangles, 2, 1);
      return grid(n, n);
    }
    case Shape::quad_grid: {
      const std::int64_t n = side(triangles, 2, 1);
      return quad_grid(n, n);
    }
    case Shape::torus: {
      const std::int64_t n = side(triangles, 4, 3);
      return torus(2 * n, n);
    }
    case Shape::icosphere:
      return icosphere(nearest_level(triangles));
    case Shape::fan:
      return fan(triangles);
    case Shape::strip:
      return strip(triangles);
    case Shape::mobius: {
      const std::int64_t n = side(triangles, 16, 1);
      return mobius(8 * n, n);
    }
    case Shape::klein: {
      const std::int64_t n = side(triangles, 4, 3);
      return klein(2 * n, n);
    }
    case Shape::terrain: {
      const std::int64_t n = side(triangles, 2, 1);
      return terrain(n, n);
    }
    case Shape::gyroid:
      return gyroid(side(triangles, kGyroidTriangles, 4));
  }
  return fail({.code = ErrorCode::count_mismatch});
}

}  // namespace hedgerow::shapes
