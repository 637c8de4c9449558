#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "hedgerow/result.h"
#include "hedgerow/soup.h"

/// Meshes made by rule, for tests, benchmarks and demonstrations.
///
/// Bits       The same positions and numbers with every compiler and C library: double arithmetic,
///            square roots and our own sine, rounded to float once.
/// Faces      Counter-clockwise seen from outside, or from above for the height fields.
/// Errors     count_mismatch: an argument is below its smallest value (value and limit say which);
///            too_many_elements: the mesh does not fit an `Index`. Both before any allocation;
///            then std::bad_alloc is thrown where memory does not suffice.
/// Cost       In proportion to the mesh, on the calling thread.
/// Threads    Any number of calls at once.
namespace hedgerow::shapes {

/// A gently waved height field of `columns` x `rows` unit squares, each cut into two triangles, row
/// by row; vertices row by row, too. At least 1 x 1.
[[nodiscard]] Result<Soup> grid(std::int64_t columns, std::int64_t rows);

/// The same with the squares kept whole: polygons of four corners.
[[nodiscard]] Result<Soup> quad_grid(std::int64_t columns, std::int64_t rows);

/// A closed ring of `around` x `across` squares cut into triangles: genus 1. At least 3 x 3.
[[nodiscard]] Result<Soup> torus(std::int64_t around, std::int64_t across);

/// A unit sphere: the icosahedron with each triangle cut in four `level` times, 20 * 4^level
/// triangles. The vertices of a level come first, then one for each of its edges. Level 0 or more.
[[nodiscard]] Result<Soup> icosphere(std::int64_t level);

enum class FanEnds : std::uint8_t {
  open,    ///< three quarters of a turn
  closed,  ///< a cone
};

/// `triangles` triangles round vertex 0, the others following in order. At least 1 open, 3 closed.
[[nodiscard]] Result<Soup> fan(std::int64_t triangles, FanEnds ends = FanEnds::open);

/// A zigzag of `triangles` triangles, each on the last two vertices of the one before. At least 1.
[[nodiscard]] Result<Soup> strip(std::int64_t triangles);

/// A band of `around` x `across` squares cut into triangles, its ends glued with a half turn: one
/// boundary loop, and a seam of `across` inconsistent edges. At least 3 x 1.
[[nodiscard]] Result<Soup> mobius(std::int64_t around, std::int64_t across);

/// A Klein bottle (the figure-eight immersion): closed, Euler characteristic 0, and a seam of
/// `across` inconsistent edges. At least 3 x 3.
[[nodiscard]] Result<Soup> klein(std::int64_t around, std::int64_t across);

/// A height field of fractal noise over `columns` x `rows` squares, numbered like `grid`.
[[nodiscard]] Result<Soup> terrain(std::int64_t columns, std::int64_t rows, std::uint64_t seed = 1);

/// Two periods of a gyroid in a box of `cells`^3 cubes, by marching tetrahedra: like a scan, with
/// irregular valences, thin triangles and many boundary loops. At least 4. The surface is
/// A. Schoen's (1970).
[[nodiscard]] Result<Soup> gyroid(std::int64_t cells);

/// The same faces with vertices and faces renumbered at random; each face keeps its corners in
/// order. `seed` decides the order alone, the same on every machine. \pre every index is in range.
[[nodiscard]] Soup shuffled(const Soup& soup, std::uint64_t seed);

enum class Shape : std::uint8_t {
  grid,
  quad_grid,
  torus,
  icosphere,
  fan,
  strip,
  mobius,
  klein,
  terrain,
  gyroid,
};
inline constexpr std::array kShapes = {
    Shape::grid,  Shape::quad_grid, Shape::torus, Shape::icosphere, Shape::fan,
    Shape::strip, Shape::mobius,    Shape::klein, Shape::terrain,   Shape::gyroid};

/// Stable lower-case word with dashes: "grid", "quad-grid".
[[nodiscard]] const char* name(Shape shape) noexcept;
[[nodiscard]] std::optional<Shape> shape_named(std::string_view word) noexcept;

/// The shape in the usual proportions with about `triangles` triangles (a quad counts as two):
/// exact for fan and strip, the nearest square number of cells for those made of squares, the
/// nearest level for the icosphere, within a few per cent for large gyroids. A number too small for
/// the shape gives its smallest form. At least 1.
[[nodiscard]] Result<Soup> generate(Shape shape, std::int64_t triangles);

/// The size where a caller has no wish.
inline constexpr std::int64_t kDefaultTriangles = 20'000;

}  // namespace hedgerow::shapes
