// Eight vertices are eight lanes, which walk round their rings together; several such groups walk
// at once, as each step waits for memory. What is found is added vertex by vertex: in place, each
// reads what the one before it has just written.

#include <cstddef>
#include <cstdint>

#include "kernels/smooth_vertices.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

constexpr int kLanes = 8;
constexpr int kGroups = RingTable::kVertices / kLanes;

__m256i gather(const Index* from, __m256i at, __m256i where) noexcept {
  return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), reinterpret_cast<const int*>(from), at,
                                     where, 4);
}

// A multiple of 3 times the inverse of 3 is at most 2^32 / 3: Granlund, Montgomery, Division by
// Invariant Integers using Multiplication, 1994, section 9.
__m256i next(__m256i h) noexcept {
  const __m256i after = _mm256_add_epi32(h, _mm256_set1_epi32(1));
  const __m256i product =
      _mm256_mullo_epi32(after, _mm256_set1_epi32(static_cast<int>(0xaaaaaaab)));
  const __m256i least = _mm256_min_epu32(product, _mm256_set1_epi32(0x55555555));
  const __m256i wraps = _mm256_cmpeq_epi32(least, product);
  return _mm256_sub_epi32(after, _mm256_and_si256(wraps, _mm256_set1_epi32(3)));
}

struct Lanes {
  __m256i start;
  __m256i at;
  __m256i walks;    // -1: still on its way
  __m256i is_open;  // -1: came to the boundary, or has no half-edge
  __m256i valence;
  __m256i last;  // the neighbour before it was back
};

Lanes begin_at(const Index* outgoing) noexcept {
  Lanes lanes;
  lanes.start = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(outgoing));
  lanes.at = lanes.start;
  lanes.is_open = _mm256_cmpgt_epi32(_mm256_setzero_si256(), lanes.start);
  lanes.walks = _mm256_xor_si256(lanes.is_open, _mm256_set1_epi32(-1));
  lanes.valence = _mm256_setzero_si256();
  lanes.last = _mm256_setzero_si256();
  return lanes;
}

// Where the lane does not walk any more, or has come to the boundary, the neighbour is vertex 0:
// one that exists.
__m256i walk_on(const TriangleView& mesh, Lanes& lanes) noexcept {
  const __m256i opposite = gather(mesh.opposite.data(), lanes.at, lanes.walks);
  const __m256i is_boundary = _mm256_cmpgt_epi32(_mm256_setzero_si256(), opposite);
  lanes.is_open = _mm256_or_si256(lanes.is_open, is_boundary);
  lanes.walks = _mm256_andnot_si256(is_boundary, lanes.walks);
  const __m256i neighbour = gather(mesh.origin.data(), opposite, lanes.walks);
  lanes.last = _mm256_blendv_epi8(lanes.last, neighbour, lanes.walks);
  lanes.valence = _mm256_sub_epi32(lanes.valence, lanes.walks);
  lanes.at = next(opposite);
  lanes.walks = _mm256_andnot_si256(_mm256_cmpeq_epi32(lanes.at, lanes.start), lanes.walks);
  return neighbour;
}

__m256i* row_of(RingTable& table, int row, int g) noexcept {
  return reinterpret_cast<__m256i*>(&table.neighbour[row][g * kLanes]);
}

// In each ring that has the vertex before its own, that one and the last change places.
void put_newest_last(Index first, int g, int rows, const Lanes& lanes, RingTable& table) noexcept {
  const __m256i newest = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first) + g * kLanes),
                                          _mm256_setr_epi32(-1, 0, 1, 2, 3, 4, 5, 6));
  const __m256i top = _mm256_sub_epi32(lanes.valence, _mm256_set1_epi32(1));
  __m256i is_found = _mm256_setzero_si256();
  for (int r = 0; r < rows; ++r) {
    const __m256i neighbour = _mm256_loadu_si256(row_of(table, r, g));
    const __m256i is_newest = _mm256_cmpeq_epi32(neighbour, newest);
    is_found = _mm256_or_si256(is_found, is_newest);
    const __m256i is_top =
        _mm256_and_si256(is_found, _mm256_cmpeq_epi32(top, _mm256_set1_epi32(r)));
    const __m256i others = _mm256_blendv_epi8(neighbour, lanes.last, is_newest);
    _mm256_storeu_si256(row_of(table, r, g), _mm256_blendv_epi8(others, newest, is_top));
  }
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(&table.valence[g * kLanes]), lanes.valence);
}

