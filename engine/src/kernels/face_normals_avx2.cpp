// Eight triangles at a time, a lane each.

#include <algorithm>

#include "kernels/face_normals.h"
#include "kernels/normals_avx2.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

template <class Loader>
NormalStats triangle_normals(IndexRange range, const Index* corners, const Points& points,
                             const Loader& loader, const NormalWriter& writer) noexcept {
  const Index head = std::min(Writer8::head(writer, range.begin), range.size());
  Index f = range.begin + head;
  NormalStats stats = triangle_normals_scalar({range.begin, f}, corners, points, writer);
  corners += 3 * head;
  const Writer8 writer8(writer, f);
  for (; f + 8 <= range.end; f += 8, corners += 24) {
    loader.prefetch(corners, 3 * static_cast<std::ptrdiff_t>(range.end - 8 - f));
    Vec3<Float8> p[3];
    loader.load(corners, p);
    TriangleTerms<Float8> terms;
    const Mask8 usual = triangle_terms<NormalWeight::uniform>(p[0], p[1], p[2], terms);
    if (usual.lanes() != 0xff) [[unlikely]] {
      stats = merge(stats, triangle_normals_scalar({f, f + 8}, corners, points, writer));
    } else {
      writer8.write(f, terms.base);
    }
  }
  return merge(stats, triangle_normals_scalar({f, range.end}, corners, points, writer));
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
