#pragma once

#include <algorithm>

#include "kernels/face_normals.h"
#include "kernels/normals_avx2.h"

#if defined(__AVX2__)

/// Face normals of triangles, a lane each, as many at a time as a loader loads. Local to each
/// source, as those are compiled for different processors.
namespace hedgerow::kernels {
namespace {

// The area vectors of a group of triangles.
template <class Loader>
struct Areas {
  using Float = typename Loader::Float;

  Vec3<Float> vector;
  Float square;

  [[gnu::always_inline]] Areas(const Loader& loader, const Index* corners) noexcept {
    Vec3<Float> p[3];
    loader.load(corners, p);
    vector = cross(p[1] - p[0], p[2] - p[0]);
    square = dot(vector, vector);
  }

  [[nodiscard]] bool are_usual() const noexcept { return is_usual(square).all(); }
  [[nodiscard]] Vec3<Float> units() const noexcept {
    return vector * (Float(1.0f) / square_root(square));
  }
};

// The normals of `range`, of whole groups and at least one. A square root and a division wait for
// each other, as long as a group takes to load; so a group is finished when the next one has been
// begun, and the processor has both to choose from.
template <class Loader>
NormalStats group_normals(IndexRange range, const Index* corners, const Points& points,
                          const Loader& loader, const NormalWriter& writer) noexcept {
  constexpr Index kLanes = Loader::kLanes;
  NormalStats stats;
  const Writer8 writer8(writer, range.begin);
  const auto finish = [&](Index f, const Areas<Loader>& areas) {
    if (areas.are_usual()) [[likely]] {
      write(writer8, f, areas.units());
    } else {
      const Index* its = corners + 3 * static_cast<std::ptrdiff_t>(f - range.begin);
      stats = merge(stats, triangle_normals_scalar({f, f + kLanes}, its, points, writer));
    }
  };
  Areas<Loader> areas(loader, corners);
  const Index* next_corners = corners + 3 * kLanes;
  Index f = range.begin;
  for (; f + kLanes < range.end; f += kLanes, next_corners += 3 * kLanes) {
    loader.prefetch(next_corners, 3 * static_cast<std::ptrdiff_t>(range.end - 2 * kLanes - f));
    const Areas<Loader> next(loader, next_corners);
    finish(f, areas);
    areas = next;
  }
  finish(f, areas);
  return stats;
}

template <class Loader>
NormalStats triangle_normals(IndexRange range, const Index* corners, const Points& points,
                             const Loader& loader, const NormalWriter& writer) noexcept {
  const Index first = range.begin + std::min(Writer8::head(writer, range.begin), range.size());
  const Index last = first + (range.end - first) / Loader::kLanes * Loader::kLanes;
  const auto corners_of = [&](Index f) {
    return corners + 3 * static_cast<std::ptrdiff_t>(f - range.begin);
  };
  NormalStats stats = triangle_normals_scalar({range.begin, first}, corners, points, writer);
  if (first < last) {
    stats = merge(stats, group_normals({first, last}, corners_of(first), points, loader, writer));
  }
  return merge(stats, triangle_normals_scalar({last, range.end}, corners_of(last), points, writer));
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
