// Four triangles are three vectors of indices. "In range" and "in this block" do not care which
// corner an index is, so no transpose is needed; "no vertex twice" compares each index with those
// one and two places on, and masks out the comparisons that leave the triangle.

#include <algorithm>

#include "kernels/check_faces.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace hedgerow::kernels {

#if defined(__SSE2__)

namespace {

constexpr Index kGroup = 4;  // triangles
constexpr Index kTail = 2;   // indices behind a group that are read too

struct Bounds {
  __m128i last_vertex;
  __m128i block;
  __m128i shift;
};

struct Group {
  bool is_good;
  bool is_in_block;
};

__m128i load(const Index* p) noexcept {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
}

// Lane i of vector j holds index 4j + i: whether the next one (two) belong to the same triangle.
Group look_at(const Index* c, const Bounds& bounds) noexcept {
  const __m128i next_in[3] = {_mm_setr_epi32(-1, -1, 0, -1), _mm_setr_epi32(-1, 0, -1, -1),
                              _mm_setr_epi32(0, -1, -1, 0)};
  const __m128i after_in[3] = {_mm_setr_epi32(-1, 0, 0, -1), _mm_setr_epi32(0, 0, -1, 0),
                               _mm_setr_epi32(0, -1, 0, 0)};
  __m128i sign = _mm_setzero_si128();
  __m128i equal = _mm_setzero_si128();
  __m128i differs = _mm_setzero_si128();
  for (int j = 0; j < 3; ++j) {
    const __m128i v = load(c + 4 * j);
    sign = _mm_or_si128(sign, _mm_or_si128(v, _mm_sub_epi32(bounds.last_vertex, v)));
    const __m128i next = _mm_and_si128(_mm_cmpeq_epi32(v, load(c + 4 * j + 1)), next_in[j]);
    const __m128i after = _mm_and_si128(_mm_cmpeq_epi32(v, load(c + 4 * j + 2)), after_in[j]);
    equal = _mm_or_si128(equal, _mm_or_si128(next, after));
    differs = _mm_or_si128(differs, _mm_xor_si128(v, bounds.block));
  }
  const __m128i bad = _mm_or_si128(_mm_srai_epi32(sign, 31), equal);
  const __m128i outside = _mm_srl_epi32(differs, bounds.shift);
  return {_mm_movemask_epi8(bad) == 0,
          _mm_movemask_epi8(_mm_cmpeq_epi32(outside, _mm_setzero_si128())) == 0xffff};
}

}  // namespace

bool check_triangle_runs_sse(IndexRange range, const FaceColumns& faces, Index run_length,
                             int block_shift, RunBlocks* runs, FaceCheck& check) noexcept {
  if constexpr (sizeof(Index) != 4) return false;
  Bounds bounds = {
      _mm_set1_epi32(static_cast<int>(faces.vertex_count - 1)), {}, _mm_cvtsi32_si128(block_shift)};
  const Index readable = faces.halfedge_count() - kTail;
  for (Index r = range.begin; r < range.end; ++r) {
    RunBlocks& run = runs[r];
    run.count = 0;
    Index f = r * run_length;
    const Index end = std::min(faces.face_count, f + run_length);
    Index block = kInvalidIndex;
    for (; f + kGroup <= end && 3 * (f + kGroup) <= readable; f += kGroup) {
      const Group group = look_at(faces.corners + 3 * f, bounds);
      if (!group.is_good) check = check + check_faces({f, f + kGroup}, faces);
      if (group.is_in_block && block != kInvalidIndex) continue;
      add_blocks(faces, {f, f + kGroup}, block_shift, run);
      block = faces.corners[3 * f + 3 * kGroup - 1] >> block_shift;
      bounds.block = _mm_set1_epi32(static_cast<int>(static_cast<unsigned>(block) << block_shift));
    }
    check = check + check_faces({f, end}, faces);
    add_blocks(faces, {f, end}, block_shift, run);
  }
  return true;
}

#else

bool check_triangle_runs_sse(IndexRange, const FaceColumns&, Index, int, RunBlocks*,
                             FaceCheck&) noexcept {
  return false;
}

#endif

}  // namespace hedgerow::kernels
