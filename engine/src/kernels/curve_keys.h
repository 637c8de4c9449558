#pragma once

#include <array>
#include <cstdint>

#include "hedgerow/index.h"
#include "hedgerow/positions.h"
#include "kernels/radix.h"

/// Places along space-filling curves. Ranges that partition the vertices write disjoint elements:
/// those of their own vertices.
namespace hedgerow::kernels {

/// Smallest box round some points. Empty: nothing joined yet.
struct Box {
  std::array<float, 3> low;
  std::array<float, 3> high;
  bool is_empty = true;

  /// Exactly associative and commutative, but for the sign of a zero, which no key depends on.
  friend Box join(const Box& a, const Box& b) noexcept;
};

/// The box of the points in `range` whose coordinates are all finite.
[[nodiscard]] Box find_box(IndexRange range, const Positions& positions) noexcept;

inline constexpr unsigned kBitsPerAxis = 21;

using Cell = std::array<std::uint32_t, 3>;

/// Cubes of equal size that fill a box, 2^21 along its longest side.
struct Lattice {
  std::array<double, 3> low{};
  double cells_per_unit = 0;

  explicit Lattice(const Box& box) noexcept;
  /// The cube of a point; the last one on every axis if a coordinate is not finite.
  [[nodiscard]] Cell cell(const float* xyz) const noexcept;
};

/// Place of a cell on the Z-order curve: its bits interleaved, x the most significant.
[[nodiscard]] std::uint64_t morton_key(Cell cell) noexcept;

/// Place of a cell on the 3D Hilbert curve: consecutive keys are cells that share a side.
[[nodiscard]] std::uint64_t hilbert_key(Cell cell) noexcept;

using CurveKey = std::uint64_t(Cell) noexcept;

/// The vertices of `range` with their places on a curve.
void fill_curve_keys(IndexRange range, const Positions& positions, const Lattice& lattice,
                     CurveKey* key_of, KeyedItem* items) noexcept;

}  // namespace hedgerow::kernels
