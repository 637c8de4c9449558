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

/// One half-edge with all that it is next to.
struct DcelHalfedge {
  VertexId origin;
  HalfedgeId opposite;
  FaceId face;  ///< invalid: outside of the surface
  HalfedgeId next;
  HalfedgeId prev;

  friend constexpr bool operator==(const DcelHalfedge&, const DcelHalfedge&) noexcept = default;
};

/// A mesh as a doubly connected edge list: D. Muller and F. Preparata, "Finding the intersection of
/// two convex polyhedra", 1978; the records are those of M. de Berg et al., "Computational
/// Geometry", chapter 2. Move-only.
///
/// Boundary   Explicit: every half-edge has an opposite, and those without a face run round the
///            holes and along both sides of dangling edges.
/// Numbering  Any: the half-edges of a face need not follow each other.
/// Fans       A half-edge for each vertex, as in the book; further fans of a vertex may be listed.
/// Memory     5 indices a half-edge, one a vertex and one a face: 64 bytes a triangle on a closed
///            mesh.
struct Dcel {
  Buffer<DcelHalfedge> halfedges;
  Buffer<HalfedgeId> vertex_halfedge;  ///< one that leaves each vertex; invalid: isolated
  Buffer<HalfedgeId> face_halfedge;    ///< one of each face
  Buffer<FanStart> fans;
  Form form = Form::closed;  ///< of the mesh that it was made from, to go back to

  [[nodiscard]] Index vertex_count() const noexcept {
    return static_cast<Index>(vertex_halfedge.size());
  }
  [[nodiscard]] Index halfedge_count() const noexcept {
    return static_cast<Index>(halfedges.size());
  }
  [[nodiscard]] Index face_count() const noexcept {
    return static_cast<Index>(face_halfedge.size());
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return halfedges.size_bytes() + vertex_halfedge.size_bytes() + face_halfedge.size_bytes() +
           fans.size_bytes();
  }
};

/// The records of any mesh, in the closed form and with its numbers; a mesh in the default form is
/// closed first, as by `close_boundary`.
///
/// Pre        `mesh` is sound, as `validate` says.
/// Complexity O(V + H). Bytes: reads 4 and writes 5 indices a half-edge.
/// Errors     Those of `close_boundary`. Throws std::bad_alloc.
/// Threads    Those of `execution`; same bytes for all of them.
/// Lifetime   The result shares nothing with `mesh`.
[[nodiscard]] Result<Dcel> build_dcel(const Connectivity& mesh, const Execution& execution);

/// The half-edges of the records. Records with the half-edges of each face in a row, face by face,
/// keep their numbers, and all that `build_dcel` made comes back to the last byte, in the form it
/// had; otherwise each face begins at its own half-edge, the boundary loops follow, and
/// `halfedge_of_record` says where each record went. Where records start the rotation of a vertex
/// does not matter; fans that are not listed are found.
///
/// Complexity O(V + H), on the calling thread.
/// Errors     index_out_of_range: element = the first record with an entry that is none, value =
///            the entry, limit = the count; inconsistent_table: element = the first record that
///            another contradicts, value = what that one has, limit = what it should have;
///            too_few_corners. Throws std::bad_alloc.
[[nodiscard]] Result<NumberedMesh> build_connectivity(const Dcel& dcel);

/// A DCEL as a `Topology`, in the closed form, with the same numbers.
///
/// Cost       Each step O(1), and reads one record; `degree(f)` O(sides).
/// Pre        The records are sound, and start each rotation where invariant I6 has it, as those
///            made by `build_dcel` do.
/// Lifetime   Valid until the records are changed, moved or destroyed.
/// Threads    Any number of concurrent readers; no writer beside them.
struct DcelView {
  explicit DcelView(const Dcel& dcel) noexcept
      : origin{dcel.halfedges.data()},
        opposite{dcel.halfedges.data()},
        outgoing{dcel.vertex_halfedge.data()},
        fans(dcel.fans.span()),
        table(&dcel) {}

  MemberColumn<HalfedgeId, &DcelHalfedge::origin, DcelHalfedge> origin;
  MemberColumn<HalfedgeId, &DcelHalfedge::opposite, DcelHalfedge> opposite;
  IdColumn<VertexId, HalfedgeId> outgoing;
  FanTable fans;
  const Dcel* table;

  [[nodiscard]] Index vertex_count() const noexcept { return table->vertex_count(); }
  [[nodiscard]] Index halfedge_count() const noexcept { return table->halfedge_count(); }
  [[nodiscard]] Index face_count() const noexcept { return table->face_count(); }

  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept { return record(h).next; }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept { return record(h).prev; }
  [[nodiscard]] VertexId target(HalfedgeId h) const noexcept { return origin[opposite[h]]; }
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
  [[nodiscard]] const DcelHalfedge& record(HalfedgeId h) const noexcept {
    return origin.records[h.value];
  }
};

static_assert(Topology<DcelView>);

}  // namespace hedgerow
