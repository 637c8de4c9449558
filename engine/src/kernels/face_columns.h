#pragma once

#include "hedgerow/index.h"

namespace hedgerow::kernels {

/// Faces in canonical form, as raw columns: the half-edges of face f are
/// first[f] .. first[f + 1] - 1, or 3f .. 3f + 2 where `first` is null; corners[h] is the origin of
/// h.
struct FaceColumns {
  const Index* corners = nullptr;
  const Index* first = nullptr;
  Index face_count = 0;
  Index vertex_count = 0;

  [[nodiscard]] bool is_triangles() const noexcept { return first == nullptr; }
  [[nodiscard]] Index begin(Index f) const noexcept { return first ? first[f] : 3 * f; }
  [[nodiscard]] Index degree(Index f) const noexcept { return first ? first[f + 1] - first[f] : 3; }
  [[nodiscard]] Index halfedge_count() const noexcept { return begin(face_count); }
};

}  // namespace hedgerow::kernels
