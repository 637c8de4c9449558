#pragma once

#include <cstdint>

#include "hedgerow/index.h"
#include "kernels/predicates.h"
#include "kernels/radix.h"

/// The order of points in which their triangulation proceeds by halves: by cells of a lattice along
/// the Z-order curve, and within a cell that of a k-d tree. Ranges that partition the points write
/// disjoint elements.
namespace hedgerow::kernels {

/// Smallest box round some points, and the first of them that cannot be used.
struct PlanarBox {
  Point2 low;
  Point2 high;
  bool is_empty = true;
  Index bad = kInvalidIndex;
  Index bad_count = 0;

  /// Exactly associative and commutative, but for the sign of a zero.
  friend PlanarBox join(const PlanarBox& a, const PlanarBox& b) noexcept;
};

/// Whether the predicates are exact for it: 0, or of a magnitude from 2^-k to 2^k.
inline constexpr int kMaxExponent = 200;
[[nodiscard]] bool is_usable(double coordinate) noexcept;

[[nodiscard]] PlanarBox find_planar_box(IndexRange range, const Point2* points) noexcept;

/// 2^bits by 2^bits cells that fill a box; about two points in each.
struct PlanarLattice {
  Point2 low{};
  Point2 cells_per_unit{};
  unsigned bits = 0;

  PlanarLattice(const PlanarBox& box, Index point_count) noexcept;
  /// The place of the cell of a point on the Z-order curve: bits of x and y in turn, those of y
  /// more significant. A larger coordinate never has a smaller cell.
  [[nodiscard]] std::uint64_t key(const Point2& point) const noexcept;
};

void fill_planar_keys(IndexRange range, const Point2* points, const PlanarLattice& lattice,
                      KeyedItem* items) noexcept;

/// Orders the points of one cell, `order[range]`, by x, then y, then number. Returns how many have
/// the coordinates of the one before. O(m log m).
[[nodiscard]] Index order_cell(IndexRange range, const Point2* points, Index* order) noexcept;

/// Whether level `depth` of the k-d tree of a cell cuts by y.
[[nodiscard]] constexpr bool is_by_y_at(unsigned depth) noexcept { return depth % 2 == 1; }

/// Makes the distinct points of one cell a k-d tree: each level halves its range. O(m log m).
void order_as_tree(IndexRange range, const Point2* points, Index* order) noexcept;

}  // namespace hedgerow::kernels
