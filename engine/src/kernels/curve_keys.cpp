// Hilbert: J. Skilling, "Programming the Hilbert curve", 2004: undo the rotations and reflections
// of the coordinates from the largest cube down, then take the result out of Gray code.

#include "kernels/curve_keys.h"

#include <algorithm>
#include <cmath>

namespace hedgerow::kernels {

namespace {

constexpr std::uint32_t kLastCell = (1U << kBitsPerAxis) - 1;

bool is_finite(const float* xyz) noexcept {
  return std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]);
}

// Moves bit i to bit 3 i, of the 21 low bits.
std::uint64_t spread_by_three(std::uint64_t x) noexcept {
  x = (x | x << 32U) & 0x001f00000000ffffU;
  x = (x | x << 16U) & 0x001f0000ff0000ffU;
  x = (x | x << 8U) & 0x100f00f00f00f00fU;
  x = (x | x << 4U) & 0x10c30c30c30c30c3U;
  x = (x | x << 2U) & 0x1249249249249249U;
  return x;
}

}  // namespace

Box join(const Box& a, const Box& b) noexcept {
  if (a.is_empty) return b;
  if (b.is_empty) return a;
  Box both = a;
  for (std::size_t k = 0; k < 3; ++k) {
    both.low[k] = std::min(a.low[k], b.low[k]);
    both.high[k] = std::max(a.high[k], b.high[k]);
  }
  return both;
}

Box find_box(IndexRange range, const Positions& positions) noexcept {
  Box box;
  for (Index v = range.begin; v < range.end; ++v) {
    const float* p = positions[v];
    if (!is_finite(p)) continue;
    box = join(box, Box{{p[0], p[1], p[2]}, {p[0], p[1], p[2]}, false});
  }
  return box;
}

Lattice::Lattice(const Box& box) noexcept {
  if (box.is_empty) return;
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = static_cast<double>(box.low[k]);
    extent = std::max(extent, static_cast<double>(box.high[k]) - low[k]);
  }
  if (extent > 0) cells_per_unit = static_cast<double>(kLastCell) / extent;
}

Cell Lattice::cell(const float* xyz) const noexcept {
  if (!is_finite(xyz)) return {kLastCell, kLastCell, kLastCell};
  Cell cell{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double place = (static_cast<double>(xyz[k]) - low[k]) * cells_per_unit;
    cell[k] = std::min(kLastCell, static_cast<std::uint32_t>(place));
  }
  return cell;
}

std::uint64_t morton_key(Cell cell) noexcept {
  return spread_by_three(cell[0]) << 2U | spread_by_three(cell[1]) << 1U | spread_by_three(cell[2]);
}

std::uint64_t hilbert_key(Cell cell) noexcept {
  for (std::uint32_t side = 1U << (kBitsPerAxis - 1); side > 1; side >>= 1U) {
    const std::uint32_t below = side - 1;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((cell[k] & side) != 0) {
        cell[0] ^= below;
      } else {
        const std::uint32_t exchanged = (cell[0] ^ cell[k]) & below;
        cell[0] ^= exchanged;
        cell[k] ^= exchanged;
      }
    }
  }
  cell[1] ^= cell[0];
  cell[2] ^= cell[1];
  std::uint32_t flips = 0;
  for (std::uint32_t side = 1U << (kBitsPerAxis - 1); side > 1; side >>= 1U) {
    if ((cell[2] & side) != 0) flips ^= side - 1;
  }
  for (std::uint32_t& c : cell) c ^= flips;
  return morton_key(cell);
}

void fill_curve_keys(IndexRange range, const Positions& positions, const Lattice& lattice,
                     CurveKey* key_of, KeyedItem* items) noexcept {
  for (Index v = range.begin; v < range.end; ++v) {
    items[v] = {key_of(lattice.cell(positions[v])), v};
  }
}

}  // namespace hedgerow::kernels
