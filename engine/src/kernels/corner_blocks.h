#pragma once

#include "kernels/for_each_corner.h"

/// Partition of all corners by blocks of vertices.
namespace hedgerow::kernels {

/// A corner on its way to its vertex.
struct LooseCorner {
  Index vertex;
  Corner corner;
};

/// The same of a triangle, whose `incoming` is arithmetic.
struct LooseTriangleCorner {
  Index vertex;
  Index halfedge;
  Index target;
  Index source;
};
static_assert(sizeof(LooseTriangleCorner) == 4 * sizeof(Index));

/// First pass: adds to counts[b] the corners in the faces of `range` whose vertex lies in block b
/// of 2^block_shift vertices.
void count_blocks(IndexRange range, const FaceColumns& faces, int block_shift,
                  Index* counts) noexcept;

/// Second pass: writes them to loose[ends[b]++]. Ranges with `ends` of their own, counted by the
/// first pass, write disjoint elements.
void partition_corners(IndexRange range, const FaceColumns& faces, int block_shift, Index* ends,
                       LooseCorner* loose) noexcept;
/// \pre faces.is_triangles()
void partition_corners(IndexRange range, const FaceColumns& faces, int block_shift, Index* ends,
                       LooseTriangleCorner* loose) noexcept;

/// Turns counts[0 .. n) into the exclusive prefix sums, and returns the total.
Index exclusive_scan(Index* counts, Index n) noexcept;

}  // namespace hedgerow::kernels
