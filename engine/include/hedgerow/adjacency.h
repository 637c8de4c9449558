#pragma once

#include <cstdint>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/record_column.h"
#include "hedgerow/result.h"
#include "hedgerow/topology.h"

/// Half-edges and faces without any vertices: which face lies where beside which other, and nothing
/// more. What needs no ids of vertices needs no more than this.
namespace hedgerow {

/// One half-edge, without the vertex that it leaves.
struct AdjacencyRecord {
  HalfedgeId opposite;  ///< invalid: boundary of the default form
  FaceId face;          ///< invalid: boundary half-edge of the closed form
  HalfedgeId next;
  HalfedgeId prev;

  friend constexpr bool operator==(const AdjacencyRecord&,
                                   const AdjacencyRecord&) noexcept = default;
};

/// The adjacency of faces. Move-only.
///
/// Form       Either: without half-edges outside of the faces, or with a loop round each hole.
/// Vertices   None are stored; there are as many as orbits of the rotation next[opposite[.]], so a
///            vertex with several fans is several, and isolated ones are forgotten.
/// Memory     4 indices a half-edge and one a face: 52 bytes a triangle.
struct Adjacency {
  Buffer<AdjacencyRecord> halfedges;
  Buffer<HalfedgeId> face_halfedge;  ///< the half-edges of face f begin here
  Form form = Form::open;

  [[nodiscard]] Index halfedge_count() const noexcept {
    return static_cast<Index>(halfedges.size());
  }
  [[nodiscard]] Index face_count() const noexcept {
    return static_cast<Index>(face_halfedge.size());
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return halfedges.size_bytes() + face_halfedge.size_bytes();
  }
};

/// The adjacency of a mesh, in its form and with its numbers.
///
/// Pre        `mesh` is sound, as `validate` says.
/// Complexity O(H). Bytes: reads opposite, and next and face where they are stored; writes four
///            indices a half-edge. Throws std::bad_alloc.
/// Threads    Those of `execution`; same bytes for all of them.
/// Lifetime   The result shares nothing with `mesh`.
[[nodiscard]] Adjacency build_adjacency(const Connectivity& mesh, const Execution& execution);

/// The mesh of an adjacency: to the last byte that which it was made from, if the vertices of that
/// had one fan each and were numbered by their smallest half-edge; else with these numbers. The
/// half-edges of each face are numbered in a row, as by `build_connectivity` of a DCEL.
///
/// Complexity O(H), on the calling thread.
/// Errors     index_out_of_range, inconsistent_table: element = the first record that is wrong or
///            that another contradicts, as in dcel.h; too_few_corners; too_many_elements. Throws
///            std::bad_alloc.
[[nodiscard]] Result<Connectivity> build_connectivity(const Adjacency& adjacency);

/// What follows from adjacency alone.
struct AdjacencySummary {
  std::int64_t vertices = 0;  ///< orbits of the rotation
  std::int64_t edges = 0;
  std::int64_t faces = 0;
  std::int64_t boundary_loops = 0;
  std::int64_t components = 0;  ///< sets of faces joined across edges; of dangling edges, of these

  [[nodiscard]] std::int64_t euler() const noexcept { return vertices - edges + faces; }
  /// Of all components together, if the surface is oriented: (2 components - loops - euler) / 2.
  [[nodiscard]] std::int64_t genus() const noexcept {
    return (2 * components - boundary_loops - euler()) / 2;
  }
};
/// O(H), on the calling thread. \pre `adjacency` is sound. Throws std::bad_alloc.
[[nodiscard]] AdjacencySummary summarise(const Adjacency& adjacency);

/// An adjacency as a `FaceTopology`: what circulate.h and query.h have to say about half-edges,
/// edges, faces and holes works on it as on any mesh.
///
/// Cost       Each step O(1), and reads one record; `degree(f)` O(sides).
/// Pre        The records are sound.
/// Lifetime   Valid until the records are changed, moved or destroyed.
/// Threads    Any number of concurrent readers; no writer beside them.
struct AdjacencyView {
  explicit AdjacencyView(const Adjacency& adjacency) noexcept
      : opposite{adjacency.halfedges.data()}, table(&adjacency) {}

  MemberColumn<HalfedgeId, &AdjacencyRecord::opposite, AdjacencyRecord> opposite;
  const Adjacency* table;

  [[nodiscard]] Index halfedge_count() const noexcept { return table->halfedge_count(); }
  [[nodiscard]] Index face_count() const noexcept { return table->face_count(); }
  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept { return record(h).next; }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept { return record(h).prev; }
  [[nodiscard]] FaceId face(HalfedgeId h) const noexcept { return record(h).face; }
  [[nodiscard]] HalfedgeId first(FaceId f) const noexcept {
    return table->face_halfedge.data()[f.value];
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
  [[nodiscard]] const AdjacencyRecord& record(HalfedgeId h) const noexcept {
    return opposite.records[h.value];
  }
};

static_assert(FaceTopology<AdjacencyView> && !Topology<AdjacencyView>);

}  // namespace hedgerow
