#pragma once

#include <cstdint>
#include <vector>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/index.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"
#include "hedgerow/topology.h"

namespace hedgerow {

/// One row of the edge table. The cw columns belong to the side of the edge that runs from `start`
/// to `end`, the ccw columns to the other: face_cw has the corners start, end in this order,
/// next_cw follows at `end` and prev_cw comes before at `start`; in face_ccw it is the other way
/// round. What does not exist is invalid.
struct WingedEdge {
  VertexId start;
  VertexId end;
  EdgeId prev_cw;
  EdgeId next_cw;
  EdgeId prev_ccw;
  EdgeId next_ccw;
  FaceId face_cw;
  FaceId face_ccw;

  friend constexpr bool operator==(const WingedEdge&, const WingedEdge&) noexcept = default;
};
static_assert(sizeof(WingedEdge) == 8 * sizeof(Index));

/// A two-manifold mesh as vertex, face and edge table, after B. Baumgart, "Winged edge polyhedron
/// representation", Stanford 1972. Move-only.
///
/// Sides      Side 2e of edge e runs from start to end, side 2e + 1 back. A side *exists* if it has
///            a face or links. Sides are numbered by `HalfedgeId`.
/// Boundary   A side without face has no links either (default form), or every such side has links
///            that lead round its hole, passing along both sides of dangling edges (closed form).
/// Memory     8 indices an edge, one a vertex and one a face, and the positions.
struct WingedEdgeTables {
  Buffer<float> xyz;           ///< three floats a vertex; empty: connectivity alone
  Buffer<EdgeId> vertex_edge;  ///< an edge at each vertex; invalid: isolated
  Buffer<EdgeId> face_edge;    ///< an edge of each face
  Buffer<WingedEdge> edges;

  [[nodiscard]] Index vertex_count() const noexcept {
    return static_cast<Index>(vertex_edge.size());
  }
  [[nodiscard]] Index face_count() const noexcept { return static_cast<Index>(face_edge.size()); }
  [[nodiscard]] Index edge_count() const noexcept { return static_cast<Index>(edges.size()); }
};

enum class WingedTable : std::uint8_t { vertices, faces, edges };
/// `edge` is the only column of references of the vertex and the face table.
enum class WingedColumn : std::uint8_t {
  edge,
  start,
  end,
  prev_cw,
  next_cw,
  prev_ccw,
  next_ccw,
  face_cw,
  face_ccw,
};
[[nodiscard]] const char* name(WingedTable table) noexcept;
[[nodiscard]] const char* name(WingedColumn column) noexcept;

/// One entry that contradicts the others; numbers from 0, -1 = none.
struct WingedFault {
  WingedTable table{};
  Index row = kInvalidIndex;
  WingedColumn column{};
  Index found = kInvalidIndex;
  Index expected = kInvalidIndex;  ///< what would agree with the rest of the tables

  friend constexpr bool operator==(const WingedFault&, const WingedFault&) noexcept = default;
};

/// The entries that contradict the rest, in the order of table, row and column; empty if the tables
/// are consistent. Ends of edges are looked at first, then the links, the faces, and the edges of
/// vertices and faces; of what is found, the first of these kinds is returned, since the others
/// would follow from it. One wrong entry among enough right ones is named, not its neighbours.
///
/// Pre        None: the entries may be any numbers. xyz.size() is 0 or 3 V.
/// Complexity O(V + E + F) where there is no fault, else O(n log n). Throws std::bad_alloc.
/// Threads    On the calling thread.
[[nodiscard]] std::vector<WingedFault> check_winged_edges(const WingedEdgeTables& tables);

/// What the tables know besides the half-edges, so that a way there and back changes no row.
struct WingedNumbering {
  Buffer<HalfedgeId> halfedge_of_side;  ///< 2 E; invalid where no half-edge exists
  Buffer<EdgeId> vertex_edge;           ///< V
};

/// The tables of a mesh, in its form: edges in the order of their smaller half-edge, which is their
/// side from start to end; the edge of a vertex is that of `outgoing`, that of a face of `first`.
/// `positions` are copied; without any (count 0) the tables have none.
///
/// Pre        `mesh` is sound, as `validate` says.
/// Complexity O(V + H), on the calling thread.
/// Errors     nonmanifold_vertex: a vertex record holds one fan; repeated_vertex: an edge from a
///            vertex to itself; too_many_elements: sides; count_mismatch, null_pointer: positions.
///            Throws std::bad_alloc.
[[nodiscard]] Result<WingedEdgeTables> build_winged_edges(const Connectivity& mesh,
                                                          Positions positions = {});
/// The same with the edges and the vertices' edges numbered as `build_connectivity` found them.
///
/// Pre        `numbering` is that of `mesh`.
[[nodiscard]] Result<WingedEdgeTables> build_winged_edges(const Connectivity& mesh,
                                                          const WingedNumbering& numbering,
                                                          Positions positions = {});

struct WingedHalfedges {
  Connectivity mesh;
  WingedNumbering numbering;
};

/// The half-edges of the tables, in their form: canonical (I8), each face beginning at its edge (at
/// side cw where it has both), holes numbered as by `close_boundary`. Inverse of
/// `build_winged_edges`, but for the numbers of boundary half-edges at dangling edges; a surface
/// without boundary, where the forms do not differ, comes back in the default one.
///
/// Complexity That of `check_winged_edges`; on the calling thread.
/// Errors     inconsistent_table: element, value and limit are row, found and expected of the first
///            fault; too_few_corners; nonmanifold_vertex: edges of a vertex that no rotation from
///            its own edge meets; element = the vertex, value = fans. Throws std::bad_alloc.
[[nodiscard]] Result<WingedHalfedges> build_connectivity(const WingedEdgeTables& tables);

/// Consistent tables as a `Topology`: the ranges of circulate.h and the questions of query.h about
/// single elements work on it as on any mesh. Half-edge numbers are sides, of which some may not
/// exist: `halfedge_count` is 2 E, and passes over all of them have to ask `has`.
///
/// Cost       Every step is O(1), but `degree(f)` O(sides) and `outgoing[v]` O(valence): in a table
///            a boundary vertex may have any of its edges.
/// Pre        `check_winged_edges` finds nothing, and each vertex has one fan.
/// Lifetime   Valid until the tables are changed, moved or destroyed.
/// Threads    Any number of concurrent readers; no writer beside them.
class WingedEdgeView {
 public:
  explicit WingedEdgeView(const WingedEdgeTables& tables) noexcept
      : origin{tables.edges.data()}, opposite{tables.edges.data()}, outgoing{&tables} {}

