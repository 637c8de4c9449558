#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "hedgerow/face_list.h"
#include "hedgerow/positions.h"

namespace hedgerow::bench {

/// What every representation is asked, over all elements of the mesh one after the other. The
/// answers of all elements are folded into one number, which the layout must not change.
enum class Question : std::uint8_t {
  face_vertices,     ///< the vertices round each face
  face_edges,        ///< the edges round each face, by their two ends
  face_faces,        ///< the faces across the edges of each face
  face_degree,       ///< the degree of the face of each half-edge
  face_neighbours,   ///< how many faces lie across the edges of each face
  edge_faces,        ///< the faces of each edge
  ring_halfedges,    ///< the half-edges that leave each vertex, clockwise
  ring_reversed,     ///< the same counter-clockwise
  ring_vertices,     ///< the neighbours of each vertex
  ring_faces,        ///< the faces at each vertex
  boundary_loop,     ///< the vertices of the boundary loop through one boundary half-edge
  boundary_loops,    ///< all boundary loops
  is_boundary_half,  ///< whether each half-edge is on the boundary
  is_boundary_edge,
  is_boundary_vertex,
  is_boundary_face,
  components,  ///< connected components
  euler,       ///< Euler characteristic
  genus,
};
inline constexpr std::size_t kQuestionCount = static_cast<std::size_t>(Question::genus) + 1;
/// "face_vertices"
[[nodiscard]] std::string_view name(Question question) noexcept;

/// A mesh in one of its representations, ready to be asked.
class Representation {
 public:
  virtual ~Representation() = default;

  /// Of the connectivity: what attributes take is left out.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  /// None: this representation has no such thing.
  [[nodiscard]] virtual std::optional<std::uint64_t> answer(Question question) const = 0;
  /// One normal a vertex, weighted by area, by the representation's own walk.
  virtual void compute_vertex_normals() = 0;
  /// Three floats a vertex, of the last computation.
  [[nodiscard]] virtual std::vector<float> vertex_normals() const = 0;
};

/// Which questions a representation is asked.
enum class Asked : std::uint8_t {
  everything,
  all_but_rotations,   ///< its rows of a vertex are in no order
  of_edge_faces,       ///< all other answers are those of the columns that it extends
  of_what_lies_beside  ///< it has no vertices
};

struct RepresentationKind {
  const char* name;
  /// Whether it has half-edges without a face along the boundary.
  bool is_closed;
  Asked asked;
  /// From triangles, on one thread: the whole way from the list.
  std::unique_ptr<Representation> (*build)(const FaceList& faces, Positions positions);
};

[[nodiscard]] bool is_asked(const RepresentationKind& kind, Question question) noexcept;
[[nodiscard]] inline bool has_vertex_normals(const RepresentationKind& kind) noexcept {
  return kind.asked == Asked::everything || kind.asked == Asked::all_but_rotations;
}

/// All of them, as the table shows them.
[[nodiscard]] std::span<const RepresentationKind> representation_kinds();

// One function for each, in the source file of its family.
std::unique_ptr<Representation> build_flat(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_flat_stored(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_flat_closed(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_flat_radial(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_directed_edge(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_corner_tables(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_dcel_records(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_split_edge(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_adjacency_only(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_winged_tables(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_nonmanifold(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_pointer_half(const FaceList& faces, Positions positions);
std::unique_ptr<Representation> build_pointer_winged(const FaceList& faces, Positions positions);

}  // namespace hedgerow::bench
