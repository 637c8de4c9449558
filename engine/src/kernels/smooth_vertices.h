#pragma once

#include <cstdint>

#include "hedgerow/index.h"
#include "hedgerow/positions.h"
#include "hedgerow/smooth.h"
#include "hedgerow/topology.h"
#include "kernels/normals_math.h"

/// One step of Laplacian smoothing.
namespace hedgerow::kernels {

/// From where to where; they may be the same array, which is then changed on the way.
struct SmoothStep {
  Positions from;
  MutablePositions to;
  float step;

  [[nodiscard]] Vec3<double> operator[](VertexId v) const noexcept {
    const float* p = from[v.value];
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
};

/// Its share of the mean for each number of neighbours; the same in all forms of the kernel.
[[nodiscard]] inline float umbrella_share(const SmoothStep& step, Index valence) noexcept {
  return step.step / static_cast<float>(valence);
}

/// Moves the vertices of a range, in ascending order. Reads those of their neighbours.
///
/// The sum of a ring runs clockwise from `outgoing`; that of the umbrella in float, with v - 1 in
/// the last place if it is in the ring (they change places): in a mesh in order that one has just
/// been moved, and what is added after it would wait for it. Again in double where the float sum
/// leads nowhere finite.
void smooth_vertices(IndexRange range, const TriangleView& mesh, const SmoothStep& step,
                     SmoothWeights weights) noexcept;
void smooth_vertices(IndexRange range, const PolygonView& mesh, const SmoothStep& step,
                     SmoothWeights weights) noexcept;

/// Neighbours of vertices in a row.
struct RingTable {
  static constexpr int kVertices = 32;
  static constexpr int kMostNeighbours = 8;

  Index neighbour[kMostNeighbours][kVertices];  ///< in the order of the sum
  Index valence[kVertices];
};

/// Fills the table for the vertices from `first` on; returns the bits of those that it holds: they
/// lie within one fan, closed, and have few neighbours. Whether they have other fans is not looked
/// at. None where the build has no AVX2.
/// \pre the processor has AVX2, and indices are 32 bits wide; see `simd_path`
[[nodiscard]] std::uint32_t find_rings_avx2(Index first, const TriangleView& mesh,
                                            RingTable& table) noexcept;
/// Moves vertices first + i for i in [begin, end), which the table holds, until one of them would
/// leave the finite numbers; returns i of that one, or `end`.
[[nodiscard]] int smooth_listed_avx2(Index first, int begin, int end, const RingTable& table,
                                     const SmoothStep& step) noexcept;

inline void copy_positions(IndexRange range, const Positions& from,
                           const MutablePositions& to) noexcept {
  for (Index v = range.begin; v < range.end; ++v) {
    for (int k = 0; k < 3; ++k) to[v][k] = from[v][k];
  }
}

}  // namespace hedgerow::kernels
