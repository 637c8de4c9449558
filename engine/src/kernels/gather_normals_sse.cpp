// Four corners of the ring at a time, each of its own triangle: the crosses are computed across
// lanes and added one after the other. The last group is filled up with a corner that is not added.

#include "kernels/gather_normals.h"
#include "kernels/normals_sse.h"

namespace hedgerow::kernels {

#if defined(__SSE2__)

template <NormalWeight W>
Float3 add_triangle_corners_sse(Float3 sum, Index* ids, Index count,
                                const GatherInput& input) noexcept {
  for (Index i = count; i < count + 3; ++i) ids[i] = ids[count - 1];
  __m128 total = _mm_setr_ps(sum.x, sum.y, sum.z, 0);
  for (Index begin = 0; begin < count; begin += 4) {
    Index corners[12];
    alignas(16) float k[4];
    for (int i = 0; i < 4; ++i) {
      const Index h = ids[begin + i];
      const Index corner = h % 3;
      k[i] = static_cast<float>(corner);
      const Index* face = input.origin + (h - corner);
      for (int j = 0; j < 3; ++j) corners[4 * j + i] = face[j];
    }
    TriangleTerms<Float4> terms;
    const Mask4 usual = triangle_terms<W>(load_points(input.points, corners, 1),
                                          load_points(input.points, corners + 4, 1),
                                          load_points(input.points, corners + 8, 1), terms);
    const Index used = count - begin < 4 ? count - begin : 4;
    if (usual.lanes() != 15) [[unlikely]] {
      const Float3 partial =
          add_triangle_corners_scalar<W>(to_float3(total), ids + begin, used, input);
      total = _mm_setr_ps(partial.x, partial.y, partial.z, 0);
      continue;
    }
    const __m128 corner = _mm_load_ps(k);
    const Mask4 is_first{_mm_cmpeq_ps(corner, _mm_setzero_ps())};
    const Mask4 is_third{_mm_cmpeq_ps(corner, _mm_set1_ps(2))};
    const Rows rows = to_rows(corner_term<W>(terms, is_first, is_third), 0);
    for (Index i = 0; i < used; ++i) total = _mm_add_ps(total, rows.row[i]);
  }
  return to_float3(total);
}

#else

template <NormalWeight W>
Float3 add_triangle_corners_sse(Float3 sum, Index* ids, Index count,
                                const GatherInput& input) noexcept {
  return add_triangle_corners_scalar<W>(sum, ids, count, input);
}

#endif

template Float3 add_triangle_corners_sse<NormalWeight::uniform>(Float3, Index*, Index,
                                                                const GatherInput&) noexcept;
template Float3 add_triangle_corners_sse<NormalWeight::area>(Float3, Index*, Index,
                                                             const GatherInput&) noexcept;
template Float3 add_triangle_corners_sse<NormalWeight::angle>(Float3, Index*, Index,
                                                              const GatherInput&) noexcept;
template Float3 add_triangle_corners_sse<NormalWeight::max>(Float3, Index*, Index,
                                                            const GatherInput&) noexcept;

}  // namespace hedgerow::kernels
