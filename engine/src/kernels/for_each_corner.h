#pragma once

#include "kernels/face_columns.h"
#include "kernels/prefetch.h"

namespace hedgerow::kernels {

/// One corner of a vertex v: the half-edge that leaves v and the one that enters v in its face.
struct Corner {
  Index halfedge;  ///< v -> target
  Index target;
  Index source;
  Index incoming;  ///< source -> v, the half-edge before `halfedge`
};

/// Calls visit(vertex, Corner) for each corner of the faces in `range`, in half-edge order.
template <class Visit>
void for_each_corner(IndexRange range, const FaceColumns& faces, const Visit& visit) noexcept {
  const Index* c = faces.corners;
  if (faces.is_triangles()) {
    for (Index h = 3 * range.begin; h < 3 * range.end; h += 3) {
      prefetch_ahead(c + h);
      const Index v0 = c[h];
      const Index v1 = c[h + 1];
      const Index v2 = c[h + 2];
      visit(v0, Corner{h, v1, v2, h + 2});
      visit(v1, Corner{h + 1, v2, v0, h});
      visit(v2, Corner{h + 2, v0, v1, h + 1});
    }
    return;
  }
  for (Index f = range.begin; f < range.end; ++f) {
    const Index end = faces.first[f + 1];
    Index previous = end - 1;
    for (Index h = faces.first[f]; h < end; ++h) {
      const Index next = h + 1 < end ? h + 1 : faces.first[f];
      visit(c[h], Corner{h, c[next], c[previous], previous});
      previous = h;
    }
  }
}

}  // namespace hedgerow::kernels
