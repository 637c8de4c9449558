// Eight triangles at a time, a lane each.

#include <algorithm>

#include "kernels/face_normals.h"
#include "kernels/normals_avx2.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

// The area vectors of eight triangles.
struct Areas {
  Vec3<Float8> vector;
  Float8 square;

  template <class Loader>
  [[gnu::always_inline]] Areas(const Loader& loader, const Index* corners) noexcept {
    Vec3<Float8> p[3];
    loader.load(corners, p);
    vector = cross(p[1] - p[0], p[2] - p[0]);
    square = dot(vector, vector);
  }

  [[nodiscard]] bool are_usual() const noexcept { return is_usual(square).lanes() == 0xff; }
  [[nodiscard]] Vec3<Float8> units() const noexcept {
    return vector * (Float8(1.0f) / square_root(square));
  }
};

// The normals of `range`, of whole groups and at least one. A square root and a division wait for
// each other, as long as a group takes to load; so a group is finished when the next one has been
// begun, and the processor has both to choose from.
template <class Loader>
NormalStats group_normals(IndexRange range, const Index* corners, const Points& points,
                          const Loader& loader, const NormalWriter& writer) noexcept {
  NormalStats stats;
  const Writer8 writer8(writer, range.begin);
  const auto finish = [&](Index f, const Areas& areas) {
    if (areas.are_usual()) [[likely]] {
      writer8.write(f, areas.units());
    } else {
      const Index* its = corners + 3 * static_cast<std::ptrdiff_t>(f - range.begin);
      stats = merge(stats, triangle_normals_scalar({f, f + 8}, its, points, writer));
    }
  };
  Areas areas(loader, corners);
  const Index* next_corners = corners + 24;
  Index f = range.begin;
  for (; f + 8 < range.end; f += 8, next_corners += 24) {
    loader.prefetch(next_corners, 3 * static_cast<std::ptrdiff_t>(range.end - 16 - f));
    const Areas next(loader, next_corners);
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
  const Index last = first + (range.end - first) / 8 * 8;
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

NormalStats triangle_normals_avx2(IndexRange range, const Index* corners, const Points& points,
                                  const NormalWriter& writer) noexcept {
  return with_loader(points, [&](const auto& loader) {
    return triangle_normals(range, corners, points, loader, writer);
  });
}

#else

NormalStats triangle_normals_avx2(IndexRange range, const Index* corners, const Points& points,
                                  const NormalWriter& writer) noexcept {
  return triangle_normals_scalar(range, corners, points, writer);
}

#endif

}  // namespace hedgerow::kernels
