#pragma once

#include <cstdint>
#include <vector>

#include "hedgerow/face_list.h"
#include "hedgerow/normals.h"
#include "hedgerow/soup.h"

namespace hedgerow::tool {

/// Slow and obvious answers, from the face list alone, that the stages are compared with.
///
/// Faces are those of a canonical mesh, so corner numbers are half-edge numbers.
class Reference {
 public:
  explicit Reference(const Soup& soup);

  /// -1 where the half-edge is not one of exactly two on its edge that run in different directions.
  [[nodiscard]] const std::vector<Index>& opposites() const noexcept { return opposite_; }
  /// For each vertex the sum of the vertices at the other ends of its half-edges' edges, an edge
  /// counted once for each pair of opposite half-edges or half-edge without opposite; modulo 2^32.
  [[nodiscard]] std::vector<std::uint32_t> neighbour_sums() const;
  /// Loops of half-edges without opposite: after h comes the one that the rotation round its
  /// origin, inside the fan of h, ends at.
  [[nodiscard]] std::int64_t boundary_loop_count() const;
  /// Connected components of vertices joined by edges, isolated vertices left out.
  [[nodiscard]] std::int64_t component_count() const;

  /// True if `normals` (three floats a face) agree with double arithmetic as far as the rounding
  /// of float allows.
  [[nodiscard]] bool accepts_face_normals(const Buffer<float>& normals) const;
  [[nodiscard]] bool accepts_vertex_normals(const Buffer<float>& normals,
                                            NormalWeight weight) const;

  [[nodiscard]] Index face_count() const noexcept { return soup_.face_count(); }
  [[nodiscard]] Index first(Index face) const noexcept;
  [[nodiscard]] Index degree(Index face) const noexcept { return first(face + 1) - first(face); }
  [[nodiscard]] Index next(Index face, Index h) const noexcept;

 private:
  const Soup& soup_;
  std::vector<Index> opposite_;
};

}  // namespace hedgerow::tool
