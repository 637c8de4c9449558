// Eight triangles at a time.

#include "kernels/normals_avx2.h"
#include "kernels/term_groups.h"
#include "kernels/weighed_terms.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

// Of weights by which all corners of a triangle add the same.
template <NormalWeight W, class Loader>
struct Groups8 {
  static_assert(rows_of(W) == 1);
  static constexpr NormalWeight kWeight = W;
  static constexpr auto fill_rest = fill_term_rows_sse;
  static constexpr auto add_rest = add_terms_sse;
  static constexpr Index kSize = 8;

  const Loader& loader;

  [[gnu::always_inline]] void prefetch(const Index* corners, std::ptrdiff_t left) const noexcept {
    loader.prefetch(corners, left);
  }

  static std::uint64_t inside(const Index* corners, const SumBlock& block) noexcept {
    const __m256i begin = _mm256_set1_epi32(static_cast<int>(block.begin));
    const __m256i last = _mm256_set1_epi32(static_cast<int>(block.size - 1));
    unsigned bits = 0;
    for (int j = 0; j < 3; ++j) {
      const __m256i local = _mm256_sub_epi32(load_indices(corners + 8 * j), begin);
      const __m256i is_in = _mm256_cmpeq_epi32(_mm256_min_epu32(local, last), local);
      bits |= static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(is_in))) << 8 * j;
    }
    return bits;
  }

  [[gnu::always_inline]] bool make(const Index* corners, __m128* rows) const noexcept {
    if constexpr (W == NormalWeight::area) return make_areas(corners, rows);
    Vec3<Float8> p[3];
    loader.load(corners, p);
    TriangleTerms<Float8> terms;
    const Mask8 usual = triangle_terms<W>(p[0], p[1], p[2], terms);
    const Rows8 eight = to_rows(terms.base, 1);
    for (int i = 0; i < kSize; ++i) rows[i] = eight.row[i];
    return usual.all();
  }

  // Area vectors are crossed as rows, as positions lie in memory: to turn them into lanes and back
  // takes more instructions than the cross products. Only squares become lanes, to test all eight.
  [[gnu::always_inline]] bool make_areas(const Index* corners, __m128* rows) const noexcept {
    if (loader.has_last(corners)) [[unlikely]]
      return false;
    const auto turned = [](__m256 v) { return _mm256_permute_ps(v, 0xc9); };  // y, z, x
    const __m256 one = _mm256_set1_ps(1);
    __m256 square[4];
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j) {
      const Index* two = corners + 6 * j;
      const __m256 origin = loader.load_two(two[0], two[3]);
      const __m256 u = _mm256_sub_ps(loader.load_two(two[1], two[4]), origin);
      const __m256 v = _mm256_sub_ps(loader.load_two(two[2], two[5]), origin);
      // z, x, y of the cross product, and what came of the bytes behind the positions.
      const __m256 zxy = _mm256_sub_ps(_mm256_mul_ps(u, turned(v)), _mm256_mul_ps(turned(u), v));
      const __m256 area = _mm256_blend_ps(turned(zxy), one, 0x88);
      square[j] = _mm256_mul_ps(area, area);
      rows[2 * j] = _mm256_castps256_ps128(area);
      rows[2 * j + 1] = _mm256_extractf128_ps(area, 1);
    }
    const Vec3<Float8> squares = to_lanes(square[0], square[1], square[2], square[3]);
    return is_usual((squares.x + squares.y) + squares.z).lanes() == 0xff;
  }
};

}  // namespace

void fill_term_rows_avx2(const Triangles& triangles, const Points& points, NormalWeight weight,
                         TermRow* rows) noexcept {
  with_weight(weight, [&](auto w) {
    with_loader(points, [&]<class Loader>(const Loader& loader) {
      if constexpr (rows_of(w()) == 3) {
        fill_weighed<w()>(triangles, loader, rows, [&](const Triangles& few, TermRow* to) {
          fill_term_rows_sse(few, points, w(), to);
        });
      } else {
        fill_groups(triangles, points, Groups8<w(), Loader>{loader}, rows);
      }
    });
  });
}

void add_terms_avx2(const Triangles& triangles, const TermSums& to) noexcept {
  with_weight(to.weight, [&](auto w) {
    with_loader(to.points, [&]<class Loader>(const Loader& loader) {
      if constexpr (rows_of(w()) == 3) {
        add_all_weighed<w()>(triangles, to, loader,
                             [&](const Triangles& few) { add_terms_sse(few, to); });
      } else {
        add_all_groups(triangles, to, Groups8<w(), Loader>{loader});
      }
    });
  });
}

#else

void fill_term_rows_avx2(const Triangles& triangles, const Points& points, NormalWeight weight,
                         TermRow* rows) noexcept {
  fill_term_rows_sse(triangles, points, weight, rows);
}

void add_terms_avx2(const Triangles& triangles, const TermSums& to) noexcept {
  add_terms_sse(triangles, to);
}

#endif

}  // namespace hedgerow::kernels
