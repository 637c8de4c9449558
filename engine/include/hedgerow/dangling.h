#pragma once

#include <span>
#include <vector>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/result.h"

/// Edges without a face on either side, beside the faces of a mesh: wires, feature lines, the lines
/// of a drawing. They live in the closed form, where the walk round a hole passes along both sides
/// of them.
namespace hedgerow {

/// An edge as a caller has it.
struct EdgeVertices {
  VertexId from;
  VertexId to;

  friend constexpr bool operator==(const EdgeVertices&, const EdgeVertices&) noexcept = default;
};

struct DanglingOutput {
  Connectivity mesh;  ///< in the closed form
  /// Of each edge given: the half-edge that runs its way. For an edge that a face or an earlier
  /// edge has already it is that one, and nothing was added.
  Buffer<HalfedgeId> halfedge_of_edge;
  Index added_count = 0;
};

/// The mesh in the closed form with these edges added.
///
/// Numbering  All half-edges of the closed form keep their numbers. Each added edge gets the next
///            two, the first of which runs its way, in the order of the list.
/// Rotation   The added half-edges that leave a vertex follow each other, clockwise, by number.
///            They lie in the gap of the vertex's first open fan, before its boundary half-edge; at
///            a vertex without an open fan they are a fan of their own, the last one.
/// Pre        `mesh` is sound, as `validate` says; in either form.
/// Complexity O(V + H + n log n) for n edges, on the calling thread but for closing the boundary.
/// Errors     index_out_of_range: element = edge, value = the vertex, limit = the vertex count;
///            repeated_vertex: element = edge, value = the vertex; too_many_elements. `count` says
///            how many edges offend so. Throws std::bad_alloc.
/// Lifetime   The result shares nothing with `mesh`.
[[nodiscard]] Result<DanglingOutput> add_dangling_edges(const Connectivity& mesh,
                                                        std::span<const EdgeVertices> edges,
                                                        const Execution& execution);

/// The edges without a face, in the order of their smaller half-edge, which runs their way. O(H).
[[nodiscard]] std::vector<EdgeVertices> dangling_edges(const Connectivity& mesh);

/// The mesh without them, in the closed form: inverse of `add_dangling_edges`, to the last byte.
/// Half-edges that stay keep their order.
///
/// Pre        `mesh` is sound.
/// Complexity O(V + H), on the calling thread. Throws std::bad_alloc.
/// Errors     not_canonical: a half-edge without a face stands before those of the faces; element =
///            that one.
[[nodiscard]] Result<Connectivity> remove_dangling_edges(const Connectivity& mesh);

}  // namespace hedgerow
