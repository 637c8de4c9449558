#pragma once

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/record_column.h"
#include "hedgerow/result.h"
#include "hedgerow/topology.h"

namespace hedgerow {

/// One directed edge: what cannot be computed from its number.
struct DirectedEdge {
  VertexId start;
  HalfedgeId neighbour;  ///< on the other side; invalid: boundary

  friend constexpr bool operator==(const DirectedEdge&, const DirectedEdge&) noexcept = default;
};

/// A triangle mesh as one array of records, after S. Campagna, L. Kobbelt and H.-P. Seidel,
/// "Directed edges: a scalable representation for triangle meshes", 1998, in the size between their
/// full and their small one. It is the default view of the core with both columns in one record:
/// the row of the benchmark that shows what records cost. Move-only.
///
/// Layout     Directed edge 3f + k leaves corner k of face f; next, previous and face of it are
///            arithmetic.
/// Fans       As in the core.
/// Memory     26 bytes a triangle on a closed mesh.
struct DirectedEdges {
  Buffer<DirectedEdge> edges;
  Buffer<HalfedgeId> vertex_edge;  ///< a directed edge that leaves each vertex; invalid: isolated
  Buffer<FanStart> fans;
  Form form = Form::open;  ///< of the mesh that it was made from, to go back to

  [[nodiscard]] Index vertex_count() const noexcept {
    return static_cast<Index>(vertex_edge.size());
  }
  [[nodiscard]] Index edge_count() const noexcept { return static_cast<Index>(edges.size()); }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return edges.size_bytes() + vertex_edge.size_bytes() + fans.size_bytes();
  }
};

/// The directed edges of a triangle mesh in either form, with its numbers.
///
/// Pre        `mesh` is sound, as `validate` says.
/// Complexity O(V + H). Bytes: reads 26 and writes 26 a triangle; a closed mesh is opened first.
/// Errors     not_triangles; not_canonical: dangling edges. Throws std::bad_alloc.
/// Threads    Those of `execution`; same bytes for all of them.
/// Lifetime   The result shares nothing with `mesh`.
[[nodiscard]] Result<DirectedEdges> build_directed_edges(const Connectivity& mesh,
                                                         const Execution& execution);

/// The mesh of directed edges, to the last byte that which they were made from.
///
/// Pre        None for the entries, which are not followed: `validate` looks at the result. Edges
///            of a mesh in the closed form have to be sound.
/// Errors     count_mismatch: value = directed edges, limit = the multiple of three below. Throws
///            std::bad_alloc.
/// Complexity, threads, lifetime   As above.
[[nodiscard]] Result<Connectivity> build_connectivity(const DirectedEdges& edges,
                                                      const Execution& execution);

/// Directed edges as a `Topology`, in the default form, with the same numbers.
///
/// Cost       Each step O(1).
/// Pre        The mesh of the edges is sound.
/// Lifetime   Valid until the edges are changed, moved or destroyed.
/// Threads    Any number of concurrent readers; no writer beside them.
struct DirectedEdgeView {
  explicit DirectedEdgeView(const DirectedEdges& edges) noexcept
      : origin{edges.edges.data()},
        opposite{edges.edges.data()},
        outgoing{edges.vertex_edge.data()},
        fans(edges.fans.span()),
        table(&edges) {}

  MemberColumn<HalfedgeId, &DirectedEdge::start, DirectedEdge> origin;
  MemberColumn<HalfedgeId, &DirectedEdge::neighbour, DirectedEdge> opposite;
  IdColumn<VertexId, HalfedgeId> outgoing;
  FanTable fans;
  const DirectedEdges* table;

  [[nodiscard]] Index vertex_count() const noexcept { return table->vertex_count(); }
  [[nodiscard]] Index halfedge_count() const noexcept { return table->edge_count(); }
  [[nodiscard]] Index face_count() const noexcept { return table->edge_count() / 3; }

  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept {
    return HalfedgeId(is_corner(h, 2) ? h.value - 2 : h.value + 1);
  }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept {
    return HalfedgeId(is_corner(h, 0) ? h.value + 2 : h.value - 1);
  }
  [[nodiscard]] VertexId target(HalfedgeId h) const noexcept { return origin[next(h)]; }
  [[nodiscard]] FaceId face(HalfedgeId h) const noexcept { return FaceId(h.value / 3); }
  [[nodiscard]] HalfedgeId first(FaceId f) const noexcept { return HalfedgeId(3 * f.value); }
  [[nodiscard]] Index degree(FaceId) const noexcept { return 3; }

 private:
  [[nodiscard]] static bool is_corner(HalfedgeId h, unsigned k) noexcept {
    return static_cast<std::make_unsigned_t<Index>>(h.value) % 3 == k;
  }
};

static_assert(Topology<DirectedEdgeView>);

}  // namespace hedgerow
