#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hedgerow/index.h"
#include "hedgerow/positions.h"

namespace hedgerow::ray {

/// Cuts polygons into triangles, one after the other; keeps its memory between them.
///
/// A polygon that is convex, seen along its area vector, becomes a fan round its first corner, in
/// O(n). Any other is cut ear by ear (G. Meisters, "Polygons have ears", 1975): O(n r) where r of
/// the n corners are reflex, and a fan of the rest where the search has cost too much or finds no
/// ear, as on a polygon that crosses itself. Always n - 2 triangles.
class Triangulator {
 public:
  /// Triangles as numbers into `vertices`; valid until the next call. \pre at least 3 vertices
  [[nodiscard]] std::span<const std::array<Index, 3>> cut(std::span<const Index> vertices,
                                                          Positions positions);

 private:
  using Point = std::array<double, 2>;

  void project(std::span<const Index> vertices, Positions positions);
  [[nodiscard]] bool is_convex() const noexcept;
  [[nodiscard]] double turn(Index a, Index b, Index c) const noexcept;
  [[nodiscard]] bool is_reflex(Index i) const noexcept;
  [[nodiscard]] bool is_ear(Index i, std::int64_t& work) const noexcept;
  void clip_ears();
  void fan(Index first);

  std::vector<Point> points_;
  std::vector<Index> next_;
  std::vector<Index> prev_;
  std::vector<Index> reflex_;
  std::vector<std::array<Index, 3>> triangles_;
};

}  // namespace hedgerow::ray
