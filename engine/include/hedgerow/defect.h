#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "hedgerow/index.h"

namespace hedgerow {

/// The defects that the builder finds, in the order of the defect table.
enum class DefectKind : std::uint8_t {
  out_of_range,        ///< a face refers to a vertex that does not exist
  too_few_corners,     ///< a face with fewer than three corners
  repeated_vertex,     ///< a vertex occurs twice in a face
  duplicate_face,      ///< a face with the same set of vertices as an earlier kept one
  nonmanifold_edge,    ///< an edge with three or more half-edges
  inconsistent_edge,   ///< an edge with two half-edges that run the same way
  nonmanifold_vertex,  ///< the faces at a vertex, joined across shared edges, form several groups
  isolated_vertex,     ///< a vertex on no kept face
};
inline constexpr std::size_t kDefectKindCount = 8;

/// What to do about a defect.
enum class Action : std::uint8_t {
  fail,   ///< the build returns an error value that names the first one
  skip,   ///< drop the face (for an isolated vertex: drop the vertex)
  cut,    ///< keep the face and leave the half-edges concerned without opposite
  split,  ///< duplicate vertices so that the defect is gone; see `BuildOutput::vertices_new_to_old`
  keep,   ///< report it and change nothing
};

/// Stable lower-case words with dashes, as on the command line: "nonmanifold-edge", "split".
[[nodiscard]] const char* name(DefectKind kind) noexcept;
[[nodiscard]] const char* name(Action action) noexcept;
[[nodiscard]] std::optional<DefectKind> defect_kind_named(std::string_view word) noexcept;
[[nodiscard]] std::optional<Action> action_named(std::string_view word) noexcept;

/// One defect. Which members are set depends on the kind:
///
/// | kind               | face | halfedge          | vertex       | other        | value        |
/// |--------------------|------|-------------------|--------------|--------------|--------------|
/// | out_of_range       | yes  |                   |              |              | the index    |
/// | too_few_corners    | yes  |                   |              |              | its corners  |
/// | repeated_vertex    | yes  |                   | the vertex   |              |              |
/// | duplicate_face     | yes  |                   |              |              | earlier face |
/// | nonmanifold_edge   | yes  | smallest of edge  | smaller end  | larger end   | half-edges   |
/// | inconsistent_edge  | yes  | smallest of edge  | smaller end  | larger end   | 2            |
/// | nonmanifold_vertex |      |                   | the vertex   |              | groups       |
/// | isolated_vertex    |      |                   | the vertex   |              |              |
///
/// A face is listed once under the first three kinds: for the first of them that applies to it.
/// Faces are numbered as in the input. Edges and vertices are classified once the policies of the
/// first four kinds have been applied, and before those of the other four: half-edges and vertices
/// are numbered as they are then. What later rounds of `skip` or `split` meet is not listed.
struct Defect {
  DefectKind kind{};
  FaceId face;
  HalfedgeId halfedge;
  VertexId vertex;
  VertexId other;
  std::int64_t value = 0;

  friend constexpr bool operator==(const Defect&, const Defect&) noexcept = default;
};

/// An action for each kind. The defaults refuse nothing but an index that means nothing, lose no
/// face that can be kept, and never pair half-edges on guesswork.
///
/// | kind               | fail | skip | cut     | split | keep    |
/// |--------------------|------|------|---------|-------|---------|
/// | out_of_range       | def. | yes  |         |       |         |
/// | too_few_corners    | yes  | def. |         |       |         |
/// | repeated_vertex    | yes  | def. |         | yes   |         |
/// | duplicate_face     | yes  | yes  | yes     | yes   | default |
/// | nonmanifold_edge   | yes  | yes  | default | yes   |         |
/// | inconsistent_edge  | yes  | yes  | default | yes   |         |
/// | nonmanifold_vertex | yes  | yes  | = keep  | yes   | default |
/// | isolated_vertex    | yes  | yes  |         |       | default |
///
/// An empty cell is refused with `ErrorCode::unsupported_policy`.
struct Policies {
  std::array<Action, kDefectKindCount> action = {Action::fail, Action::skip, Action::skip,
                                                 Action::keep, Action::cut,  Action::cut,
                                                 Action::keep, Action::keep};

  [[nodiscard]] constexpr Action operator[](DefectKind kind) const noexcept {
    return action[static_cast<std::size_t>(kind)];
  }
  constexpr Action& operator[](DefectKind kind) noexcept {
    return action[static_cast<std::size_t>(kind)];
  }
};

/// True if the cell of the table above is not empty.
[[nodiscard]] bool is_supported(DefectKind kind, Action action) noexcept;

}  // namespace hedgerow
