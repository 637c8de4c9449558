#include "kernels/corner_blocks.h"

#include <type_traits>

namespace hedgerow::kernels {

namespace {

using Unsigned = std::make_unsigned_t<Index>;

// Calls visit(vertex, Corner) for each corner of the faces in `range`, in half-edge order.
template <class Visit>
void for_each_corner(IndexRange range, const FaceColumns& faces, const Visit& visit) noexcept {
  const Index* c = faces.corners;
  if (faces.is_triangles()) {
    for (Index h = 3 * range.begin; h < 3 * range.end; h += 3) {
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

}  // namespace

void count_corners(IndexRange range, const FaceColumns& faces, VertexBlock block,
                   Index* counts) noexcept {
  const auto size = static_cast<Unsigned>(block.size);
  for (Index h = faces.begin(range.begin); h < faces.begin(range.end); ++h) {
    const auto local = static_cast<Unsigned>(faces.corners[h] - block.begin);
    if (local < size) ++counts[local];
  }
}

void place_corners(IndexRange range, const FaceColumns& faces, VertexBlock block, Index* ends,
                   Corner* corners) noexcept {
  const auto size = static_cast<Unsigned>(block.size);
  for_each_corner(range, faces, [&](Index v, const Corner& corner) {
    const auto local = static_cast<Unsigned>(v - block.begin);
    if (local < size) corners[ends[local]++] = corner;
  });
}

void count_loose(std::span<const LooseCorner> loose, VertexBlock block, Index* counts) noexcept {
  for (const LooseCorner& l : loose) ++counts[l.vertex - block.begin];
}

void place_loose(std::span<const LooseCorner> loose, VertexBlock block, Index* ends,
                 Corner* corners) noexcept {
  for (const LooseCorner& l : loose) corners[ends[l.vertex - block.begin]++] = l.corner;
}

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
