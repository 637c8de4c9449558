// The terms of eight triangles are computed across lanes, turned into rows, and added one after the
// other, in the order of the plain form. A sum and its count are one vector.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/normals_avx2.h"
#include "kernels/normals_weight.h"
#include "kernels/scatter_normals.h"

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

constexpr int kGroup = 8;  // triangles

constexpr unsigned kAllInside = 0xffffff;

// Bit c: corner c of the 24 is in the block.
unsigned inside(const Index* corners, const SumBlock& block) noexcept {
  const __m256i begin = _mm256_set1_epi32(static_cast<int>(block.begin));
  const __m256i last = _mm256_set1_epi32(static_cast<int>(block.size - 1));
  unsigned bits = 0;
  for (int j = 0; j < 3; ++j) {
    const __m256i local = _mm256_sub_epi32(load_indices(corners + kGroup * j), begin);
    const __m256i is_inside = _mm256_cmpeq_epi32(_mm256_min_epu32(local, last), local);
    bits |= static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(is_inside))) << kGroup * j;
  }
  return bits;
}

// The sums of a block by vertex id: their address is one shift and one addition away from it.
class Sums {
 public:
  explicit Sums(const SumBlock& block) noexcept
      : zeroth_(reinterpret_cast<std::uintptr_t>(block.sums) -
                sizeof(VertexSum) * static_cast<std::uintptr_t>(block.begin)) {}

  void add(Index v, __m128 term) const noexcept {
    auto* p =
        reinterpret_cast<float*>(zeroth_ + sizeof(VertexSum) * static_cast<std::uintptr_t>(v));
    _mm_store_ps(p, _mm_add_ps(_mm_load_ps(p), term));
  }

 private:
  std::uintptr_t zeroth_;  // of a vertex that need not be in the block
};

// What the corners of eight triangles add, as rows x, y, z, 1: row i of rows[k] is of corner k of
// triangle i, or of all three where they add the same. False: one of them needs the plain form.
template <NormalWeight W, class Loader, std::size_t kCount>
bool corner_rows(const Index* corners, const Loader& loader, Rows8 (&rows)[kCount]) noexcept {
  Vec3<Float8> p[3];
  loader.load(corners, p);
  TriangleTerms<Float8> terms;
  const Mask8 usual = triangle_terms<W>(p[0], p[1], p[2], terms);
  for (std::size_t k = 0; k < kCount; ++k) {
    rows[k] = to_rows(corner_term<W>(terms, terms.factor[k]), 1);
  }
  return usual.lanes() == 0xff;
}

// Area vectors are crossed as rows, as positions lie in memory: to turn them into lanes and back
// takes more instructions than the cross products. Only squares become lanes, to test all eight.
template <class Loader>
[[gnu::always_inline]] inline bool area_rows(const Index* corners, const Loader& loader,
                                             Rows8& rows) noexcept {
  if (loader.has_last(corners)) [[unlikely]]
    return false;
  const auto turned = [](__m256 v) { return _mm256_permute_ps(v, 0xc9); };  // y, z, x
  const __m256 one = _mm256_set_ps(1, 0, 0, 0, 1, 0, 0, 0);
  __m256 square[4];
  for (int j = 0; j < 4; ++j) {
    const Index* two = corners + 6 * j;
    const __m256 origin = loader.load_two(two[0], two[3]);
    const __m256 u = _mm256_sub_ps(loader.load_two(two[1], two[4]), origin);
    const __m256 v = _mm256_sub_ps(loader.load_two(two[2], two[5]), origin);
    // z, x, y of the cross product, and what came of the bytes behind the positions.
    const __m256 zxy = _mm256_sub_ps(_mm256_mul_ps(u, turned(v)), _mm256_mul_ps(turned(u), v));
    const __m256 area = _mm256_blend_ps(turned(zxy), _mm256_setzero_ps(), 0x88);
    square[j] = _mm256_mul_ps(area, area);
    const __m256 counted = _mm256_or_ps(area, one);
    rows.row[2 * j] = _mm256_castps256_ps128(counted);
    rows.row[2 * j + 1] = _mm256_extractf128_ps(counted, 1);
  }
  const Float8 squares(
      _mm256_hadd_ps(_mm256_hadd_ps(square[0], square[1]), _mm256_hadd_ps(square[2], square[3])));
  return is_usual(squares).lanes() == 0xff;
}

template <NormalWeight W, bool kInside, class Loader>
void scatter(IndexRange range, const Index* corners, const ScatterInput& input,
             const SumBlock& block, const Loader& loader) noexcept {
  constexpr bool kOneTerm = W == NormalWeight::area || W == NormalWeight::uniform;
  // Most often the next run of faces is the next to be added.
  const Index end_of_all = input.faces.native != nullptr ? input.faces.face_count() : range.end;
  const Sums sums(block);
  Index f = range.begin;
  for (; f + kGroup <= range.end; f += kGroup, corners += 3 * kGroup) {
    loader.prefetch(corners, 3 * static_cast<std::ptrdiff_t>(end_of_all - kGroup - f));
    const unsigned in_block = kInside ? kAllInside : inside(corners, block);
    if (in_block == 0) continue;
    Rows8 rows[kOneTerm ? 1 : 3];
    bool is_usual = false;
    if constexpr (W == NormalWeight::area) {
      is_usual = area_rows(corners, loader, rows[0]);
    } else {
      is_usual = corner_rows<W>(corners, loader, rows);
    }
    if (!is_usual) [[unlikely]] {
      scatter_triangles_scalar({f, f + kGroup}, corners, input, block, kInside);
      continue;
    }
    if (in_block == kAllInside) [[likely]] {
#pragma GCC unroll 8
      for (int i = 0; i < kGroup; ++i) {
        for (int k = 0; k < 3; ++k) sums.add(corners[3 * i + k], rows[kOneTerm ? 0 : k].row[i]);
      }
    } else {
      for (unsigned left = in_block; left != 0; left &= left - 1) {
        const int c = std::countr_zero(left);
        sums.add(corners[c], rows[kOneTerm ? 0 : c % 3].row[c / 3]);
      }
    }
  }
  scatter_triangles_scalar({f, range.end}, corners, input, block, kInside);
}

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

void scatter_triangles_avx2(IndexRange range, const Index* corners, const ScatterInput& input,
                            const SumBlock& block, bool is_inside) noexcept {
  with_weight(input.weight, [&](auto weight) {
    with_loader(input.points, [&](const auto& loader) {
      is_inside ? scatter<weight(), true>(range, corners, input, block, loader)
                : scatter<weight(), false>(range, corners, input, block, loader);
    });
  });
}

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
