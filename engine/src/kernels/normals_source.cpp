#include "kernels/normals_source.h"

#include <algorithm>

namespace hedgerow::kernels {

BadFaces find_bad_faces(IndexRange range, const FaceSource& faces) noexcept {
  BadFaces bad;
  for (Index f = range.begin; f < range.end; ++f) {
    const IndexRange corners{faces.begin(f), faces.begin(f + 1)};
    if (corners.size() == 0) continue;
    const CornerBounds bounds = corner_bounds(corners, faces);
    if (bounds.smallest >= 0 && bounds.largest < faces.list.vertex_count) continue;
    if (bad.count == 0) bad.first = f;
    ++bad.count;
  }
  return bad;
}

CornerBounds corner_bounds(IndexRange corners, const FaceSource& faces) noexcept {
  if (faces.native == nullptr) {
    CornerBounds bounds{faces.raw_corner(corners.begin), faces.raw_corner(corners.begin)};
    for (Index c = corners.begin; c < corners.end; ++c) {
      const std::int64_t v = faces.raw_corner(c);
      bounds.smallest = std::min(bounds.smallest, v);
      bounds.largest = std::max(bounds.largest, v);
    }
    return bounds;
  }
  const Index* first = faces.native + corners.begin;
  return has_avx2() ? native_bounds_avx2(first, corners.size())
                    : native_bounds_scalar(first, corners.size());
}

// Plain minima and maxima of one integer type, which the compiler turns into vectors.
CornerBounds native_bounds_scalar(const Index* corners, Index count) noexcept {
  Index smallest = corners[0];
  Index largest = corners[0];
  for (Index i = 0; i < count; ++i) {
    smallest = corners[i] < smallest ? corners[i] : smallest;
    largest = corners[i] > largest ? corners[i] : largest;
  }
  return {smallest, largest};
}

}  // namespace hedgerow::kernels
