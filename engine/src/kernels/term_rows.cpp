#include "kernels/term_rows.h"

#include "kernels/normals_weight.h"

namespace hedgerow::kernels {

namespace {

// Calls visit(corner, row) for each row, the first corner of the triangle with the only one.
template <NormalWeight W, class Visit>
void for_each_row(const Triangles& triangles, const Points& points, const Visit& visit) noexcept {
  const Index* corners = triangles.corners;
  for (Index i = 0; i < triangles.count; ++i, corners += 3) {
    Float3 terms[3];
    triangle_corners<W>(points[corners[0]], points[corners[1]], points[corners[2]], terms);
    for (int k = 0; k < 3; ++k) visit(corners[k], k, TermRow{terms[k], 1});
  }
}

}  // namespace

void fill_term_rows(const Triangles& triangles, const Points& points, NormalWeight weight,
                    TermRow* rows) noexcept {
  const auto fill = suits_avx512(points) ? fill_term_rows_avx512
                    : suits_avx2(points) ? fill_term_rows_avx2
                                         : fill_term_rows_sse;
  fill(triangles, points, weight, rows);
}

void add_terms(const Triangles& triangles, const TermSums& to) noexcept {
  const auto add = suits_avx512(to.points) ? add_terms_avx512
                   : suits_avx2(to.points) ? add_terms_avx2
                                           : add_terms_sse;
  add(triangles, to);
}

void fill_term_rows_scalar(const Triangles& triangles, const Points& points, NormalWeight weight,
                           TermRow* rows) noexcept {
  with_weight(weight, [&](auto w) {
    for_each_row<w()>(triangles, points, [&](Index, int k, const TermRow& row) {
      if (k < rows_of(w())) *rows++ = row;
    });
  });
}

void add_terms_scalar(const Triangles& triangles, const TermSums& to) noexcept {
  with_weight(to.weight, [&](auto w) {
    for_each_row<w()>(triangles, to.points, [&](Index v, int, const TermRow& row) {
      if (!to.is_inside && !to.block.holds(v)) return;
      TermRow& sum = to.block[v];
      sum.term = sum.term + row.term;
      sum.count += row.count;
    });
  });
}

}  // namespace hedgerow::kernels
