// Eight sums at a time.

#include <algorithm>

#include "kernels/normals_avx2.h"
#include "kernels/prefetch.h"
#include "kernels/scatter_normals.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

// The sums of eight vertices, in lanes: lane i is vertex i.
Vec3<Float8> load_sums(const VertexSum* sums) noexcept {
  const auto* p = reinterpret_cast<const float*>(sums);
  const auto pair = [&](int i) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(p + 4 * i)),
                                _mm_load_ps(p + 4 * (i + 4)), 1);
  };
  return to_lanes(pair(0), pair(1), pair(2), pair(3));
}

}  // namespace

NormalStats finish_sums_avx2(const SumBlock& block, const NormalWriter& writer,
                             Index& again_count) noexcept {
  Index i = std::min(Writer8::head(writer, block.begin), block.size);
  NormalStats stats = finish_sums_scalar({block.begin, i, block.sums}, writer, again_count);
  const Writer8 writer8(writer, block.begin + i);
  for (; i + 8 <= block.size; i += 8) {
    const Vec3<Float8> sum = load_sums(block.sums + i);
    const Float8 square = dot(sum, sum);
    if (is_usual(square).lanes() == 0xff) [[likely]] {
      writer8.write(block.begin + i, sum * (Float8(1.0f) / square_root(square)));
    } else {
      const SumBlock eight{block.begin + i, 8, block.sums + i};
      stats = merge(stats, finish_sums_scalar(eight, writer, again_count));
    }
  }
  const SumBlock rest{block.begin + i, block.size - i, block.sums + i};
  return merge(stats, finish_sums_scalar(rest, writer, again_count));
}

CornerBounds native_bounds_avx2(const Index* corners, Index count) noexcept {
  constexpr Index kLine = 16;
  __m256i smallest = _mm256_set1_epi32(static_cast<int>(corners[0]));
  __m256i largest = smallest;
  Index i = 0;
  for (; i + kLine <= count; i += kLine) {
    prefetch_ahead(corners + i);
    const __m256i first = load_indices(corners + i);
    const __m256i second = load_indices(corners + i + 8);
    smallest = _mm256_min_epi32(smallest, _mm256_min_epi32(first, second));
    largest = _mm256_max_epi32(largest, _mm256_max_epi32(first, second));
  }
  alignas(32) int lanes[2][8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(lanes[0]), smallest);
  _mm256_store_si256(reinterpret_cast<__m256i*>(lanes[1]), largest);
  CornerBounds bounds{*std::min_element(lanes[0], lanes[0] + 8),
                      *std::max_element(lanes[1], lanes[1] + 8)};
  for (; i < count; ++i) {
    bounds.smallest = std::min<std::int64_t>(bounds.smallest, corners[i]);
    bounds.largest = std::max<std::int64_t>(bounds.largest, corners[i]);
  }
  return bounds;
}

#else

NormalStats finish_sums_avx2(const SumBlock& block, const NormalWriter& writer,
                             Index& again_count) noexcept {
  return finish_sums_sse(block, writer, again_count);
}

CornerBounds native_bounds_avx2(const Index* corners, Index count) noexcept {
  return native_bounds_scalar(corners, count);
}

#endif

}  // namespace hedgerow::kernels
