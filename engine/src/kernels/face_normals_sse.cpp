// Four triangles at a time: twelve 16-byte loads and three transposes instead of 36 loads of a
// float, and one square root and one division for four. PERF.md, "face normals".

#include <cstddef>

#include "kernels/face_normals.h"
#include "kernels/normals_sse.h"
#include "kernels/point_rows.h"

namespace hedgerow::kernels {

#if defined(__SSE2__)

namespace {

template <class Rows4>
NormalStats groups_of_four(IndexRange range, const Index* corners, const Points& points,
                           const Rows4& rows, const NormalWriter& writer) noexcept {
  NormalStats stats;
  const bool is_packed = writer.out.stride_bytes == sizeof(Float3);
  const Index* const end = corners + 3 * static_cast<std::ptrdiff_t>(range.size());
  const auto load = [&](const Index* v) __attribute__((always_inline)) {
    return to_lanes(rows[v[0]], rows[v[3]], rows[v[6]], rows[v[9]]);
  };
  Index f = range.begin;
  for (; f + 4 <= range.end; f += 4, corners += 12) {
    rows.template prefetch<4>(corners, end - corners - 12);
    TriangleTerms<Float4> terms;
    const bool is_plain = is_among<12>(corners, rows.last()) ||
                          !triangle_terms<NormalWeight::uniform>(load(corners), load(corners + 1),
                                                                 load(corners + 2), terms)
                               .all();
    if (is_plain) [[unlikely]] {
      stats = merge(stats, triangle_normals_scalar({f, f + 4}, corners, points, writer));
      continue;
    }
    const Rows units = to_rows(terms.base, 0);
    if (is_packed) {
      store_packed(writer.out[f], units);
    } else {
      for (Index i = 0; i < 4; ++i) writer.write(f + i, to_float3(units.row[i]));
    }
  }
  return merge(stats, triangle_normals_scalar({f, range.end}, corners, points, writer));
}

}  // namespace

NormalStats triangle_normals_sse(IndexRange range, const Index* corners, const Points& points,
                                 const NormalWriter& writer) noexcept {
  return with_point_rows(points, [&](const auto& rows) {
    return groups_of_four(range, corners, points, rows, writer);
  });
}

#else

NormalStats triangle_normals_sse(IndexRange range, const Index* corners, const Points& points,
                                 const NormalWriter& writer) noexcept {
  return triangle_normals_scalar(range, corners, points, writer);
}

#endif

}  // namespace hedgerow::kernels
