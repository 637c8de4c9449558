#include <vector>

#include "representations/representation.h"

namespace hedgerow::bench {

std::string_view name(Question question) noexcept {
  static constexpr std::array<std::string_view, kQuestionCount> kNames = {"face_vertices",
                                                                          "face_edges",
                                                                          "face_faces",
                                                                          "face_degree",
                                                                          "face_neighbours",
                                                                          "edge_faces",
                                                                          "ring_halfedges",
                                                                          "ring_reversed",
                                                                          "ring_vertices",
                                                                          "ring_faces",
                                                                          "boundary_loop",
                                                                          "boundary_loops",
                                                                          "is_boundary_half",
                                                                          "is_boundary_edge",
                                                                          "is_boundary_vertex",
                                                                          "is_boundary_face",
                                                                          "components",
                                                                          "euler",
                                                                          "genus"};
  return kNames[static_cast<std::size_t>(question)];
}

std::span<const RepresentationKind> representation_kinds() {
  static const RepresentationKind all[] = {
      {"flat", false, build_flat},
      {"flat-stored", false, build_flat_stored},
      {"flat-closed", true, build_flat_closed},
      {"radial", false, build_flat_radial},
      {"directed-edge", false, build_directed_edge},
      {"corner-table", false, build_corner_tables},
      {"dcel", true, build_dcel_records},
      {"split-edge", true, build_split_edge},
      {"winged-tables", false, build_winged_tables},
      {"nonmanifold", false, build_nonmanifold},
      {"pointer-half", false, build_pointer_half},
      {"pointer-winged", false, build_pointer_winged},
  };
  return all;
}

}  // namespace hedgerow::bench
