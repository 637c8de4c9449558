// Four triangles at a time: twelve 16-byte loads and three transposes instead of 36 loads of a
// float, and one square root and one division for four. PERF.md, "face normals".

#include "kernels/face_normals.h"
#include "kernels/normals_sse.h"

namespace hedgerow::kernels {

#if defined(__SSE2__)

namespace {

// Four float3 in a row are three vectors exactly.
void store_packed(float* out, const Rows& r) noexcept {
  const __m128 z0x1 = _mm_shuffle_ps(r.row[0], r.row[1], _MM_SHUFFLE(0, 0, 2, 2));
  const __m128 z2x3 = _mm_shuffle_ps(r.row[2], r.row[3], _MM_SHUFFLE(0, 0, 2, 2));
  _mm_storeu_ps(out, _mm_shuffle_ps(r.row[0], z0x1, _MM_SHUFFLE(2, 0, 1, 0)));
  _mm_storeu_ps(out + 4, _mm_shuffle_ps(r.row[1], r.row[2], _MM_SHUFFLE(1, 0, 2, 1)));
  _mm_storeu_ps(out + 8, _mm_shuffle_ps(z2x3, r.row[3], _MM_SHUFFLE(2, 1, 2, 0)));
}

}  // namespace

NormalStats triangle_normals_sse(IndexRange range, const Index* corners, const Points& points,
                                 const NormalWriter& writer) noexcept {
  NormalStats stats;
  const bool is_packed = writer.out.stride_bytes == sizeof(Float3);
  Index f = range.begin;
  for (; f + 4 <= range.end; f += 4, corners += 12) {
    TriangleTerms<Float4> terms;
    const Mask4 usual = triangle_terms<NormalWeight::uniform>(
        load_points(points, corners, 3), load_points(points, corners + 1, 3),
        load_points(points, corners + 2, 3), terms);
    if (usual.lanes() != 15) [[unlikely]] {
      stats = merge(stats, triangle_normals_scalar({f, f + 4}, corners, points, writer));
      continue;
    }
    const Rows rows = to_rows(terms.base, 0);
    if (is_packed) {
      store_packed(writer.out[f], rows);
    } else {
      for (Index i = 0; i < 4; ++i) writer.write(f + i, to_float3(rows.row[i]));
    }
  }
  return merge(stats, triangle_normals_scalar({f, range.end}, corners, points, writer));
}

#else

NormalStats triangle_normals_sse(IndexRange range, const Index* corners, const Points& points,
                                 const NormalWriter& writer) noexcept {
  return triangle_normals_scalar(range, corners, points, writer);
}

#endif

}  // namespace hedgerow::kernels
