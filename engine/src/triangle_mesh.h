#pragma once

#include "hedgerow/connectivity.h"
#include "hedgerow/result.h"

namespace hedgerow::detail {

/// The smallest face that is no triangle, as an error.
[[nodiscard]] inline Result<void> check_triangles(const Connectivity& mesh) {
  if (mesh.is_triangle_mesh()) return {};
  const PolygonView view = mesh.polygons();
  Error error{ErrorCode::not_triangles, kInvalidIndex, 0, 3, 0};
  for (Index f = view.face_count(); f-- > 0;) {
    if (view.degree(FaceId(f)) == 3) continue;
    error.element = f;
    error.value = view.degree(FaceId(f));
    ++error.count;
  }
  if (error.count > 0) return fail(error);
  return {};
}

/// The default form of a triangle mesh whose columns are only known to be triangles if all of its
/// faces are: `polygons()` of such a mesh is renamed to arithmetic.
[[nodiscard]] inline TriangleView triangles_of(const Connectivity& mesh) {
  if (mesh.is_implicit()) return mesh.triangles();
  const PolygonView view = mesh.polygons();
  return {view.origin, view.opposite, view.outgoing, view.fans};
}

}  // namespace hedgerow::detail
