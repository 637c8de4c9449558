#pragma once

#include <algorithm>
#include <cstddef>

#include "kernels/area_terms.h"
#include "kernels/normals_weight.h"
#include "kernels/pair_windows.h"
#include "kernels/term_rows.h"

#if defined(__SSE2__)

#include <xmmintrin.h>

/// Terms of runs of pairs (pair_windows.h): positions and sums lie in rows, so nothing is gathered,
/// and whole vectors are added.
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
/// and, where areas are taken so,
///
///   Row position_row(const float* positions, int part)  x, y, z of a quarter of kPairs vertices
///   static Row area_row(Row, Row, Row)                  see area_terms.h
///
/// Local to each source, as those are compiled for different processors.
namespace hedgerow::kernels {
namespace {

template <NormalWeight W, class Lanes>
class PairTerms {
 public:
  using Rows = typename Lanes::Rows;

  explicit PairTerms(const Lanes& lanes, const float* positions) noexcept
      : lanes_(lanes), positions_(positions) {}

  /// Of a run that begins with these corners. False: one of its triangles needs the plain form.
  [[gnu::always_inline]] bool find(const Index* corners) noexcept {
    const Points p0 = load(corners[0]);
    const Points p1 = load(corners[1]);
    const Points p2 = load(corners[2]);
    const auto first = begin_terms<W>(p0, p1, p2, terms_[0]);
    Points p3 = p0;
    Points p4 = p2;
    if (is_turned_quad(corners)) {
      p3 = p2;
      p4 = p1;
    } else if (!is_cut_quad(corners)) {
      p3 = load(corners[3]);
      p4 = load(corners[4]);
    }
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

  /// What it adds by a corner of one of the two triangles.
  [[nodiscard, gnu::always_inline]] Rows rows(int triangle, int corner) const noexcept {
    if constexpr (!kIsWeighed) return rows_[triangle];
    return Lanes::scaled(rows_[triangle], weights_[triangle][corner]);
  }

 private:
  using Float = typename Lanes::Float;
  using Points = Vec3<Float>;
  static constexpr bool kIsWeighed = rows_of(W) == 3;

  [[gnu::always_inline]] Points load(Index first) const noexcept {
    return lanes_.load(positions_ + 3 * static_cast<std::ptrdiff_t>(first));
  }
  const Lanes& lanes_;
  const float* positions_;
  TriangleTerms<Float> terms_[2];
  Float weights_[2][3];
  Rows rows_[2];
};

/// Areas are crossed as rows, as positions lie in memory: turning positions into lanes and terms
/// back into rows takes more instructions than that.
template <class Lanes>
class PairTerms<NormalWeight::area, Lanes> {
 public:
  using Rows = typename Lanes::Rows;

  explicit PairTerms(const Lanes& lanes, const float* positions) noexcept
      : lanes_(lanes), positions_(positions) {}

  [[gnu::always_inline]] bool find(const Index* corners) noexcept {
    const auto row = [&](int corner, int part) {
      const auto first = static_cast<std::ptrdiff_t>(corners[corner]);
      return lanes_.position_row(positions_ + 3 * first, part);
    };
    if (is_cut_quad(corners)) [[likely]] {
      for (int part = 0; part < 4; ++part) {
        const auto p0 = row(0, part);
        const auto p2 = row(2, part);
        rows_[0].row[part] = Lanes::area_row(p0, row(1, part), p2);
        rows_[1].row[part] = Lanes::area_row(p0, p2, row(5, part));
      }
    } else if (is_turned_quad(corners)) [[likely]] {
      for (int part = 0; part < 4; ++part) {
        const auto p1 = row(1, part);
        const auto p2 = row(2, part);
        rows_[0].row[part] = Lanes::area_row(row(0, part), p1, p2);
        rows_[1].row[part] = Lanes::area_row(p2, p1, row(5, part));
      }
    } else {
      for (int t = 0; t < 2; ++t) {
        for (int part = 0; part < 4; ++part) {
          rows_[t].row[part] =
              Lanes::area_row(row(3 * t, part), row(3 * t + 1, part), row(3 * t + 2, part));
        }
      }
    }
    return true;
  }
  [[nodiscard, gnu::always_inline]] const Rows& rows(int triangle, int) const noexcept {
    return rows_[triangle];
  }

