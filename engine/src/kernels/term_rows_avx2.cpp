// Eight triangles at a time, a lane each; areas one after the other, as rows.

#include "kernels/area_terms.h"
#include "kernels/corners_avx2.h"
#include "kernels/normals_avx2.h"
#include "kernels/pair_lanes_avx2.h"
#include "kernels/pair_runs.h"
#include "kernels/term_groups.h"
#include "kernels/weighed_terms.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

// Unit normals: eight triangles, a lane each, turned into rows.
template <class Loader>
struct UnitGroups {
  static constexpr NormalWeight kWeight = NormalWeight::uniform;
  static constexpr auto fill_rest = fill_term_rows_sse;
  static constexpr auto add_rest = add_terms_sse;
  static constexpr Index kSize = 8;

  const Loader& loader;

  [[gnu::always_inline]] void prefetch(const Index* corners, std::ptrdiff_t left) const noexcept {
    loader.prefetch(corners, left);
  }
  static std::uint64_t inside(const Index* corners, const SumBlock& block) noexcept {
    return Corners<kSize>::inside(corners, block);
  }
  [[gnu::always_inline]] bool make(const Index* corners, __m128* rows) const noexcept {
    Vec3<Float8> p[3];
    loader.load(corners, p);
    TriangleTerms<Float8> terms;
    const Mask8 usual = triangle_terms<kWeight>(p[0], p[1], p[2], terms);
    const Rows8 eight = to_rows(terms.base, 1);
    for (int i = 0; i < kSize; ++i) rows[i] = eight.row[i];
    return usual.all();
  }
};

}  // namespace

void fill_term_rows_avx2(const Triangles& triangles, const Points& points, NormalWeight weight,
                         TermRow* rows) noexcept {
  with_weight(weight, [&](auto w) {
    if constexpr (w() == NormalWeight::area)
      return fill_area_rows<Corners>(triangles, points, rows);
    with_loader(points, [&]<class Loader>(const Loader& loader) {
      if constexpr (rows_of(w()) == 3) {
        fill_weighed<w()>(triangles, loader, rows, [&](const Triangles& few, TermRow* to) {
          fill_term_rows_sse(few, points, w(), to);
        });
      } else {
        fill_groups(triangles, points, UnitGroups<Loader>{loader}, rows);
      }
    });
  });
}

void add_terms_avx2(const Triangles& triangles, const TermSums& to) noexcept {
  with_weight(to.weight, [&](auto w) {
    add_pair_runs<w(), PairLanes8>(triangles, to, [&](const Triangles& others) {
      if constexpr (w() == NormalWeight::area) {
        add_all_areas<Corners>(others, to);
      } else {
        with_loader(to.points, [&]<class Loader>(const Loader& loader) {
          if constexpr (rows_of(w()) == 3) {
            add_all_weighed<w()>(others, to, loader,
                                 [&](const Triangles& few) { add_terms_sse(few, to); });
          } else {
            add_all_groups(others, to, UnitGroups<Loader>{loader});
          }
        });
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
