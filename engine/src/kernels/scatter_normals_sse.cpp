// Four sums at a time.

#include "kernels/normals_sse.h"
#include "kernels/scatter_normals.h"

namespace hedgerow::kernels {

#if defined(__SSE2__)

NormalStats finish_sums_sse(const SumBlock& block, const NormalWriter& writer,
                            Index& again_count) noexcept {
  NormalStats stats;
  const bool is_packed = writer.out.stride_bytes == sizeof(Float3);
  const auto row = [&](Index i) {
    return _mm_load_ps(reinterpret_cast<const float*>(block.sums + i));
  };
  Index i = 0;
  for (; i + 4 <= block.size; i += 4) {
    const Vec3<Float4> sum = to_lanes(row(i), row(i + 1), row(i + 2), row(i + 3));
    const Float4 square = dot(sum, sum);
    if (!is_usual(square).all()) [[unlikely]] {
      const SumBlock four{block.begin + i, 4, block.sums + i};
      stats = merge(stats, finish_sums_scalar(four, writer, again_count));
      continue;
    }
    const Rows units = to_rows(sum * (Float4(1.0f) / square_root(square)), 0);
    if (is_packed) {
      store_packed(writer.out[block.begin + i], units);
    } else {
      for (Index k = 0; k < 4; ++k) writer.write(block.begin + i + k, to_float3(units.row[k]));
    }
  }
  const SumBlock rest{block.begin + i, block.size - i, block.sums + i};
  return merge(stats, finish_sums_scalar(rest, writer, again_count));
}

#else

NormalStats finish_sums_sse(const SumBlock& block, const NormalWriter& writer,
                            Index& again_count) noexcept {
  return finish_sums_scalar(block, writer, again_count);
}

#endif

}  // namespace hedgerow::kernels
