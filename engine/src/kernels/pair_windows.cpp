#include "kernels/pair_windows.h"

#include <algorithm>

namespace hedgerow::kernels {

namespace {

// The corners of a pair that are one vertex: at most one of each triangle.
struct SameVertex {
  Index offset = 0;
  signed char corner[2] = {-1, -1};
};

// By descending offset. Returns how many, or 0 if a triangle has a vertex twice.
Index group_corners(const Index* offsets, SameVertex* groups) noexcept {
  Index count = 0;
  for (Index j = 0; j < kPairCorners; ++j) {
    const Index triangle = j / 3;
    SameVertex* const end = groups + count;
    SameVertex* group = std::find_if(
        groups, end, [&](const SameVertex& other) { return other.offset <= offsets[j]; });
    if (group == end || group->offset != offsets[j]) {
      std::move_backward(group, end, end + 1);
      *group = SameVertex{offsets[j]};
      ++count;
    }
    if (group->corner[triangle] >= 0) return 0;
    group->corner[triangle] = static_cast<signed char>(j % 3);
  }
  return count;
}

}  // namespace

// Vertex v meets pair v - offset, so of two corners that with the larger offset meets it first:
// windows go by descending offset. Two offsets that differ by one are one window, so that sums are
// not loaded again right after they were stored a vertex further on, for which a processor waits.
bool PairWindows::find_new(const Index* corners) noexcept {
  for (Index j = 0; j < kPairCorners; ++j) offset_[j] = corners[j] - corners[0];
  SameVertex groups[kPairCorners];
  const Index group_count = group_corners(offset_, groups);
  count_ = 0;
  for (Index i = 0; i < group_count; ++i) {
    PairWindow& window = windows_[count_++] = {};
    const bool has_next = i + 1 < group_count && groups[i].offset == groups[i + 1].offset + 1;
    if (has_next) std::copy_n(groups[i++].corner, 2, window.high);
    window.first = groups[i].offset;
    std::copy_n(groups[i].corner, 2, window.low);
  }
  return count_ > 0;
}

}  // namespace hedgerow::kernels
