#pragma once

#include <span>

#include "kernels/face_columns.h"

/// Bringing the corners of each vertex together, one block of vertices at a time.
namespace hedgerow::kernels {

/// One corner of a vertex v: the half-edge that leaves v and the one that enters v in its face.
struct Corner {
  Index halfedge;  ///< v -> target
  Index target;
  Index source;
  Index incoming;  ///< source -> v, the half-edge before `halfedge`
};

/// A corner on its way to its vertex. `incoming` is arithmetic for triangles but not for polygons.
struct LooseCorner {
  Index vertex;
  Corner corner;
};

/// Vertices [begin, begin + size) of one block.
struct VertexBlock {
  Index begin = 0;
  Index size = 0;
};

/// Adds to counts[v - block.begin] the number of corners of v in the faces of `range`.
void count_corners(IndexRange range, const FaceColumns& faces, VertexBlock block,
                   Index* counts) noexcept;

/// Writes those corners to corners[ends[v - block.begin]++], in ascending half-edge order.
void place_corners(IndexRange range, const FaceColumns& faces, VertexBlock block, Index* ends,
                   Corner* corners) noexcept;

/// The same two for loose corners, which all belong to the block.
void count_loose(std::span<const LooseCorner> loose, VertexBlock block, Index* counts) noexcept;
void place_loose(std::span<const LooseCorner> loose, VertexBlock block, Index* ends,
                 Corner* corners) noexcept;

/// Partition, first pass: adds to counts[b] the corners in the faces of `range` whose vertex lies
/// in block b of 2^block_shift vertices.
void count_blocks(IndexRange range, const FaceColumns& faces, int block_shift,
                  Index* counts) noexcept;

/// Partition, second pass: writes them to loose[ends[b]++]. Ranges with `ends` of their own,
/// counted by the first pass, write disjoint elements.
void partition_corners(IndexRange range, const FaceColumns& faces, int block_shift, Index* ends,
                       LooseCorner* loose) noexcept;

/// Turns counts[0 .. n) into the exclusive prefix sums, and returns the total.
Index exclusive_scan(Index* counts, Index n) noexcept;

}  // namespace hedgerow::kernels
