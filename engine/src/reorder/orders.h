#pragma once

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/positions.h"

/// The orders that `reorder` offers, as permutations from new numbers to old ones.
namespace hedgerow::detail {

/// Vertices along a space-filling curve, those in one cell in old order.
[[nodiscard]] Buffer<Index> hilbert_vertices(const Positions& positions, Index vertex_count,
                                             const Execution& execution);
[[nodiscard]] Buffer<Index> morton_vertices(const Positions& positions, Index vertex_count,
                                            const Execution& execution);

/// Vertices by cells along a Z-order curve, 2^11 along the longest side of their box, those in one
/// cell in old order: half of the time where it need not be exact. The curve fills a box that
/// begins so many longest sides lower as `shift` says, so that it turns elsewhere.
[[nodiscard]] Buffer<Index> vertices_by_cells(const Positions& positions, Index vertex_count,
                                              const Execution& execution, float shift);

/// Vertices by breadth-first search over edges, components by their smallest vertex, isolated
/// vertices last.
[[nodiscard]] Buffer<Index> breadth_first_vertices(const Connectivity& mesh);

/// A numbering of the vertices, both ways.
struct VertexNumbers {
  Buffer<Index> new_to_old;
  Buffer<Index> old_to_new;
};

/// Vertices as `breadth_first_vertices` has them, in less time where neighbours lie close.
[[nodiscard]] VertexNumbers front_vertices(const Connectivity& mesh);

/// Faces by their smallest new vertex, those with the same one by their second, then in old order.
[[nodiscard]] Buffer<Index> faces_by_two_vertices(const Connectivity& mesh,
                                                  const Buffer<Index>& vertices_old_to_new,
                                                  const Execution& execution);

/// Faces such that most of their vertices are among the last few used.
[[nodiscard]] Buffer<Index> vertex_cache_faces(const Connectivity& mesh);

/// Vertices as the faces meet them, isolated ones last.
[[nodiscard]] Buffer<Index> vertices_by_first_use(const Connectivity& mesh,
                                                  const Buffer<Index>& faces_new_to_old);

/// Faces by their smallest new vertex, those with the same one in old order.
[[nodiscard]] Buffer<Index> faces_by_smallest_vertex(const Connectivity& mesh,
                                                     const Buffer<Index>& vertices_old_to_new,
                                                     const Execution& execution);

}  // namespace hedgerow::detail
