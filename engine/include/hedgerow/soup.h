#pragma once

#include <cstdint>

#include "hedgerow/buffer.h"
#include "hedgerow/face_list.h"
#include "hedgerow/index.h"
#include "hedgerow/positions.h"

namespace hedgerow {

/// Vertex positions and faces without connectivity: what readers and generators make and `build`
/// takes. Move-only; indices are not checked until the build.
struct Soup {
  Buffer<float> xyz;      ///< three floats a vertex
  Buffer<Index> corners;  ///< vertex of each corner, face by face
  Buffer<Index> offsets;  ///< first corner of each face, and the corner count; empty: all triangles

  [[nodiscard]] Index vertex_count() const noexcept { return static_cast<Index>(xyz.size() / 3); }
  [[nodiscard]] Index face_count() const noexcept {
    return static_cast<Index>(offsets.empty() ? corners.size() / 3 : offsets.size() - 1);
  }
  [[nodiscard]] Positions positions() const noexcept { return {xyz.data(), vertex_count()}; }
  /// Views this soup. Valid as long as it is.
  [[nodiscard]] FaceList face_list() const noexcept {
    return offsets.empty()
               ? FaceList::triangles<Index>(corners.span(), vertex_count())
               : FaceList::polygons<Index>(corners.span(), offsets.span(), vertex_count());
  }
};

}  // namespace hedgerow
