// Sixteen triangles at a time, where that pays: in rows of vertices, or where the corners of one
// differ.

#include "kernels/area_terms.h"
#include "kernels/corners_avx2.h"
#include "kernels/normals_avx512.h"
#include "kernels/pair_lanes_avx512.h"
#include "kernels/pair_runs.h"
#include "kernels/weighed_terms.h"

namespace hedgerow::kernels {

#if defined(__AVX512F__)

void fill_term_rows_avx512(const Triangles& triangles, const Points& points, NormalWeight weight,
                           TermRow* rows) noexcept {
  with_weight(weight, [&](auto w) {
    if constexpr (rows_of(w()) == 3) {
      with_loader16(points, [&](const auto& loader) {
        fill_weighed<w()>(triangles, loader, rows, [&](const Triangles& few, TermRow* to) {
          fill_term_rows_avx2(few, points, w(), to);
        });
      });
    } else {
      fill_term_rows_avx2(triangles, points, w(), rows);
    }
  });
}

void add_terms_avx512(const Triangles& triangles, const TermSums& to) noexcept {
  with_weight(to.weight, [&](auto w) {
    const auto add_few = [&](const Triangles& few) { add_terms_avx2(few, to); };
    add_pair_runs<w(), PairLanes16>(triangles, to, [&](const Triangles& others) {
      if constexpr (w() == NormalWeight::area) {
        add_all_areas<Corners>(others, to);
      } else if constexpr (rows_of(w()) == 3) {
        with_loader16(to.points, [&](const auto& loader) {
          add_all_weighed<w()>(others, to, loader, add_few);
        });
      } else {
        add_few(others);
      }
    });
  });
}

#else

void fill_term_rows_avx512(const Triangles& triangles, const Points& points, NormalWeight weight,
                           TermRow* rows) noexcept {
  fill_term_rows_avx2(triangles, points, weight, rows);
}

void add_terms_avx512(const Triangles& triangles, const TermSums& to) noexcept {
  add_terms_avx2(triangles, to);
}

#endif

}  // namespace hedgerow::kernels
