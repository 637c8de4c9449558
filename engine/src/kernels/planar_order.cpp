#include "kernels/planar_order.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "kernels/planar_pieces.h"

namespace hedgerow::kernels {
namespace {

constexpr unsigned kMaxBits = 20;  // 2^40 cells are more than an `Index` of 32 bits numbers points

// Moves bit i to bit 2 i.
std::uint64_t spread_by_two(std::uint64_t bits) noexcept {
  bits = (bits | bits << 16U) & 0x0000ffff0000ffffU;
  bits = (bits | bits << 8U) & 0x00ff00ff00ff00ffU;
  bits = (bits | bits << 4U) & 0x0f0f0f0f0f0f0f0fU;
  bits = (bits | bits << 2U) & 0x3333333333333333U;
  return (bits | bits << 1U) & 0x5555555555555555U;
}

double cells_per_unit(double length, unsigned bits) noexcept {
  return length > 0 ? std::ldexp(1.0, static_cast<int>(bits)) / length : 0;
}

struct BeforeByX {
  const Point2* points;
  bool operator()(Index i, Index j) const noexcept {
    const Point2& a = points[i];
    const Point2& b = points[j];
    return a[0] != b[0] ? a[0] < b[0] : a[1] != b[1] ? a[1] < b[1] : i < j;
  }
};

struct BeforeByY {
  const Point2* points;
  bool operator()(Index i, Index j) const noexcept {
    const Point2& a = points[i];
    const Point2& b = points[j];
    return a[1] != b[1] ? a[1] < b[1] : a[0] != b[0] ? a[0] > b[0] : i < j;
  }
};

void order_level(IndexRange range, unsigned depth, const Point2* points, Index* order) noexcept {
  // Three points are triangulated at once; their order follows from that of their parent.
  Index* begin = order + range.begin;
  Index* end = order + range.end;
  if (range.size() <= kSmallPiece) {
    std::sort(begin, end, BeforeByX{points});
    return;
  }
  const Index middle = range.begin + range.size() / 2;
  if (is_by_y_at(depth)) {
    std::nth_element(begin, order + middle, end, BeforeByY{points});
  } else {
    std::nth_element(begin, order + middle, end, BeforeByX{points});
  }
  order_level({range.begin, middle}, depth + 1, points, order);
  order_level({middle, range.end}, depth + 1, points, order);
}

}  // namespace

PlanarBox join(const PlanarBox& a, const PlanarBox& b) noexcept {
  PlanarBox both = a.is_empty ? b : a;
  if (!a.is_empty && !b.is_empty) {
    for (std::size_t k = 0; k < 2; ++k) {
      both.low[k] = std::min(a.low[k], b.low[k]);
      both.high[k] = std::max(a.high[k], b.high[k]);
    }
  }
  both.bad_count = a.bad_count + b.bad_count;
  both.bad = a.bad_count == 0 ? b.bad : b.bad_count == 0 ? a.bad : std::min(a.bad, b.bad);
  return both;
}

bool is_usable(double coordinate) noexcept {
  const double size = std::abs(coordinate);
  static_assert(kMaxExponent == 200);
  return size == 0 || (size >= 0x1p-200 && size <= 0x1p200);
}

PlanarBox find_planar_box(IndexRange range, const Point2* points) noexcept {
  PlanarBox box{};
  if (range.size() <= 0) return box;
  box.low = points[range.begin];
  box.high = box.low;
  box.is_empty = false;
  for (Index i = range.begin; i < range.end; ++i) {
    const Point2& p = points[i];
    if (!is_usable(p[0]) || !is_usable(p[1])) {
      if (box.bad_count++ == 0) box.bad = i;
    }
    for (std::size_t k = 0; k < 2; ++k) {
      box.low[k] = p[k] < box.low[k] ? p[k] : box.low[k];
      box.high[k] = p[k] > box.high[k] ? p[k] : box.high[k];
    }
  }
  return box;
}

PlanarLattice::PlanarLattice(const PlanarBox& box, Index point_count) noexcept : low(box.low) {
  const auto cells = static_cast<std::uint64_t>(point_count) / 2;
  bits = std::min(kMaxBits, static_cast<unsigned>(std::bit_width(cells)) / 2);
  for (std::size_t k = 0; k < 2; ++k) {
    cells_per_unit[k] = kernels::cells_per_unit(box.high[k] - box.low[k], bits);
  }
}

std::uint64_t PlanarLattice::key(const Point2& point) const noexcept {
  const std::int64_t last = (std::int64_t{1} << bits) - 1;
  const auto cell = [&](std::size_t k) {
    const auto number = static_cast<std::int64_t>((point[k] - low[k]) * cells_per_unit[k]);
    return static_cast<std::uint64_t>(std::min(number, last));
  };
  return spread_by_two(cell(0)) | spread_by_two(cell(1)) << 1U;
}

void fill_planar_keys(IndexRange range, const Point2* points, const PlanarLattice& lattice,
                      KeyedItem* items) noexcept {
  for (Index i = range.begin; i < range.end; ++i) items[i] = {lattice.key(points[i]), i};
}

Index order_cell(IndexRange range, const Point2* points, Index* order) noexcept {
  std::sort(order + range.begin, order + range.end, BeforeByX{points});
  Index repeated = 0;
  for (Index i = range.begin + 1; i < range.end; ++i) {
    repeated += points[order[i]] == points[order[i - 1]] ? 1 : 0;
  }
  return repeated;
}

void order_as_tree(IndexRange range, const Point2* points, Index* order) noexcept {
  order_level(range, 0, points, order);
}

}  // namespace hedgerow::kernels
