#pragma once

#include "kernels/normals_source.h"

namespace hedgerow::kernels {

/// Writes the unit normals of the faces in `range`; each face writes its own element.
[[nodiscard]] NormalStats face_normals(IndexRange range, const FaceSource& faces,
                                       const Points& points, PolygonMethod method,
                                       const NormalWriter& writer) noexcept;

/// The plain form for triangles: `corners` are those of `range`, packed.
[[nodiscard]] NormalStats triangle_normals_scalar(IndexRange range, const Index* corners,
                                                  const Points& points,
                                                  const NormalWriter& writer) noexcept;
/// Four triangles at a time where the processor can; else the same as the plain form.
[[nodiscard]] NormalStats triangle_normals_sse(IndexRange range, const Index* corners,
                                               const Points& points,
                                               const NormalWriter& writer) noexcept;

/// Eight and sixteen at a time; where the build cannot, a narrower form. \pre `suits_avx2(points)`,
/// `suits_avx512(points)`
[[nodiscard]] NormalStats triangle_normals_avx2(IndexRange range, const Index* corners,
                                                const Points& points,
                                                const NormalWriter& writer) noexcept;
[[nodiscard]] NormalStats triangle_normals_avx512(IndexRange range, const Index* corners,
                                                  const Points& points,
                                                  const NormalWriter& writer) noexcept;

}  // namespace hedgerow::kernels
