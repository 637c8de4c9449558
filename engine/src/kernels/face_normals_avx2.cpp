// Eight triangles at a time: their positions are gathered straight into lanes.

#include "kernels/face_normals.h"
#include "kernels/normals_avx2.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

NormalStats triangle_normals_avx2(IndexRange range, const Index* corners, const Points& points,
                                  const NormalWriter& writer) noexcept {
  NormalStats stats;
  const __m256i stride = stride_of(points);
  Index f = range.begin;
  for (; f + 8 <= range.end; f += 8, corners += 24) {
    const Corners8 c = load_triangles(corners);
    TriangleTerms<Float8> terms;
    const Mask8 usual = triangle_terms<NormalWeight::uniform>(
        load_points(points, c.corner[0], stride), load_points(points, c.corner[1], stride),
        load_points(points, c.corner[2], stride), terms);
    if (usual.lanes() != 0xff) [[unlikely]] {
      stats = merge(stats, triangle_normals_scalar({f, f + 8}, corners, points, writer));
    } else {
      write_units(writer, f, terms.base);
    }
  }
  return merge(stats, triangle_normals_scalar({f, range.end}, corners, points, writer));
}

#else

NormalStats triangle_normals_avx2(IndexRange range, const Index* corners, const Points& points,
                                  const NormalWriter& writer) noexcept {
  return triangle_normals_scalar(range, corners, points, writer);
}

#endif

}  // namespace hedgerow::kernels