 private:
  const Lanes& lanes_;
  const float* positions_;
  Rows rows_[2];
};

/// Adds what pairs add to the sums of a window, the first of which is at `sums`.
template <class Lanes, class Terms>
[[gnu::always_inline]] inline void add_window(const PairWindow& window, const Terms& terms,
                                              TermRow* sums) noexcept {
  using Rows = typename Terms::Rows;
  auto* to = reinterpret_cast<float*>(sums);
  Rows sum = Rows::load(to);
  if (window.has_high()) {
    float* behind = to + 4 * Lanes::kPairs;
    __m128 last = _mm_load_ps(behind);
    for (int t = 0; t < 2; ++t) {
      if (window.high[t] < 0) continue;
      const Rows rows = terms.rows(t, window.high[t]);
      sum = sum + Lanes::moved(rows);
      last = _mm_add_ps(last, Lanes::last(rows));
    }
    _mm_store_ps(behind, last);
  }
  for (int t = 0; t < 2; ++t) {
    if (window.low[t] >= 0) sum = sum + terms.rows(t, window.low[t]);
  }
  sum.store(to);
}

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

// Whether not the first two triangles are a quad cut in two, but the next two are: pairs that are
// quads have half as many windows.
[[nodiscard, gnu::always_inline]] inline bool begins_late(const Index* corners) noexcept {
  if (is_cut_quad(corners) || is_turned_quad(corners)) [[likely]]
    return false;
  return is_cut_quad(corners + 3) || is_turned_quad(corners + 3);
}

// Whether each window of a run lies in the block as a whole or not at all.
template <Index kPairs>
[[nodiscard]] inline bool are_whole(const PairWindows& windows, Index origin,
                                    const SumBlock& block) noexcept {
  for (const PairWindow& window : windows) {
    const Index first = origin + window.first;
    const Index last = first + kPairs - (window.has_high() ? 0 : 1);
    const bool is_behind = first >= block.begin + block.size;
    if (!is_behind && last >= block.begin && !(block.holds(first) && block.holds(last))) {
      return false;
    }
  }
  return true;
}

/// Adds the runs of pairs among the triangles, and has `rest(triangles)` add what lies between.
template <NormalWeight W, class Lanes, class Rest>
void add_pair_runs(const Triangles& triangles, const TermSums& to, const Rest& rest) noexcept {
  constexpr Index kPairs = Lanes::kPairs;
  constexpr Index kMostOthers = 512;  // triangles
  if (to.points.positions.stride_bytes != sizeof(Float3)) return rest(triangles);
  const Lanes lanes;
  PairTerms<W, Lanes> terms(lanes, to.points.positions.data);
  PairWindows windows;
  const auto add = [&](const Index* corners) __attribute__((always_inline)) {
    if (!windows.find(corners)) return false;
    if (!to.is_inside && !are_whole<kPairs>(windows, corners[0], to.block)) return false;
    if (!terms.find(corners)) return false;
    for (const PairWindow& window : windows) {
      const Index first = corners[0] + window.first;
      if (to.is_inside || to.block.holds(first)) {
        add_window<Lanes>(window, terms, &to.block[first]);
      }
    }
    return true;
  };
  Index done = 0;
  Index i = 0;
  while (i + 2 * kPairs <= triangles.count) {
    const Triangles run = triangles.part(i, 2 * kPairs);
    if (!lanes.is_run(run.corners)) {
      // Not later, as only the corners that follow these are on their way to the cache.
      if (i - done >= kMostOthers) {
        rest(triangles.part(done, i - done));
        done = i;
      }
      i += 2 * kPairs;
    } else if (begins_late(run.corners)) {
      ++i;
    } else {
      if (done < i) rest(triangles.part(done, i - done));
      prefetch_pairs<kPairs>(run, windows, to.points.positions.data);
      if (!add(run.corners)) rest(run);
      i += 2 * kPairs;
      done = i;
    }
  }
  if (done < triangles.count) rest(triangles.part(done, triangles.count - done));
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
