#pragma once

#include <cstddef>
#include <span>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/index.h"
#include "hedgerow/radial.h"
#include "hedgerow/result.h"

namespace hedgerow {

/// A face where it runs along an edge.
struct EdgeUse {
  FaceId face;
  HalfedgeId corner;  ///< the entry of the face table where it does, which is its half-edge
  HalfedgeId joined;  ///< the use that the surface goes on to across the edge; invalid: none

  friend constexpr bool operator==(const EdgeUse&, const EdgeUse&) noexcept = default;
};

/// The two vertices of an edge.
struct EdgeEnds {
  VertexId smaller;
  VertexId larger;

  friend constexpr bool operator==(const EdgeEnds&, const EdgeEnds&) noexcept = default;
};

/// Rows of any length in one array: row i is values[first[i]] .. values[first[i + 1] - 1].
template <class Key, class Value>
struct RowTable {
  Buffer<Index> first;  ///< one behind the last row, too
  Buffer<Value> values;

  [[nodiscard]] Index row_count() const noexcept { return static_cast<Index>(first.size()) - 1; }
  [[nodiscard]] std::span<const Value> operator[](Key key) const noexcept {
    const Index* ends = first.data() + key.value;
    return {values.data() + ends[0], static_cast<std::size_t>(ends[1] - ends[0])};
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return first.size_bytes() + values.size_bytes();
  }
};

/// Edges with any number of faces as records: the winged edge of B. Baumgart without its limit of
/// two faces, as K. Weiler, "The radial edge structure", 1988, has the faces round an edge. Every
/// answer about the neighbourhood of one element is a row of a table. Move-only.
///
/// Edges      One for each cycle of `RadialCycles`: all half-edges of faces between two vertices.
///            Numbered by their smallest half-edge. A cut edge is one edge again, whose uses are
///            not joined.
/// Order      `uses` in the cyclic order of the cycles, from the smallest half-edge on; the edges
///            and faces of a vertex ascending, a face once for each of its corners there.
/// Memory     12 bytes for each use of an edge, 4 for each entry of the other four tables and for
///            each row, 8 for the ends of an edge: 110 bytes a triangle on a closed mesh.
struct NonmanifoldEdges {
  Buffer<EdgeEnds> ends;                     ///< of each edge
  RowTable<EdgeId, EdgeUse> uses;            ///< faces round each edge
  RowTable<VertexId, EdgeId> vertex_edges;   ///< edges at each vertex
  RowTable<VertexId, FaceId> vertex_faces;   ///< faces at each vertex
  RowTable<FaceId, VertexId> face_vertices;  ///< corners of each face, counter-clockwise
  Buffer<EdgeId> face_edges;                 ///< of each corner: the edge that the face runs along

  [[nodiscard]] Index vertex_count() const noexcept { return vertex_edges.row_count(); }
  [[nodiscard]] Index edge_count() const noexcept { return static_cast<Index>(ends.size()); }
  [[nodiscard]] Index face_count() const noexcept { return face_vertices.row_count(); }
  /// The bounding edges of a face, in the order of its corners.
  [[nodiscard]] std::span<const EdgeId> edges_of(FaceId f) const noexcept {
    const Index* ends_of_row = face_vertices.first.data() + f.value;
    return {face_edges.data() + ends_of_row[0],
            static_cast<std::size_t>(ends_of_row[1] - ends_of_row[0])};
  }
  /// The other end of an edge at `v`.
  [[nodiscard]] VertexId other_end(EdgeId e, VertexId v) const noexcept {
    const EdgeEnds& edge = ends.data()[e.value];
    return edge.smaller == v ? edge.larger : edge.smaller;
  }
  [[nodiscard]] std::size_t bytes() const noexcept;
};

/// The records of a mesh in the default form.
///
/// Pre        `mesh` is sound, as `validate` says; `cycles` are those of `mesh`.
/// Complexity O(V + H), on the calling thread.
/// Errors     already_closed: half-edges without a face are no part of the records; `open_boundary`
///            takes them away. Throws std::bad_alloc.
/// Lifetime   The result shares nothing with `mesh`.
[[nodiscard]] Result<NonmanifoldEdges> build_nonmanifold_edges(const Connectivity& mesh,
                                                               const RadialCycles& cycles);

struct RadialMesh {
  Connectivity mesh;
  RadialCycles cycles;
};

/// The mesh and the cycles that the records were made from, to the last byte (a mesh of triangles
/// comes back implicit).
///
/// Complexity O(V + H), on the calling thread.
/// Errors     Of the uses and the face table, which are all that is read: count_mismatch;
///            bad_face_offsets; too_few_corners; index_out_of_range, element = the entry of the
///            face table or the number of the use; inconsistent_table, element = the entry of the
///            face table that has not exactly one use, value = how many it has, or that is not
///            joined to what is joined to it, value = what that one is joined to. Throws
///            std::bad_alloc.
[[nodiscard]] Result<RadialMesh> build_connectivity(const NonmanifoldEdges& edges);

}  // namespace hedgerow
