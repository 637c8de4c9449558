// The form of check_faces_sse.cpp with eight triangles at a time, and eight blocks remembered: the
// last of each remainder modulo eight, so that one table lookup finds the only one that can match.

#include <algorithm>

#include "kernels/check_faces.h"
#include "kernels/prefetch.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace hedgerow::kernels {

#if defined(__AVX2__)

namespace {

constexpr Index kGroup = 8;     // triangles
constexpr Index kTail = 2;      // indices behind a group that are read too
constexpr int kRemembered = 8;  // blocks
constexpr Index kWide = RunBlocks::kCapacity + 1;

struct Bounds {
  __m256i last_vertex;
  __m128i shift;
  __m256i block;  // lane i: one that is i modulo eight
};

struct Group {
  bool is_good;
  bool is_in_blocks;
};

void remember(const RunBlocks& run, Bounds& bounds) noexcept {
  alignas(32) int block[kRemembered];
  std::fill_n(block, kRemembered, -1);  // the block of no vertex
  if (run.count < kWide) {
    for (Index i = 0; i < run.count; ++i) {
      block[static_cast<unsigned>(run.block[i]) % kRemembered] = static_cast<int>(run.block[i]);
    }
  }
  bounds.block = _mm256_load_si256(reinterpret_cast<const __m256i*>(block));
}

__m256i load(const Index* p) noexcept {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
}

// Element i: -1 where the index `ahead` places behind index i of a group belongs to its triangle.
template <int ahead>
struct SameTriangle {
  alignas(32) int lane[3 * kGroup];

  constexpr SameTriangle() noexcept : lane{} {
    for (int i = 0; i < 3 * kGroup; ++i) lane[i] = i % 3 + ahead < 3 ? -1 : 0;
  }
  [[nodiscard]] __m256i vector(int j) const noexcept {
    return _mm256_load_si256(reinterpret_cast<const __m256i*>(lane + 8 * j));
  }
};
constexpr SameTriangle<1> kNextIsSame;
constexpr SameTriangle<2> kAfterIsSame;

Group look_at(const Index* c, const Bounds& bounds) noexcept {
  __m256i largest = _mm256_setzero_si256();
  __m256i equal = _mm256_setzero_si256();
  __m256i inside = _mm256_set1_epi32(-1);
  for (int j = 0; j < 3; ++j) {
    const __m256i v = load(c + 8 * j);
    largest = _mm256_max_epu32(largest, v);
    const __m256i next = _mm256_cmpeq_epi32(v, load(c + 8 * j + 1));
    const __m256i after = _mm256_cmpeq_epi32(v, load(c + 8 * j + 2));
    equal =
        _mm256_or_si256(equal, _mm256_or_si256(_mm256_and_si256(next, kNextIsSame.vector(j)),
                                               _mm256_and_si256(after, kAfterIsSame.vector(j))));
    const __m256i block = _mm256_srl_epi32(v, bounds.shift);
    // The lookup takes the remainder itself.
    const __m256i known =
        _mm256_cmpeq_epi32(block, _mm256_permutevar8x32_epi32(bounds.block, block));
    inside = _mm256_and_si256(inside, known);
  }
  const __m256i good =
      _mm256_cmpeq_epi32(_mm256_max_epu32(largest, bounds.last_vertex), bounds.last_vertex);
  return {_mm256_movemask_epi8(_mm256_andnot_si256(equal, good)) == -1,
          _mm256_movemask_epi8(inside) == -1};
}

}  // namespace

FaceCheck check_triangle_runs_avx2(IndexRange range, const FaceColumns& faces, Index run_length,
                                   int block_shift, RunBlocks* runs) noexcept {
  FaceCheck check;
  const Index readable = faces.halfedge_count() - kTail;
  for (Index r = range.begin; r < range.end; ++r) {
    RunBlocks& run = runs[r];
    run.count = 0;
    Bounds bounds{_mm256_set1_epi32(static_cast<int>(faces.vertex_count - 1)),
                  _mm_cvtsi32_si128(block_shift),
                  {}};
    remember(run, bounds);
    Index f = r * run_length;
    const Index end = std::min(faces.face_count, f + run_length);
    for (; f + kGroup <= end && 3 * (f + kGroup) <= readable; f += kGroup) {
      const Index* c = faces.corners + 3 * f;
      prefetch_ahead(c);
      prefetch_ahead(c + 16);
      const Group group = look_at(c, bounds);
      if (!group.is_good) check = check + check_faces({f, f + kGroup}, faces);
      if (group.is_in_blocks || run.count == kWide) continue;
      add_blocks(faces, {f, f + kGroup}, block_shift, run);
      remember(run, bounds);
    }
    check = check + check_faces({f, end}, faces);
    add_blocks(faces, {f, end}, block_shift, run);
  }
  return check;
}

#else

FaceCheck check_triangle_runs_avx2(IndexRange range, const FaceColumns& faces, Index run_length,
                                   int block_shift, RunBlocks* runs) noexcept {
  return check_runs_scalar(range, faces, run_length, block_shift, runs);
}

#endif

}  // namespace hedgerow::kernels
