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

/// The textbook half-edge mesh that the flat layout is measured against: records of pointers, each
/// allocated on its own with `new`, attributes inside the records, one thread.
///
/// Layout     Half-edge 40 bytes, vertex 40, face 32, and what the allocator adds to each.
/// Boundary   Default form: `opposite` is null, no half-edge exists outside the faces.
/// Pairs      As `hedgerow::build` with its default policies: two half-edges become opposite if
///            they are the only ones on their edge and run in different directions.
/// Fans       As in the textbook, a vertex knows one outgoing half-edge, so at a vertex with
///            several fans the walks see one fan only (they agree with the engine at every other
///            vertex).
/// Threads    Single-threaded; const members may run concurrently.
class PointerHalfedgeMesh {
 public:
  struct Halfedge;
  struct Vertex {
    float position[3];
    float normal[3];
    Halfedge* halfedge;  ///< leaves this vertex, starts its fan if that is open; null: isolated
    Index id;
  };
  struct Face {
    float normal[3];
    float double_area;
    Halfedge* halfedge;  ///< leaves the face's first corner
    Index id;
  };
  struct Halfedge {
    Vertex* vertex;  ///< the vertex it leaves
    Face* face;
    Halfedge* prev;
    Halfedge* next;
    Halfedge* opposite;
  };

  /// Builds from a face list with a hash map on vertex pairs, expected O(H). Copies the positions.
  ///
  /// \pre faces.is_native(), every index is in range, every face has at least three corners and no
  ///      vertex twice (as the faces that the engine keeps), positions.count >= faces.vertex_count.
  PointerHalfedgeMesh(const FaceList& faces, Positions positions);

  [[nodiscard]] Index vertex_count() const noexcept { return static_cast<Index>(vertices_.size()); }
  [[nodiscard]] Index halfedge_count() const noexcept {
    return static_cast<Index>(halfedges_.size());
  }
  [[nodiscard]] Index face_count() const noexcept { return static_cast<Index>(faces_.size()); }
  [[nodiscard]] const Vertex& vertex(Index v) const noexcept {
    return *vertices_[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] Vertex& vertex(Index v) noexcept { return *vertices_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] const Halfedge& halfedge(Index h) const noexcept {
    return *halfedges_[static_cast<std::size_t>(h)];
  }
  [[nodiscard]] const Face& face(Index f) const noexcept {
    return *faces_[static_cast<std::size_t>(f)];
  }

  /// Stores the unit normal and twice the area of every face (Newell's sum for polygons); a face of
  /// zero area gets (0, 0, 0). O(H).
  void compute_face_normals();
  /// Stores the unit normal of every vertex: walks its fan and adds the stored face normals with
  /// `weight`; no direction gives (0, 0, 0). \pre compute_face_normals() ran. O(V + H).
  void compute_vertex_normals(NormalWeight weight);
  /// sums[v] = sum of the ids of v's neighbours, modulo 2^32. \pre sums.size() >= V. O(V + H).
  void fill_one_ring_sums(std::span<std::uint32_t> sums) const;
  /// Number of closed chains of half-edges without opposite. O(H).
  [[nodiscard]] Index boundary_loop_count() const;
  /// Number of connected components of vertices and edges, isolated vertices left out. Nearly O(H).
  [[nodiscard]] Index component_count() const;

  // For comparison with the engine's columns; not timed.
  [[nodiscard]] std::vector<Index> origin() const;
  [[nodiscard]] std::vector<Index> opposite() const;
  [[nodiscard]] std::vector<Index> outgoing() const;
  [[nodiscard]] std::vector<float> face_normals() const;    ///< three floats a face
  [[nodiscard]] std::vector<float> vertex_normals() const;  ///< three floats a vertex

  // Edits, for meshes of triangles with one fan a vertex. Elements keep their ids until `compact`.

  /// Joins a new vertex at the mean of the corners of f to all of them; f stays the first triangle.
  void split_face(Index f);
  /// Turns the edge of h to the other diagonal if it is not on the boundary and that diagonal is
  /// no edge; returns whether it did.
  bool flip(Index h);
  /// Moves the vertex v along the half-edge that it knows into that one's target.
  /// \pre v is not on the boundary; the link condition holds.
  void collapse(Index v);
  /// Frees what collapses removed and numbers the rest anew, in order. O(V + H + F).
  void compact();

  /// Bytes of the records and of the arrays that own them, without the allocator's own.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  friend class PointerEditor;

  void make_vertices(Positions positions, std::int64_t count);
  void make_faces(const FaceList& faces);
  void pair_opposites();
  void choose_outgoing();

  std::vector<std::unique_ptr<Vertex>> vertices_;
  std::vector<std::unique_ptr<Halfedge>> halfedges_;  ///< face by face, in the order of the corners
  std::vector<std::unique_ptr<Face>> faces_;
};

/// Steps on the records of a `PointerHalfedgeMesh`, each O(1).
struct HalfedgeWalk {
  using Handle = const PointerHalfedgeMesh::Halfedge*;

  static bool is_valid(Handle h) noexcept { return h != nullptr; }
  static Handle next(Handle h) noexcept { return h->next; }
  static Handle prev(Handle h) noexcept { return h->prev; }
  static Handle opposite(Handle h) noexcept { return h->opposite; }
  static Index origin(Handle h) noexcept { return h->vertex->id; }
  static const float* position(Handle h) noexcept { return h->vertex->position; }
  static const PointerHalfedgeMesh::Face& face(Handle h) noexcept { return *h->face; }
  static Index face_id(Handle h) noexcept { return h->face->id; }
  static Handle outgoing(const PointerHalfedgeMesh::Vertex& vertex) noexcept {
    return vertex.halfedge;
  }
  static Handle first(const PointerHalfedgeMesh::Face& face) noexcept { return face.halfedge; }
};

}  // namespace hedgerow::baselines
