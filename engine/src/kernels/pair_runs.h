#pragma once

#include <algorithm>
#include <cstddef>

#include "kernels/normals_weight.h"
#include "kernels/pair_windows.h"
#include "kernels/term_rows.h"

#if defined(__SSE2__)

#include <xmmintrin.h>

/// Terms by lanes for runs of pairs (pair_windows.h): positions and sums lie in a row, so nothing
/// is gathered, and whole vectors are added. Areas have a loop of their own (area_terms.h).
///
/// `Lanes` says how wide that is:
///
///   using Float                               lane i has pair_of(i) of kPairs pairs
///   using Rows                                four vectors of rows x, y, z, w by ascending pair
///   static constexpr Index kPairs
///   bool is_run(const Index* corners)         whether the corners of kPairs pairs step by one
///   Vec3<Float> load(const float* positions)  of kPairs vertices in a row
///   static Rows to_rows(Vec3<Float>, float w)
///   static Rows scaled(Rows, Float)           each row by the lane of its pair
///   static Rows moved(Rows)                   each row where the next one was; the first is -0
///   static __m128 last(Rows)
///   Rows::load, store, operator+
///
/// Local to each source, as those are compiled for different processors.
namespace hedgerow::kernels {
namespace {

template <NormalWeight W, class Lanes>
class PairTerms {
 public:
  explicit PairTerms(const Lanes& lanes, const float* positions) noexcept
      : lanes_(lanes), positions_(positions) {}

  /// Of a run that begins with these corners. False: one of its triangles needs the plain form.
  [[gnu::always_inline]] bool find(const Index* corners) noexcept {
    const Points p0 = load(corners[0]);
    const Points p1 = load(corners[1]);
    const Points p2 = load(corners[2]);
    const auto first = begin_terms<W>(p0, p1, p2, terms_[0]);
    // Most often the pair is a cut quad.
    const Points p3 = corners[3] == corners[0] ? p0 : load(corners[3]);
    const Points p4 = corners[4] == corners[2] ? p2 : load(corners[4]);
    const auto second = begin_terms<W>(p3, p4, load(corners[5]), terms_[1]);
    if (!(first & second).all()) [[unlikely]]
      return false;
    for (int t = 0; t < 2; ++t) finish_terms<W>(terms_[t]);
    for (int t = 0; t < 2; ++t) {
      if constexpr (kIsWeighed) corner_weights<W>(terms_[t], weights_[t]);
      rows_[t] = Lanes::to_rows(terms_[t].base, 1);
    }
    return true;
  }

  /// Adds to the sums of a window, the first of which is at `sums`.
  [[gnu::always_inline]] void add(const PairWindow& window, TermRow* sums) const noexcept {
    auto* to = reinterpret_cast<float*>(sums);
    Rows sum = Rows::load(to);
    if (window.has_high()) {
      float* behind = to + 4 * Lanes::kPairs;
      __m128 last = _mm_load_ps(behind);
      for (int t = 0; t < 2; ++t) {
        if (window.high[t] < 0) continue;
        const Rows rows = weighed(t, window.high[t]);
        sum = sum + Lanes::moved(rows);
        last = _mm_add_ps(last, Lanes::last(rows));
      }
      _mm_store_ps(behind, last);
    }
    for (int t = 0; t < 2; ++t) {
      if (window.low[t] >= 0) sum = sum + weighed(t, window.low[t]);
    }
    sum.store(to);
  }

 private:
  using Float = typename Lanes::Float;
  using Rows = typename Lanes::Rows;
  using Points = Vec3<Float>;
  static constexpr bool kIsWeighed = rows_of(W) == 3;

  [[gnu::always_inline]] Points load(Index first) const noexcept {
    return lanes_.load(positions_ + 3 * static_cast<std::ptrdiff_t>(first));
  }
  [[gnu::always_inline]] Rows weighed(int triangle, int corner) const noexcept {
    if constexpr (!kIsWeighed) return rows_[triangle];
    return Lanes::scaled(rows_[triangle], weights_[triangle][corner]);
  }

  const Lanes& lanes_;
  const float* positions_;
  TriangleTerms<Float> terms_[2];
  Float weights_[2][3];
  Rows rows_[2];
};

// Asks for what the runs ahead take, if rows go on.
template <Index kPairs>
[[gnu::always_inline]] inline void prefetch_pairs(const Triangles& run, const PairWindows& windows,
                                                  const float* positions) noexcept {
  constexpr std::ptrdiff_t kCornersAhead = 1024;  // triangles
  constexpr std::ptrdiff_t kPointsAhead = 256;    // vertices
  constexpr std::ptrdiff_t kLine = 16;            // floats, indices
  constexpr std::ptrdiff_t kRunCorners = kPairCorners * kPairs;
  const std::ptrdiff_t ahead =
      std::min<std::ptrdiff_t>(run.index_count - kRunCorners, 3 * kCornersAhead);
  for (std::ptrdiff_t i = 0; i < kRunCorners; i += kLine) {
    _mm_prefetch(reinterpret_cast<const char*>(run.corners + ahead + i), _MM_HINT_T1);
  }
  for (const PairWindow& window : windows) {
    const std::ptrdiff_t first = run.corners[0] + window.first + kPointsAhead;
    for (std::ptrdiff_t i = 0; i < 3 * kPairs; i += kLine) {
      _mm_prefetch(reinterpret_cast<const char*>(positions + 3 * first + i), _MM_HINT_T0);
    }
  }
}

/// Adds the runs of pairs among the triangles, and has `rest(triangles)` add what lies between.
template <NormalWeight W, class Lanes, class Rest>
void add_pair_runs(const Triangles& triangles, const TermSums& to, const Rest& rest) noexcept {
  constexpr Index kPairs = Lanes::kPairs;
  if (to.points.positions.stride_bytes != sizeof(Float3)) return rest(triangles);
  const Lanes lanes;
  PairTerms<W, Lanes> terms(lanes, to.points.positions.data);
  PairWindows windows;
  const auto add = [&](const Index* corners) __attribute__((always_inline)) {
    if (!windows.find(corners)) return false;
    for (const PairWindow& window : windows) {
      const Index first = corners[0] + window.first;
      const Index last = first + kPairs - (window.has_high() ? 0 : 1);
      if (!to.is_inside && !(to.block.holds(first) && to.block.holds(last))) return false;
    }
    if (!terms.find(corners)) return false;
    for (const PairWindow& window : windows) {
      terms.add(window, &to.block[corners[0] + window.first]);
    }
    return true;
  };
  Index done = 0;
  for (Index i = 0; i + 2 * kPairs <= triangles.count; i += 2 * kPairs) {
    const Triangles run = triangles.part(i, 2 * kPairs);
    if (!lanes.is_run(run.corners)) continue;
    if (done < i) rest(triangles.part(done, i - done));
    prefetch_pairs<kPairs>(run, windows, to.points.positions.data);
    if (!add(run.corners)) rest(run);
    done = i + 2 * kPairs;
  }
  if (done < triangles.count) rest(triangles.part(done, triangles.count - done));
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
