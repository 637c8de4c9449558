#include "kernels/planar_faces.h"

#include <algorithm>

namespace hedgerow::kernels {
namespace {

// The next side round the face on the left.
Index along_face(Index side, const Side* sides) noexcept { return sides[side ^ 1].prev; }

}  // namespace

void mark_outside(Index side, Side* sides) noexcept {
  for (Index s = side; sides[s].corner != kOutside; s = along_face(s, sides)) {
    sides[s].corner = kOutside;
  }
}

Index number_corners(Index side_count, Side* sides) noexcept {
  Index h = 0;
  for (Index s = 0; s < side_count; ++s) {
    if (sides[s].origin < 0 || sides[s].corner != -1) continue;
    const Index second = along_face(s, sides);
    const Index third = along_face(second, sides);
    sides[s].corner = h++;
    sides[second].corner = h++;
    sides[third].corner = h++;
  }
  return h;
}

void fill_triangles(Index side_count, const Side* sides, const Index* order, Index* origin,
                    Index* opposite) noexcept {
  for (Index s = 0; s < side_count; ++s) {
    const Index h = sides[s].corner;
    if (sides[s].origin < 0 || h < 0) continue;
    origin[h] = order[sides[s].origin];
    opposite[h] = std::max(sides[s ^ 1].corner, kInvalidIndex);
  }
}

void fill_starts(IndexRange points, Index side_count, const Side* sides, Index* starts) noexcept {
  std::fill(starts + points.begin, starts + points.end, kInvalidIndex);
  for (Index s = 0; s < side_count; ++s) {
    const auto [p, next, prev, h] = sides[s];
    if (p < 0 || h < 0) continue;
    if (starts[p] < 0 || h < starts[p]) starts[p] = h;
  }
  for (Index s = 0; s < side_count; ++s) {
    const auto [p, next, prev, h] = sides[s];
    // The last side of the rotation, counter-clockwise; the triangle before it is the first.
    if (p >= 0 && h == kOutside) starts[p] = std::max(sides[prev].corner, kInvalidIndex);
  }
}

}  // namespace hedgerow::kernels
