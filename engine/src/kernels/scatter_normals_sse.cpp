// The terms of four triangles are computed across lanes, turned into rows, and added one after the
// other, in the order of the plain form. A sum and its count are one vector.

#include "kernels/normals_sse.h"
#include "kernels/normals_weight.h"
#include "kernels/scatter_normals.h"

namespace hedgerow::kernels {

#if defined(__SSE2__)

namespace {

void add(VertexSum& sum, __m128 term) noexcept {
  auto* p = reinterpret_cast<float*>(&sum);
  _mm_store_ps(p, _mm_add_ps(_mm_load_ps(p), term));
}

template <NormalWeight W, bool kInside>
void scatter(IndexRange range, const Index* corners, const ScatterInput& input,
             const SumBlock& block) noexcept {
  constexpr bool kOneTerm = W == NormalWeight::area || W == NormalWeight::uniform;
  Index f = range.begin;
  for (; f + 4 <= range.end; f += 4, corners += 12) {
    TriangleTerms<Float4> terms;
    const Mask4 usual = triangle_terms<W>(load_points(input.points, corners, 3),
                                          load_points(input.points, corners + 1, 3),
                                          load_points(input.points, corners + 2, 3), terms);
    if (usual.lanes() != 15) [[unlikely]] {
      scatter_triangles_scalar({f, f + 4}, corners, input, block, kInside);
      continue;
    }
    Rows rows[3];
    rows[0] = to_rows(corner_term<W>(terms, terms.factor[0]), 1);
    if constexpr (!kOneTerm) {
      rows[1] = to_rows(corner_term<W>(terms, terms.factor[1]), 1);
      rows[2] = to_rows(corner_term<W>(terms, terms.factor[2]), 1);
    }
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) {
        const Index v = corners[3 * i + k];
        if (kInside || block.holds(v)) add(block[v], rows[kOneTerm ? 0 : k].row[i]);
      }
    }
  }
  scatter_triangles_scalar({f, range.end}, corners, input, block, kInside);
}

}  // namespace

void scatter_triangles_sse(IndexRange range, const Index* corners, const ScatterInput& input,
                           const SumBlock& block, bool is_inside) noexcept {
  with_weight(input.weight, [&](auto weight) {
    is_inside ? scatter<weight(), true>(range, corners, input, block)
              : scatter<weight(), false>(range, corners, input, block);
  });
}

#else

void scatter_triangles_sse(IndexRange range, const Index* corners, const ScatterInput& input,
                           const SumBlock& block, bool is_inside) noexcept {
  scatter_triangles_scalar(range, corners, input, block, is_inside);
}

#endif

}  // namespace hedgerow::kernels
