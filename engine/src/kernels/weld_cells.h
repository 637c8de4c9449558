#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "hedgerow/index.h"

/// A grid of cells for points that are to be joined within a distance.
namespace hedgerow::kernels {

struct WeldPoint {
  float p[3];
  Index vertex;
};

/// Half cells along each axis: the cell is half of that, rounded down.
struct WeldCell {
  std::int64_t half[3];

  [[nodiscard]] std::int64_t whole(int axis) const noexcept { return half[axis] >> 1; }
};

/// Sides of half cells are a little over half of the distance: points of one are within it, even
/// across, and points within it are in the same cell or in neighbours, for all that is rounded.
inline constexpr double kWeldMargin = 1 + 0x1p-10;
/// Beyond so many half cells two coordinates that differ at all are further apart than a cell.
inline constexpr double kWeldFar = 0x1p40;

/// \pre x is finite or infinite; side > 0
[[nodiscard]] inline std::int64_t half_cell(float x, double side) noexcept {
  const double cell = std::floor(static_cast<double>(x) / side);
  if (std::fabs(cell) < kWeldFar) return static_cast<std::int64_t>(cell);
  // A number of its own for each coordinate, two apart, so that others are in other cells.
  const auto bits = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(std::fabs(x)));
  const std::int64_t far = (std::int64_t{1} << 41) + 4 * bits;
  return x < 0 ? -far : far;
}

[[nodiscard]] inline WeldCell cell_of(const WeldPoint& point, double side) noexcept {
  return {{half_cell(point.p[0], side), half_cell(point.p[1], side), half_cell(point.p[2], side)}};
}

[[nodiscard]] inline double square_distance(const WeldPoint& a, const WeldPoint& b) noexcept {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // Equal coordinates are at no distance, infinite ones too.
    const double step = a.p[axis] == b.p[axis] ? 0.0 : static_cast<double>(a.p[axis]) - b.p[axis];
    sum += step * step;
  }
  return sum;
}

/// The box of a run of points.
struct WeldBox {
  float low[3];
  float high[3];

  [[nodiscard]] int longest_axis() const noexcept {
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (extent(axis) > extent(longest)) longest = axis;
    }
    return longest;
  }
  [[nodiscard]] double extent(int axis) const noexcept {
    return high[axis] == low[axis] ? 0.0 : static_cast<double>(high[axis]) - low[axis];
  }
};
[[nodiscard]] inline WeldBox box_of(const WeldPoint* begin, const WeldPoint* end) noexcept {
  WeldBox box{{begin->p[0], begin->p[1], begin->p[2]}, {begin->p[0], begin->p[1], begin->p[2]}};
  for (const WeldPoint* point = begin + 1; point < end; ++point) {
    for (int axis = 0; axis < 3; ++axis) {
      if (point->p[axis] < box.low[axis]) box.low[axis] = point->p[axis];
      if (point->p[axis] > box.high[axis]) box.high[axis] = point->p[axis];
    }
  }
  return box;
}
/// Of the nearest points that the boxes could have, and of the farthest.
[[nodiscard]] inline double least_square_distance(const WeldBox& a, const WeldBox& b) noexcept {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = static_cast<double>(b.low[axis]) - a.high[axis];
    const double above = static_cast<double>(a.low[axis]) - b.high[axis];
    const double gap = below > 0 ? below : above > 0 ? above : 0.0;
    sum += gap * gap;
  }
  return sum;
}
[[nodiscard]] inline double most_square_distance(const WeldBox& a, const WeldBox& b) noexcept {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double one = static_cast<double>(b.high[axis]) - a.low[axis];
    const double other = static_cast<double>(a.high[axis]) - b.low[axis];
    const double reach = one > other ? one : other;
    sum += reach * reach;
  }
  return sum;
}

}  // namespace hedgerow::kernels
