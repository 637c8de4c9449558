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

bool is_asked(const RepresentationKind& kind, Question question) noexcept {
  switch (kind.asked) {
    case Asked::everything:
      return true;
    case Asked::all_but_rotations:
      return question != Question::ring_halfedges && question != Question::ring_reversed;
    case Asked::of_edge_faces:
      return question == Question::edge_faces;
    case Asked::of_what_lies_beside:
      switch (question) {
        case Question::face_vertices:
        case Question::face_edges:
        case Question::ring_halfedges:
        case Question::ring_reversed:
        case Question::ring_vertices:
        case Question::ring_faces:
        case Question::boundary_loop:
        case Question::is_boundary_vertex:
          return false;
        default:
          return true;
      }
  }
  return false;
}

std::span<const RepresentationKind> representation_kinds() {
  static const RepresentationKind all[] = {
      {"flat", false, Asked::everything, build_flat},
      {"flat-stored", false, Asked::everything, build_flat_stored},
      {"flat-closed", true, Asked::everything, build_flat_closed},
      {"radial", false, Asked::of_edge_faces, build_flat_radial},
      {"directed-edge", false, Asked::everything, build_directed_edge},
      {"corner-table", false, Asked::everything, build_corner_tables},
      {"dcel", true, Asked::everything, build_dcel_records},
      {"split-edge", true, Asked::everything, build_split_edge},
      {"adjacency", false, Asked::of_what_lies_beside, build_adjacency_only},
      {"winged-tables", false, Asked::everything, build_winged_tables},
      {"nonmanifold", false, Asked::all_but_rotations, build_nonmanifold},
      {"pointer-half", false, Asked::everything, build_pointer_half},
      {"pointer-winged", false, Asked::everything, build_pointer_winged},
  };
  return all;
}

}  // namespace hedgerow::bench
