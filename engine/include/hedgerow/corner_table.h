#pragma once

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/record_column.h"
#include "hedgerow/result.h"
#include "hedgerow/topology.h"

namespace hedgerow {

/// A triangle mesh by its corners, after J. Rossignac, A. Safonova and A. Szymczak, "3D compression
/// made simple: Edgebreaker with zip&wrap on a corner-table", 2001. Move-only.
///
/// Layout     Corner 3t + k is corner k of triangle t, counter-clockwise. Two corners are opposite
///            if they face the same edge from its two sides: corner c faces the edge between its
///            next and its previous corner.
/// Fans       As in the core: `corner` is where the clockwise rotation of the vertex starts, and
///            further fans of it stand in `fans`, by the half-edge with the number of the corner.
/// Memory     6 indices a triangle and one a vertex: 26 bytes a triangle on a closed mesh.
struct CornerTable {
  Buffer<VertexId> vertex;    ///< of each corner
  Buffer<CornerId> opposite;  ///< of each corner; invalid: the edge it faces is on the boundary
  Buffer<CornerId> corner;    ///< a corner at each vertex; invalid: isolated
  Buffer<FanStart> fans;
  Form form = Form::open;  ///< of the mesh that it was made from, to go back to

  [[nodiscard]] static constexpr CornerId next(CornerId c) noexcept {
    return CornerId(c.value % 3 == 2 ? c.value - 2 : c.value + 1);
  }
  [[nodiscard]] static constexpr CornerId prev(CornerId c) noexcept {
    return CornerId(c.value % 3 == 0 ? c.value + 2 : c.value - 1);
  }
  [[nodiscard]] static constexpr FaceId triangle(CornerId c) noexcept {
    return FaceId(c.value / 3);
  }
  /// The corner at the same vertex in the triangle clockwise of it; invalid at the boundary.
  [[nodiscard]] CornerId swing_right(CornerId c) const noexcept {
    const CornerId across = opposite[static_cast<std::size_t>(prev(c).value)];
    return across.valid() ? prev(across) : across;
  }
  /// The same counter-clockwise.
  [[nodiscard]] CornerId swing_left(CornerId c) const noexcept {
    const CornerId across = opposite[static_cast<std::size_t>(next(c).value)];
    return across.valid() ? next(across) : across;
  }

  [[nodiscard]] Index vertex_count() const noexcept { return static_cast<Index>(corner.size()); }
  [[nodiscard]] Index corner_count() const noexcept { return static_cast<Index>(vertex.size()); }
  [[nodiscard]] Index triangle_count() const noexcept { return corner_count() / 3; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return vertex.size_bytes() + opposite.size_bytes() + corner.size_bytes() + fans.size_bytes();
  }
};

/// The corner table of a triangle mesh in either form: corner h is that which half-edge h leaves.
///
/// Pre        `mesh` is sound, as `validate` says.
/// Complexity O(V + H). Bytes: reads 26 and writes 26 a triangle; a closed mesh is opened first.
/// Errors     not_triangles; not_canonical: dangling edges. Throws std::bad_alloc.
/// Threads    Those of `execution`; same bytes for all of them.
/// Lifetime   The result shares nothing with `mesh`.
[[nodiscard]] Result<CornerTable> build_corner_table(const Connectivity& mesh,
                                                     const Execution& execution);

/// The mesh of a corner table, to the last byte that which the table was made from.
///
/// Pre        None for the entries, which are not followed: `validate` looks at the result. A table
///            of the closed form has to be sound.
/// Complexity As above.
/// Errors     count_mismatch: value = opposite corners, limit = corners; or value = corners, limit
///            = the multiple of three below. Throws std::bad_alloc.
/// Threads, lifetime   As above.
[[nodiscard]] Result<Connectivity> build_connectivity(const CornerTable& table,
                                                      const Execution& execution);

/// A corner table as a `Topology`, in the default form: half-edge h leaves corner h.
///
/// Cost       Each step O(1). `opposite` turns the corner it faces into a half-edge by arithmetic.
/// Pre        The mesh of the table is sound.
/// Lifetime   Valid until the table is changed, moved or destroyed.
/// Threads    Any number of concurrent readers; no writer beside them.
struct CornerTableView {
  struct Opposites {
    const CornerId* corners = nullptr;
    HalfedgeId operator[](HalfedgeId h) const noexcept {
      const CornerId across = corners[CornerTable::prev(CornerId(h.value)).value];
      return HalfedgeId(across.valid() ? CornerTable::next(across).value : kInvalidIndex);
    }
  };
  struct Outgoing {
    const CornerId* corners = nullptr;
    HalfedgeId operator[](VertexId v) const noexcept { return HalfedgeId(corners[v.value].value); }
  };

  explicit CornerTableView(const CornerTable& corners) noexcept
      : origin{corners.vertex.data()},
        opposite{corners.opposite.data()},
        outgoing{corners.corner.data()},
        fans(corners.fans.span()),
        table(&corners) {}

  IdColumn<HalfedgeId, VertexId> origin;
  Opposites opposite;
  Outgoing outgoing;
  FanTable fans;
  const CornerTable* table;

  [[nodiscard]] Index vertex_count() const noexcept { return table->vertex_count(); }
  [[nodiscard]] Index halfedge_count() const noexcept { return table->corner_count(); }
  [[nodiscard]] Index face_count() const noexcept { return table->triangle_count(); }

  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept {
    return HalfedgeId(CornerTable::next(CornerId(h.value)).value);
  }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept {
    return HalfedgeId(CornerTable::prev(CornerId(h.value)).value);
  }
  [[nodiscard]] VertexId target(HalfedgeId h) const noexcept { return origin[next(h)]; }
  [[nodiscard]] FaceId face(HalfedgeId h) const noexcept { return FaceId(h.value / 3); }
  [[nodiscard]] HalfedgeId first(FaceId f) const noexcept { return HalfedgeId(3 * f.value); }
  [[nodiscard]] Index degree(FaceId) const noexcept { return 3; }
};

static_assert(Topology<CornerTableView>);

}  // namespace hedgerow
