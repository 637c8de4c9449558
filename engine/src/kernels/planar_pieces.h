#pragma once

#include <cstdint>

#include "hedgerow/index.h"
#include "kernels/predicates.h"

/// Delaunay triangulation of points in the plane by halves: triangulate each, then join the two
/// along a line that separates them. After L. Guibas and J. Stolfi, "Primitives for the
/// manipulation of general subdivisions and the computation of Voronoi diagrams", 1985, with cuts
/// in both directions as R. Dwyer, "A faster divide-and-conquer algorithm for constructing Delaunay
/// triangulations", 1987.
///
/// Ranges     Points [begin, end) own the edges 3 begin .. 3 end - 1, which is more than a planar
///            graph on them can have. Ranges that do not overlap write disjoint memory.
namespace hedgerow::kernels {

/// One of the two directed sides of an edge: sides 2k and 2k + 1 are those of edge k.
struct Side {
  Index origin;  ///< a point; -1: the edge is free
  Index next;  ///< counter-clockwise round the origin; of a free edge's side 2k, the next free one
  Index prev;  ///< clockwise
  Index corner;  ///< the half-edge that the side becomes; see planar_faces.h
};

/// What the pieces of a triangulation share.
struct PlanarColumns {
  const Point2* points;       ///< distinct, in the order of their keys
  const std::uint64_t* keys;  ///< see planar_order.h
  Side* sides;                ///< 6 for each point
  Index* hull;                ///< of an extreme point of a piece: its side counter-clockwise along
                              ///< the hull, -1 if the piece is that point
};

/// The triangulation of a range of points. The corners are its extreme points.
struct Piece {
  Index low_x;   ///< smallest x, among those smallest y
  Index high_x;  ///< largest x, largest y
  Index low_y;   ///< smallest y, largest x
  Index high_y;  ///< largest y, smallest x
  Index free;    ///< list of its free edges: first
  Index last_free;
};

/// Where a range is cut in two. Below the keys, which end at cells, points are in the order of a
/// k-d tree of `depth` levels so far.
struct PlanarCut {
  Index at;
  bool is_by_y;  ///< else by x
  unsigned depth;
};

/// Points that are triangulated at once.
inline constexpr Index kSmallPiece = 3;

/// \pre range.size() >= 2
[[nodiscard]] PlanarCut cut_of(IndexRange range, unsigned depth,
                               const std::uint64_t* keys) noexcept;

/// Triangulates the points of a range that is not empty. O(n log n), less where they are spread
/// evenly; recursion as deep as the tree of cuts.
[[nodiscard]] Piece triangulate_range(IndexRange range, unsigned depth,
                                      const PlanarColumns& columns) noexcept;

/// Joins two pieces. \pre every point of `low` is before those of `high`: by x, then y; with
/// `is_by_y`, by y, then falling x.
[[nodiscard]] Piece join_pieces(const Piece& low, const Piece& high, bool is_by_y,
                                const PlanarColumns& columns) noexcept;

}  // namespace hedgerow::kernels
