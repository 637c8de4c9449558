#pragma once

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/numbered_mesh.h"
#include "hedgerow/record_column.h"
#include "hedgerow/result.h"
#include "hedgerow/topology.h"

namespace hedgerow {

/// One end of an edge: the record of a vertex and an edge, linked round the vertex. In the dual
/// mesh, where vertices are faces, this is the record of a half-edge.
struct SplitEdge {
  VertexId vertex;
  FaceId face;           ///< counter-clockwise of the edge, seen from the vertex; invalid: none
  HalfedgeId clockwise;  ///< the next end at the same vertex
  HalfedgeId counter_clockwise;
  HalfedgeId opposite;  ///< the other end of the edge

  friend constexpr bool operator==(const SplitEdge&, const SplitEdge&) noexcept = default;
};

/// A mesh as split edges: the half-edge of D. Muller and F. Preparata, 1978, with the parts of
/// vertices and faces exchanged. Rings round vertices are read from the records as they stand,
/// faces by going to the other end and round there. Move-only.
///
/// Boundary   Explicit, for an edge has two ends even if it has one face.
/// Numbering  An end has the number of the half-edge that leaves its vertex.
/// Fans       Each is a ring of its own; `vertex_edge` is in that with the smallest half-edge.
/// Memory     64 bytes a triangle on a closed mesh.
struct SplitEdges {
  Buffer<SplitEdge> ends;
  Buffer<HalfedgeId> vertex_edge;  ///< an end at each vertex; invalid: isolated
  Buffer<HalfedgeId> face_edge;    ///< an end with each face
  Buffer<FanStart> fans;
  Form form = Form::closed;  ///< of the mesh that it was made from, to go back to

  [[nodiscard]] Index vertex_count() const noexcept {
    return static_cast<Index>(vertex_edge.size());
  }
  [[nodiscard]] Index end_count() const noexcept { return static_cast<Index>(ends.size()); }
  [[nodiscard]] Index face_count() const noexcept { return static_cast<Index>(face_edge.size()); }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return ends.size_bytes() + vertex_edge.size_bytes() + face_edge.size_bytes() +
           fans.size_bytes();
  }
};

/// The split edges of any mesh, in the closed form and with its numbers; a mesh in the default form
/// is closed first, as by `close_boundary`.
///
/// Pre        `mesh` is sound, as `validate` says.
/// Complexity O(V + H). Bytes: reads 4 and writes 5 indices a half-edge.
/// Errors     Those of `close_boundary`. Throws std::bad_alloc.
/// Threads    Those of `execution`; same bytes for all of them.
/// Lifetime   The result shares nothing with `mesh`.
[[nodiscard]] Result<SplitEdges> build_split_edges(const Connectivity& mesh,
                                                   const Execution& execution);

/// The half-edges of split edges, numbered as those of a DCEL are, see dcel.h: all that
/// `build_split_edges` made comes back to the last byte, in the form it had.
///
/// Complexity O(V + H), on the calling thread.
/// Errors     index_out_of_range, inconsistent_table, too_few_corners: as for a DCEL. Throws
///            std::bad_alloc.
[[nodiscard]] Result<NumberedMesh> build_connectivity(const SplitEdges& edges);

/// Split edges as a `Topology`, in the closed form, with the same numbers.
///
/// Cost       Each step O(1): round a vertex it reads one record, round a face two. `degree(f)`
///            O(sides).
/// Pre        The mesh of the edges is sound.
/// Lifetime   Valid until the edges are changed, moved or destroyed.
/// Threads    Any number of concurrent readers; no writer beside them.
struct SplitEdgeView {
  explicit SplitEdgeView(const SplitEdges& edges) noexcept
      : origin{edges.ends.data()},
        opposite{edges.ends.data()},
        outgoing{edges.vertex_edge.data()},
        fans(edges.fans.span()),
        table(&edges) {}

  MemberColumn<HalfedgeId, &SplitEdge::vertex, SplitEdge> origin;
  MemberColumn<HalfedgeId, &SplitEdge::opposite, SplitEdge> opposite;
  IdColumn<VertexId, HalfedgeId> outgoing;
  FanTable fans;
  const SplitEdges* table;

  [[nodiscard]] Index vertex_count() const noexcept { return table->vertex_count(); }
  [[nodiscard]] Index halfedge_count() const noexcept { return table->end_count(); }
  [[nodiscard]] Index face_count() const noexcept { return table->face_count(); }

  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept {
    return end(end(h).opposite).clockwise;
  }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept {
    return end(end(h).counter_clockwise).opposite;
  }
  [[nodiscard]] VertexId target(HalfedgeId h) const noexcept { return origin[opposite[h]]; }
  [[nodiscard]] FaceId face(HalfedgeId h) const noexcept { return end(h).face; }
  [[nodiscard]] HalfedgeId first(FaceId f) const noexcept {
    return table->face_edge.data()[f.value];
  }
  [[nodiscard]] Index degree(FaceId f) const noexcept {
    Index count = 0;
    HalfedgeId h = first(f);
    do {
      ++count;
      h = next(h);
    } while (h != first(f));
    return count;
  }

 private:
  [[nodiscard]] const SplitEdge& end(HalfedgeId h) const noexcept {
    return origin.records[h.value];
  }
};

static_assert(Topology<SplitEdgeView>);

}  // namespace hedgerow
