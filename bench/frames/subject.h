#pragma once

#include <cstdint>
#include <vector>

#include "hedgerow/buffer.h"
#include "hedgerow/build.h"
#include "hedgerow/ray/scene.h"
#include "hedgerow/soup.h"

namespace hedgerow::bench {

/// The mesh of a run: faces as the engine keeps them, positions at rest, and the vertices of a
/// brush stroke.
struct Subject {
  Soup soup;
  Connectivity mesh;
  std::vector<Index> blob;  ///< a hundredth of the vertices, next to each other, ascending
  float diagonal = 1;       ///< of the box of the positions at rest
  ray::Vec3 centre{};

  /// Throws std::runtime_error with the reason: no faces, or faces that the engine refuses.
  explicit Subject(Soup&& faces);

  [[nodiscard]] std::int64_t faces() const noexcept { return mesh.face_count(); }
  [[nodiscard]] std::int64_t vertices() const noexcept { return mesh.vertex_count(); }
};

/// The fixed deformation, the same for every library: a wave that runs along x, in z, by a
/// hundredth of the diagonal. Writes the positions of those vertices.
void deform(const Subject& subject, std::span<const Index> moved, float time, Buffer<float>& xyz);
void deform(const Subject& subject, IndexRange moved, float time, Buffer<float>& xyz);

/// Turns everything round the vertical axis through the middle (boxes keep their shape), or twists
/// it, the more the higher (boxes of a piece grow into each other).
void rotate(const Subject& subject, float angle, Buffer<float>& xyz);
void twist(const Subject& subject, float angle, Buffer<float>& xyz);

}  // namespace hedgerow::bench
