// Four triangles at a time, a lane each, turned into rows.

#include "kernels/normals_sse.h"
#include "kernels/term_groups.h"

namespace hedgerow::kernels {

#if defined(__SSE2__)

namespace {

template <NormalWeight W>
struct Groups4 {
  static constexpr NormalWeight kWeight = W;
  static constexpr auto fill_rest = fill_term_rows_scalar;
  static constexpr auto add_rest = add_terms_scalar;
  static constexpr Index kSize = 4;

  const Points& points;

  static void prefetch(const Index*, std::ptrdiff_t) noexcept {}

  static std::uint64_t inside(const Index* corners, const SumBlock& block) noexcept {
    std::uint64_t bits = 0;
    for (int c = 0; c < 3 * kSize; ++c) bits |= std::uint64_t{block.holds(corners[c])} << c;
    return bits;
  }

  bool make(const Index* corners, __m128* rows) const noexcept {
    if constexpr (W == NormalWeight::area) return make_areas(corners, rows);
    TriangleTerms<Float4> terms;
    const Mask4 usual =
        triangle_terms<W>(load_points(points, corners, 3), load_points(points, corners + 1, 3),
                          load_points(points, corners + 2, 3), terms);
    Float4 weights[3];
    if constexpr (rows_of(W) == 3) corner_weights<W>(terms, weights);
    for (int k = 0; k < rows_of(W); ++k) {
      const Rows four = to_rows(rows_of(W) == 1 ? terms.base : terms.base * weights[k], 1);
      for (int i = 0; i < kSize; ++i) rows[i * rows_of(W) + k] = four.row[i];
    }
    return usual.lanes() == 15;
  }

  // Area vectors are crossed as rows, as positions lie in memory; only squares become lanes.
  bool make_areas(const Index* corners, __m128* rows) const noexcept {
    const auto turned = [](__m128 v) { return _mm_shuffle_ps(v, v, 0xc9); };  // y, z, x
    const __m128 is_vector = _mm_castsi128_ps(_mm_setr_epi32(-1, -1, -1, 0));
    const __m128 one = _mm_setr_ps(0, 0, 0, 1);
    __m128 square[kSize];
    for (int i = 0; i < kSize; ++i, corners += 3) {
      const __m128 origin = load_point(points, corners[0]);
      const __m128 u = _mm_sub_ps(load_point(points, corners[1]), origin);
      const __m128 v = _mm_sub_ps(load_point(points, corners[2]), origin);
      const __m128 zxy = _mm_sub_ps(_mm_mul_ps(u, turned(v)), _mm_mul_ps(turned(u), v));
      const __m128 area = _mm_and_ps(turned(zxy), is_vector);
      square[i] = _mm_mul_ps(area, area);
      rows[i] = _mm_or_ps(area, one);
    }
    _MM_TRANSPOSE4_PS(square[0], square[1], square[2], square[3]);
    const Float4 total = (Float4(square[0]) + Float4(square[1])) + Float4(square[2]);
    return is_usual(total).lanes() == 15;
  }
};

}  // namespace

void fill_term_rows_sse(const Triangles& triangles, const Points& points, NormalWeight weight,
                        TermRow* rows) noexcept {
  with_weight(weight, [&](auto w) { fill_groups(triangles, points, Groups4<w()>{points}, rows); });
}

void add_terms_sse(const Triangles& triangles, const TermSums& to) noexcept {
  with_weight(to.weight, [&](auto w) { add_all_groups(triangles, to, Groups4<w()>{to.points}); });
}

#else

void fill_term_rows_sse(const Triangles& triangles, const Points& points, NormalWeight weight,
                        TermRow* rows) noexcept {
  fill_term_rows_scalar(triangles, points, weight, rows);
}

void add_terms_sse(const Triangles& triangles, const TermSums& to) noexcept {
  add_terms_scalar(triangles, to);
}

#endif

}  // namespace hedgerow::kernels
