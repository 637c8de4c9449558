// The terms of eight triangles are computed across lanes, turned into rows, and added one after the
// other, in the order of the plain form. A sum and its count are one vector.

#include "kernels/normals_avx2.h"
#include "kernels/normals_weight.h"
#include "kernels/scatter_normals.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

constexpr int kGroup = 8;  // triangles

// Where the sums of the corners of eight triangles stand, in floats from the first of the block.
struct Places {
  alignas(32) int at[3][kGroup];
  unsigned inside[3];  // bit i: corner k of triangle i is in the block

  Places(const Corners8& c, const SumBlock& block) noexcept {
    const __m256i begin = _mm256_set1_epi32(static_cast<int>(block.begin));
    const __m256i last = _mm256_set1_epi32(static_cast<int>(block.size - 1));
    for (int k = 0; k < 3; ++k) {
      const __m256i local = _mm256_sub_epi32(c.corner[k], begin);
      const __m256i is_inside = _mm256_cmpeq_epi32(_mm256_min_epu32(local, last), local);
      inside[k] = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(is_inside)));
      _mm256_store_si256(reinterpret_cast<__m256i*>(at[k]), _mm256_slli_epi32(local, 2));
    }
  }
  [[nodiscard]] bool all_inside() const noexcept {
    return (inside[0] & inside[1] & inside[2]) == 0xff;
  }
  [[nodiscard]] bool none_inside() const noexcept {
    return (inside[0] | inside[1] | inside[2]) == 0;
  }
};

void add(float* sum, __m128 term) noexcept {
  _mm_store_ps(sum, _mm_add_ps(_mm_load_ps(sum), term));
}

template <NormalWeight W>
void scatter(IndexRange range, const Index* corners, const ScatterInput& input,
             const SumBlock& block) noexcept {
  constexpr bool kOneTerm = W == NormalWeight::area || W == NormalWeight::uniform;
  const __m256i stride = stride_of(input.points);
  auto* sums = reinterpret_cast<float*>(block.sums);
  Index f = range.begin;
  for (; f + kGroup <= range.end; f += kGroup, corners += 3 * kGroup) {
    const Corners8 c = load_triangles(corners);
    const Places places(c, block);
    if (places.none_inside()) continue;
    TriangleTerms<Float8> terms;
    const Mask8 usual = triangle_terms<W>(load_points(input.points, c.corner[0], stride),
                                          load_points(input.points, c.corner[1], stride),
                                          load_points(input.points, c.corner[2], stride), terms);
    if (usual.lanes() != 0xff) [[unlikely]] {
      scatter_triangles_scalar({f, f + kGroup}, corners, input, block, false);
      continue;
    }
    Rows8 rows[3];
    rows[0] = to_rows(corner_term<W>(terms, terms.factor[0]), 1);
    if constexpr (!kOneTerm) {
      rows[1] = to_rows(corner_term<W>(terms, terms.factor[1]), 1);
      rows[2] = to_rows(corner_term<W>(terms, terms.factor[2]), 1);
    }
    const bool all_inside = places.all_inside();
    for (int i = 0; i < kGroup; ++i) {
      for (int k = 0; k < 3; ++k) {
        if (!all_inside && (places.inside[k] >> i & 1) == 0) continue;
        add(sums + places.at[k][i], rows[kOneTerm ? 0 : k].row[i]);
      }
    }
  }
  scatter_triangles_scalar({f, range.end}, corners, input, block, false);
}

// The sums of eight vertices, in lanes: lane i is vertex i.
Vec3<Float8> load_sums(const VertexSum* sums) noexcept {
  const auto* p = reinterpret_cast<const float*>(sums);
  const auto pair = [&](int i) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(p + 4 * i)),
                                _mm_load_ps(p + 4 * (i + 4)), 1);
  };
  const __m256 xy_low = _mm256_unpacklo_ps(pair(0), pair(1));
  const __m256 z_low = _mm256_unpackhi_ps(pair(0), pair(1));
  const __m256 xy_high = _mm256_unpacklo_ps(pair(2), pair(3));
  const __m256 z_high = _mm256_unpackhi_ps(pair(2), pair(3));
  return {_mm256_shuffle_ps(xy_low, xy_high, 0x44), _mm256_shuffle_ps(xy_low, xy_high, 0xee),
          _mm256_shuffle_ps(z_low, z_high, 0x44)};
}

}  // namespace

void scatter_triangles_avx2(IndexRange range, const Index* corners, const ScatterInput& input,
                            const SumBlock& block, bool) noexcept {
  with_weight(input.weight, [&](auto weight) { scatter<weight()>(range, corners, input, block); });
}

NormalStats finish_sums_avx2(const SumBlock& block, const NormalWriter& writer,
                             Index& again_count) noexcept {
  NormalStats stats;
  Index i = 0;
  for (; i + 8 <= block.size; i += 8) {
    const Vec3<Float8> sum = load_sums(block.sums + i);
    const Float8 square = dot(sum, sum);
    if (is_usual(square).lanes() == 0xff) [[likely]] {
      write_units(writer, block.begin + i, sum * (Float8(1.0f) / square_root(square)));
    } else {
      const SumBlock eight{block.begin + i, 8, block.sums + i};
      stats = merge(stats, finish_sums_scalar(eight, writer, again_count));
    }
  }
  const SumBlock rest{block.begin + i, block.size - i, block.sums + i};
  return merge(stats, finish_sums_scalar(rest, writer, again_count));
}

CornerBounds native_bounds_avx2(const Index* corners, Index count) noexcept {
  const int* c = reinterpret_cast<const int*>(corners);
  int smallest = c[0];
  int largest = c[0];
  for (Index i = 0; i < count; ++i) {
    smallest = c[i] < smallest ? c[i] : smallest;
    largest = c[i] > largest ? c[i] : largest;
  }
  return {smallest, largest};
}

#else

void scatter_triangles_avx2(IndexRange range, const Index* corners, const ScatterInput& input,
                            const SumBlock& block, bool is_inside) noexcept {
  scatter_triangles_scalar(range, corners, input, block, is_inside);
}

NormalStats finish_sums_avx2(const SumBlock& block, const NormalWriter& writer,
                             Index& again_count) noexcept {
  return finish_sums_scalar(block, writer, again_count);
}

CornerBounds native_bounds_avx2(const Index* corners, Index count) noexcept {
  return native_bounds_scalar(corners, count);
}

#endif

}  // namespace hedgerow::kernels
