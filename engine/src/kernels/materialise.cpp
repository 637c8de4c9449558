#include "kernels/materialise.h"

namespace hedgerow::kernels {

void fill_triangle_columns(IndexRange faces, Index* next, Index* face, Index* first) noexcept {
  for (Index f = faces.begin; f < faces.end; ++f) {
    const Index h = 3 * f;
    first[f] = h;
    next[h] = h + 1;
    next[h + 1] = h + 2;
    next[h + 2] = h;
    face[h] = face[h + 1] = face[h + 2] = f;
  }
}

void fill_polygon_columns(IndexRange faces, const Index* first, Index* next, Index* face) noexcept {
  for (Index f = faces.begin; f < faces.end; ++f) {
    const Index begin = first[f];
    const Index end = first[f + 1];
    for (Index h = begin; h < end; ++h) {
      next[h] = h + 1;
      face[h] = f;
    }
    if (begin < end) next[end - 1] = begin;
  }
}

}  // namespace hedgerow::kernels