// Position u without what lies behind it. Two loads, of the sizes in which positions are stored:
// one that is wider than what was just stored has to wait for it to reach the cache.
__m128 load(const float* p) noexcept {
  const __m128 xy = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
  return _mm_insert_ps(xy, _mm_load_ss(p + 2), 0x20);
}
void store(__m128 place, float* p) noexcept {
  _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_castps_si128(place));
  _mm_store_ss(p + 2, _mm_movehl_ps(place, place));
}

// Strides of packed positions are known, others multiplied with.
template <std::size_t stride>
const float* at(const Positions& positions, Index v) noexcept {
  if constexpr (stride == 0) return positions[v];
  return reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(positions.data) +
                                        static_cast<std::size_t>(v) * stride);
}

template <std::size_t stride>
int smooth_run(Index first, int begin, int end, const RingTable& table,
               const SmoothStep& step) noexcept {
  float shares[RingTable::kMostNeighbours + 1];
  for (Index n = 1; n <= RingTable::kMostNeighbours; ++n) shares[n] = umbrella_share(step, n);
  const __m128 rest = _mm_set1_ps(1 - step.step);
  for (int i = begin; i < end; ++i) {
    const Index valence = table.valence[i];
    __m128 sum = load(at<stride>(step.from, table.neighbour[0][i]));
    for (Index r = 1; r < valence; ++r) {
      sum = _mm_add_ps(sum, load(at<stride>(step.from, table.neighbour[r][i])));
    }
    const __m128 here = load(at<stride>(step.from, first + i));
    const __m128 place =
        _mm_add_ps(_mm_mul_ps(sum, _mm_set1_ps(shares[valence])), _mm_mul_ps(here, rest));
    // What is not finite is no number after this.
    const __m128 nothing = _mm_sub_ps(place, place);
    if (_mm_movemask_ps(_mm_cmpunord_ps(nothing, nothing)) != 0) [[unlikely]]
      return i;
    store(place, step.to[first + i]);
  }
  return end;
}

}  // namespace

std::uint32_t find_rings_avx2(Index first, const TriangleView& mesh, RingTable& table) noexcept {
  Lanes lanes[kGroups];
  for (int g = 0; g < kGroups; ++g) lanes[g] = begin_at(mesh.outgoing.data() + first + g * kLanes);
  int rows = 0;
  for (bool is_on = true; is_on && rows < RingTable::kMostNeighbours; ++rows) {
    __m256i any = _mm256_setzero_si256();
    for (int g = 0; g < kGroups; ++g) {
      _mm256_storeu_si256(row_of(table, rows, g), walk_on(mesh, lanes[g]));
      any = _mm256_or_si256(any, lanes[g].walks);
    }
    is_on = _mm256_movemask_epi8(any) != 0;
  }
  std::uint32_t listed = 0;
  for (int g = 0; g < kGroups; ++g) {
    put_newest_last(first, g, rows, lanes[g], table);
    const __m256i is_left = _mm256_or_si256(lanes[g].is_open, lanes[g].walks);
    const int left = _mm256_movemask_ps(_mm256_castsi256_ps(is_left));
    listed |= (~static_cast<std::uint32_t>(left) & 0xffU) << (g * kLanes);
  }
  return listed;
}

int smooth_listed_avx2(Index first, int begin, int end, const RingTable& table,
                       const SmoothStep& step) noexcept {
  constexpr std::size_t kPacked = 3 * sizeof(float);
  return step.from.stride_bytes == kPacked ? smooth_run<kPacked>(first, begin, end, table, step)
                                           : smooth_run<0>(first, begin, end, table, step);
}

#else

std::uint32_t find_rings_avx2(Index, const TriangleView&, RingTable&) noexcept { return 0; }

int smooth_listed_avx2(Index, int begin, int, const RingTable&, const SmoothStep&) noexcept {
  return begin;
}

#endif

}  // namespace hedgerow::kernels
