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
/// indices). Boundary   Default form: `opposite` is -1, no half-edge exists outside the faces.
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

  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  void make_faces(const FaceList& faces);
  void pair_opposites();
  void choose_outgoing();

  std::vector<Vertex> vertices_;
  std::vector<Halfedge> halfedges_;
  std::vector<Face> faces_;
};

}  // namespace hedgerow::baselines
