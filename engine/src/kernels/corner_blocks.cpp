#include "kernels/corner_blocks.h"

namespace hedgerow::kernels {

void count_blocks(IndexRange range, const FaceColumns& faces, int block_shift,
                  Index* counts) noexcept {
  for (Index h = faces.begin(range.begin); h < faces.begin(range.end); ++h) {
    ++counts[faces.corners[h] >> block_shift];
  }
}

void partition_corners(IndexRange range, const FaceColumns& faces, int block_shift, Index* ends,
                       LooseCorner* loose) noexcept {
  for_each_corner(range, faces, [&](Index v, const Corner& corner) {
    loose[ends[v >> block_shift]++] = {v, corner};
  });
}

void partition_corners(IndexRange range, const FaceColumns& faces, int block_shift, Index* ends,
                       LooseTriangleCorner* loose) noexcept {
  for_each_corner(range, faces, [&](Index v, const Corner& corner) {
    loose[ends[v >> block_shift]++] = {v, corner.halfedge, corner.target, corner.source};
  });
}

Index exclusive_scan(Index* counts, Index n) noexcept {
  Index sum = 0;
  for (Index i = 0; i < n; ++i) {
    const Index count = counts[i];
    counts[i] = sum;
    sum += count;
  }
  return sum;
}

}  // namespace hedgerow::kernels
