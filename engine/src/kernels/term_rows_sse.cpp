// Four triangles at a time, a lane each, turned into rows; areas as rows from the start.

#include "kernels/area_terms.h"
#include "kernels/normals_sse.h"
#include "kernels/pair_lanes_sse.h"
#include "kernels/pair_runs.h"
#include "kernels/term_groups.h"

namespace hedgerow::kernels {

#if defined(__SSE2__)

namespace {

template <Index kTriangles>
struct Corners {
  static constexpr Index kSize = kTriangles;

  static std::uint64_t inside(const Index* corners, const SumBlock& block) noexcept {
    std::uint64_t bits = 0;
    for (int c = 0; c < 3 * kSize; ++c) bits |= std::uint64_t{block.holds(corners[c])} << c;
    return bits;
  }
  [[gnu::always_inline]] static bool is_among(const Index* corners, Index v) noexcept {
    return kernels::is_among<3 * kSize>(corners, v);
  }
};

template <NormalWeight W>
struct Groups4 {
  static_assert(W != NormalWeight::area);
  static constexpr NormalWeight kWeight = W;
  static constexpr auto fill_rest = fill_term_rows_scalar;
  static constexpr auto add_rest = add_terms_scalar;
  static constexpr Index kSize = 4;

  const Points& points;

  static void prefetch(const Index*, std::ptrdiff_t) noexcept {}

  static std::uint64_t inside(const Index* corners, const SumBlock& block) noexcept {
    return Corners<kSize>::inside(corners, block);
  }

  bool make(const Index* corners, __m128* rows) const noexcept {
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
};

}  // namespace

void fill_term_rows_sse(const Triangles& triangles, const Points& points, NormalWeight weight,
                        TermRow* rows) noexcept {
  with_weight(weight, [&](auto w) {
    if constexpr (w() == NormalWeight::area) {
      fill_area_rows<Corners>(triangles, points, rows);
    } else {
      fill_groups(triangles, points, Groups4<w()>{points}, rows);
    }
  });
}

void add_terms_sse(const Triangles& triangles, const TermSums& to) noexcept {
  with_weight(to.weight, [&](auto w) {
    if constexpr (w() == NormalWeight::area) {
      add_all_areas<Corners>(triangles, to);
    } else {
      add_pair_runs<w(), PairLanes4>(triangles, to, [&](const Triangles& others) {
        add_all_groups(others, to, Groups4<w()>{to.points});
      });
    }
  });
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