  struct Origins {
    const WingedEdge* edges;
    VertexId operator[](HalfedgeId s) const noexcept {
      const WingedEdge& edge = edges[s.value / 2];
      return s.value % 2 == 0 ? edge.start : edge.end;
    }
  } origin;
  struct Opposites {
    const WingedEdge* edges;
    HalfedgeId operator[](HalfedgeId s) const noexcept {
      const WingedEdge& edge = edges[s.value / 2];
      // The other side is in a face or in the walk round a hole, or it does not exist.
      const bool exists = s.value % 2 == 0 ? edge.next_ccw.valid() : edge.next_cw.valid();
      return exists ? HalfedgeId(s.value ^ 1) : HalfedgeId();
    }
  } opposite;
  struct Outgoing {
    const WingedEdgeTables* tables;
    HalfedgeId operator[](VertexId v) const noexcept;
  } outgoing;
  FanTable fans;

  [[nodiscard]] Index vertex_count() const noexcept { return outgoing.tables->vertex_count(); }
  [[nodiscard]] Index halfedge_count() const noexcept { return 2 * outgoing.tables->edge_count(); }
  [[nodiscard]] Index face_count() const noexcept { return outgoing.tables->face_count(); }
  /// Whether the side exists.
  [[nodiscard]] bool has(HalfedgeId s) const noexcept { return next_edge(s).valid(); }

  [[nodiscard]] HalfedgeId next(HalfedgeId s) const noexcept {
    return leaving(next_edge(s), target(s));
  }
  [[nodiscard]] HalfedgeId prev(HalfedgeId s) const noexcept {
    const WingedEdge& edge = edges()[s.value / 2];
    return HalfedgeId(leaving(s.value % 2 == 0 ? edge.prev_cw : edge.prev_ccw, origin[s]).value ^
                      1);
  }
  [[nodiscard]] VertexId target(HalfedgeId s) const noexcept {
    return origin[HalfedgeId(s.value ^ 1)];
  }
  [[nodiscard]] FaceId face(HalfedgeId s) const noexcept {
    const WingedEdge& edge = edges()[s.value / 2];
    return s.value % 2 == 0 ? edge.face_cw : edge.face_ccw;
  }
  [[nodiscard]] HalfedgeId first(FaceId f) const noexcept {
    const EdgeId e = outgoing.tables->face_edge[static_cast<std::size_t>(f.value)];
    return HalfedgeId(2 * e.value + (edges()[e.value].face_cw == f ? 0 : 1));
  }
  [[nodiscard]] Index degree(FaceId f) const noexcept {
    Index count = 0;
    HalfedgeId s = first(f);
    do {
      ++count;
      s = next(s);
    } while (s != first(f));
    return count;
  }

 private:
  [[nodiscard]] const WingedEdge* edges() const noexcept { return origin.edges; }
  [[nodiscard]] EdgeId next_edge(HalfedgeId s) const noexcept {
    const WingedEdge& edge = edges()[s.value / 2];
    return s.value % 2 == 0 ? edge.next_cw : edge.next_ccw;
  }
  // Which of its two sides a face uses follows from the vertex where it is met.
  [[nodiscard]] HalfedgeId leaving(EdgeId e, VertexId v) const noexcept {
    return HalfedgeId(2 * e.value + (edges()[e.value].start == v ? 0 : 1));
  }
};

static_assert(Topology<WingedEdgeView>);

}  // namespace hedgerow
