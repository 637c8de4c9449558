#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hedgerow/face_list.h"
#include "hedgerow/index.h"
#include "hedgerow/normals.h"
#include "hedgerow/positions.h"

namespace hedgerow::baselines {

/// The textbook winged-edge mesh, after B. Baumgart, "Winged edge polyhedron representation", 1972:
/// records of pointers, each allocated on its own with `new`, attributes inside the records, one
/// thread.
///
/// Layout     Edge 64 bytes, vertex 40, face 32, and what the allocator adds to each. An edge does
///            not say which way a face runs along it: a step compares its vertices.
/// Boundary   Default form: a side of an edge without face has no links.
/// Pairs, fans, threads   As `PointerHalfedgeMesh`; a half-edge without opposite is an edge of its
///            own.
class PointerWingedEdgeMesh {
 public:
  struct Edge;
  struct Vertex {
    float position[3];
    float normal[3];
    Edge* edge;  ///< its side that leaves this vertex starts the fan, if open; null: isolated
    Index id;
  };
  struct Face {
    float normal[3];
    float double_area;
    Edge* edge;  ///< the one that leaves the face's first corner
    Index id;
  };
  /// The cw links belong to the side that runs from start to end.
  struct Edge {
    Vertex* start;
    Vertex* end;
    Face* cw_face;
    Face* ccw_face;
    Edge* prev_cw;
    Edge* next_cw;
    Edge* prev_ccw;
    Edge* next_ccw;
  };
  /// One side of an edge: what a half-edge is elsewhere.
  struct Side {
    const Edge* edge = nullptr;
    bool is_ccw = false;

    friend bool operator==(const Side&, const Side&) noexcept = default;
  };

  /// Builds from a face list with a hash map on vertex pairs, expected O(H). Copies the positions.
  /// \pre as for `PointerHalfedgeMesh`.
  PointerWingedEdgeMesh(const FaceList& faces, Positions positions);

  [[nodiscard]] Index vertex_count() const noexcept { return static_cast<Index>(vertices_.size()); }
  [[nodiscard]] Index edge_count() const noexcept { return static_cast<Index>(edges_.size()); }
  [[nodiscard]] Index face_count() const noexcept { return static_cast<Index>(faces_.size()); }
  [[nodiscard]] const Vertex& vertex(Index v) const noexcept {
    return *vertices_[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] Vertex& vertex(Index v) noexcept { return *vertices_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] const Edge& edge(Index e) const noexcept {
    return *edges_[static_cast<std::size_t>(e)];
  }
  [[nodiscard]] const Face& face(Index f) const noexcept {
    return *faces_[static_cast<std::size_t>(f)];
  }

  // As of `PointerHalfedgeMesh`.
  void compute_face_normals();
  void compute_vertex_normals(NormalWeight weight);
  void fill_one_ring_sums(std::span<std::uint32_t> sums) const;
  [[nodiscard]] Index boundary_loop_count() const;
  [[nodiscard]] Index component_count() const;

  // For comparison with the engine's columns, in the order of the corners; not timed.
  [[nodiscard]] std::vector<Index> origin() const;
  [[nodiscard]] std::vector<Index> opposite() const;
  [[nodiscard]] std::vector<Index> outgoing() const;
  [[nodiscard]] std::vector<float> face_normals() const;    ///< three floats a face
  [[nodiscard]] std::vector<float> vertex_normals() const;  ///< three floats a vertex

  /// Bytes of the records and of the arrays that own them, without the allocator's own.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  [[nodiscard]] std::vector<Side> sides() const;
  void make_edges(const FaceList& faces, const std::vector<Index>& opposite);
  void choose_edges_of_vertices();

  std::vector<std::unique_ptr<Vertex>> vertices_;
  std::vector<std::unique_ptr<Edge>> edges_;  ///< in the order of their first half-edges
  std::vector<std::unique_ptr<Face>> faces_;
};

/// Steps on the sides of a `PointerWingedEdgeMesh`, each O(1).
struct WingedWalk {
  using Handle = PointerWingedEdgeMesh::Side;
  using Edge = PointerWingedEdgeMesh::Edge;
  using Vertex = PointerWingedEdgeMesh::Vertex;
  using Face = PointerWingedEdgeMesh::Face;

  static bool is_valid(Handle s) noexcept { return s.edge != nullptr; }
  static Handle next(Handle s) noexcept {
    return leaving(s.is_ccw ? s.edge->next_ccw : s.edge->next_cw, end(s));
  }
  static Handle prev(Handle s) noexcept {
    const Edge* edge = s.is_ccw ? s.edge->prev_ccw : s.edge->prev_cw;
    return {edge, edge->end != start(s)};
  }
  static Handle opposite(Handle s) noexcept {
    const Face* across = s.is_ccw ? s.edge->cw_face : s.edge->ccw_face;
    return across != nullptr ? Handle{s.edge, !s.is_ccw} : Handle{};
  }
  static Handle leaving(const Edge* edge, const Vertex* vertex) noexcept {
    return {edge, edge->start != vertex};
  }
  static const Vertex* start(Handle s) noexcept { return s.is_ccw ? s.edge->end : s.edge->start; }
  static const Vertex* end(Handle s) noexcept { return s.is_ccw ? s.edge->start : s.edge->end; }
  static Index origin(Handle s) noexcept { return start(s)->id; }
  static const float* position(Handle s) noexcept { return start(s)->position; }
  static const Face& face(Handle s) noexcept {
    return s.is_ccw ? *s.edge->ccw_face : *s.edge->cw_face;
  }
  static Handle outgoing(const Vertex& vertex) noexcept {
    return vertex.edge != nullptr ? leaving(vertex.edge, &vertex) : Handle{};
  }
  static Handle first(const Face& face) noexcept {
    return {face.edge, face.edge->cw_face != &face};
  }
};

}  // namespace hedgerow::baselines
