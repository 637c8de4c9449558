#include "kernels/face_normals.h"

namespace hedgerow::kernels {

NormalStats triangle_normals_scalar(IndexRange range, const Index* corners, const Points& points,
                                    const NormalWriter& writer) noexcept {
  NormalStats stats;
  for (Index f = range.begin; f < range.end; ++f, corners += 3) {
    const Wide normal =
        triangle_vector(points[corners[0]], points[corners[1]], points[corners[2]], true);
    if (exponent_of(normal) != kNoExponent) {
      writer.write(f, normal.v);
    } else {
      writer.write_degenerate(f, stats);
    }
  }
  return stats;
}

NormalStats face_normals(IndexRange range, const FaceSource& faces, const Points& points,
                         PolygonMethod method, const NormalWriter& writer) noexcept {
  NormalStats stats;
  if (faces.is_triangles()) {
    const auto kernel = suits_avx512(points) ? triangle_normals_avx512
                        : suits_avx2(points) ? triangle_normals_avx2
                                             : triangle_normals_sse;
    for_each_packed(range, faces, [&](IndexRange piece, const Index* corners) {
      stats = merge(stats, kernel(piece, corners, points, writer));
    });
    return stats;
  }
  for (Index f = range.begin; f < range.end; ++f) {
    const Wide normal = polygon_vector(faces, f, points, method, true);
    if (exponent_of(normal) != kNoExponent) {
      writer.write(f, normal.v);
    } else {
      writer.write_degenerate(f, stats);
    }
  }
  return stats;
}

}  // namespace hedgerow::kernels
