// Eight triangles at a time.

#include "kernels/face_groups.h"
#include "kernels/normals_avx2.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

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
