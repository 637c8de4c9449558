#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hedgerow/face_list.h"
#include "hedgerow/index.h"
#include "hedgerow/normals.h"
#include "hedgerow/positions.h"

namespace hedgerow::baselines {

/// A straightforward half-edge mesh of index records in arrays: the array-of-structs layout that
/// most libraries have, on one thread, to tell what comes of the flat columns from what comes of
/// leaving pointers behind.
///
/// Layout     Half-edge {origin, opposite, next, face} 16 bytes, vertex 28, face 20 (32-bit
/// indices).
/// Boundary   Default form: `opposite` is -1, no half-edge exists outside the faces.
/// Pairs, fans, threads   As `PointerHalfedgeMesh`.
class StructHalfedgeMesh {
 public:
  struct Vertex {
    float position[3];
    float normal[3];
    Index halfedge;  ///< leaves this vertex, starts its fan if that is open; -1: isolated
  };
  struct Face {
    float normal[3];
    float double_area;
    Index halfedge;
  };
  struct Halfedge {
    Index origin;
    Index opposite;
    Index next;
    Index face;
  };
  static_assert(sizeof(Halfedge) == 4 * sizeof(Index));

  /// Builds from a face list by sorting the half-edges by edge, O(H log H). Copies the positions.
  /// \pre as `PointerHalfedgeMesh`.
  StructHalfedgeMesh(const FaceList& faces, Positions positions);

  [[nodiscard]] const Vertex& vertex(Index v) const noexcept {
    return vertices_[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] Vertex& vertex(Index v) noexcept { return vertices_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] const Halfedge& halfedge(Index h) const noexcept {
    return halfedges_[static_cast<std::size_t>(h)];
  }
  [[nodiscard]] const Face& face(Index f) const noexcept {
    return faces_[static_cast<std::size_t>(f)];
  }

  [[nodiscard]] Index vertex_count() const noexcept { return static_cast<Index>(vertices_.size()); }
  [[nodiscard]] Index halfedge_count() const noexcept {
    return static_cast<Index>(halfedges_.size());
  }
  [[nodiscard]] Index face_count() const noexcept { return static_cast<Index>(faces_.size()); }

  // The same operations, results and preconditions as those of `PointerHalfedgeMesh`.
  void compute_face_normals();
  void compute_vertex_normals(NormalWeight weight);
  void fill_one_ring_sums(std::span<std::uint32_t> sums) const;
  [[nodiscard]] Index boundary_loop_count() const;
  [[nodiscard]] Index component_count() const;

  [[nodiscard]] std::vector<Index> origin() const;
  [[nodiscard]] std::vector<Index> opposite() const;
  [[nodiscard]] std::vector<Index> outgoing() const;
  [[nodiscard]] std::vector<float> face_normals() const;
  [[nodiscard]] std::vector<float> vertex_normals() const;

  void split_face(Index f);
  bool flip(Index h);
  void collapse(Index v);
  void compact();

  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  friend class StructEditor;
  friend class StructWalk;

  void make_faces(const FaceList& faces);
  void pair_opposites();
  void choose_outgoing();

  std::vector<Vertex> vertices_;
  std::vector<Halfedge> halfedges_;
  std::vector<Face> faces_;
};

/// Steps on the records of a `StructHalfedgeMesh`, each O(1) but `prev`: O(degree).
/// Lifetime   Until elements are added or removed.
class StructWalk {
 public:
  using Handle = Index;

  explicit StructWalk(const StructHalfedgeMesh& mesh) noexcept
      : halfedges_(mesh.halfedges_.data()),
        vertices_(mesh.vertices_.data()),
        faces_(mesh.faces_.data()) {}

  static bool is_valid(Handle h) noexcept { return h != kInvalidIndex; }
  [[nodiscard]] Handle next(Handle h) const noexcept { return halfedges_[h].next; }
  [[nodiscard]] Handle prev(Handle h) const noexcept {
    Handle g = halfedges_[h].next;
    while (halfedges_[g].next != h) g = halfedges_[g].next;
    return g;
  }
  [[nodiscard]] Handle opposite(Handle h) const noexcept { return halfedges_[h].opposite; }
  [[nodiscard]] Index origin(Handle h) const noexcept { return halfedges_[h].origin; }
  [[nodiscard]] const float* position(Handle h) const noexcept {
    return vertices_[halfedges_[h].origin].position;
  }
  [[nodiscard]] const StructHalfedgeMesh::Face& face(Handle h) const noexcept {
    return faces_[halfedges_[h].face];
  }
  [[nodiscard]] Index face_id(Handle h) const noexcept { return halfedges_[h].face; }

 private:
  const StructHalfedgeMesh::Halfedge* halfedges_;
  const StructHalfedgeMesh::Vertex* vertices_;
  const StructHalfedgeMesh::Face* faces_;
};

}  // namespace hedgerow::baselines
