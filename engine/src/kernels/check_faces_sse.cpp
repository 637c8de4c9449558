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

// A strip of triangles along the seam of two blocks goes to and fro between them, so the two newest
// blocks of the run are remembered; -1 is the block of no vertex.
struct Bounds {
  __m128i last_vertex;
  __m128i shift;
  __m128i block = _mm_set1_epi32(-1);
  __m128i block_before = _mm_set1_epi32(-1);
};

struct Group {
  bool is_good;
  bool is_in_blocks;
};

// The last block of the list, or the one before it.
Index newest_block(const RunBlocks& run, Index back) noexcept {
  return run.count >= back && run.count <= RunBlocks::kCapacity ? run.block[run.count - back]
                                                                : kInvalidIndex;
}

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
  __m128i inside = _mm_set1_epi32(-1);
  for (int j = 0; j < 3; ++j) {
    const __m128i v = load(c + 4 * j);
    sign = _mm_or_si128(sign, _mm_or_si128(v, _mm_sub_epi32(bounds.last_vertex, v)));
    const __m128i next = _mm_and_si128(_mm_cmpeq_epi32(v, load(c + 4 * j + 1)), next_in[j]);
    const __m128i after = _mm_and_si128(_mm_cmpeq_epi32(v, load(c + 4 * j + 2)), after_in[j]);
    equal = _mm_or_si128(equal, _mm_or_si128(next, after));
    const __m128i block = _mm_srl_epi32(v, bounds.shift);
    inside = _mm_and_si128(inside, _mm_or_si128(_mm_cmpeq_epi32(block, bounds.block),
                                                _mm_cmpeq_epi32(block, bounds.block_before)));
  }
  const __m128i bad = _mm_or_si128(_mm_srai_epi32(sign, 31), equal);
  return {_mm_movemask_epi8(bad) == 0, _mm_movemask_epi8(inside) == 0xffff};
}

}  // namespace

bool check_triangle_runs_sse(IndexRange range, const FaceColumns& faces, Index run_length,
                             int block_shift, RunBlocks* runs, FaceCheck& check) noexcept {
  if constexpr (sizeof(Index) != 4) return false;
  const Index readable = faces.halfedge_count() - kTail;
  for (Index r = range.begin; r < range.end; ++r) {
    RunBlocks& run = runs[r];
    run.count = 0;
    Bounds bounds{_mm_set1_epi32(static_cast<int>(faces.vertex_count - 1)),
                  _mm_cvtsi32_si128(block_shift)};
    Index f = r * run_length;
    const Index end = std::min(faces.face_count, f + run_length);
    for (; f + kGroup <= end && 3 * (f + kGroup) <= readable; f += kGroup) {
      const Group group = look_at(faces.corners + 3 * f, bounds);
      if (!group.is_good) check = check + check_faces({f, f + kGroup}, faces);
      if (group.is_in_blocks || run.count > RunBlocks::kCapacity) continue;
      add_blocks(faces, {f, f + kGroup}, block_shift, run);
      bounds.block = _mm_set1_epi32(static_cast<int>(newest_block(run, 1)));
      bounds.block_before = _mm_set1_epi32(static_cast<int>(newest_block(run, 2)));
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
