#pragma once

#include <bit>
#include <cstdint>

#include "kernels/point_rows.h"
#include "kernels/term_groups.h"

#if defined(__SSE2__)

/// The terms of area weights: one triangle after the other, crossed as rows, as positions lie in
/// memory. An index is loaded once, for the position and for the sum; to turn positions into lanes
/// and terms back into rows would take more instructions than the cross product.
///
/// Local to each source, as those are compiled for different processors.
namespace hedgerow::kernels {
namespace {

/// x, y, z of the area vector, then 1. The difference of a register and a row in memory is one
/// instruction, so edges run towards the first corner.
[[nodiscard, gnu::always_inline]] inline __m128 area_row(__m128 p0, __m128 p1, __m128 p2) noexcept {
  const auto turned = [](__m128 v) { return _mm_shuffle_ps(v, v, 0xc9); };  // y, z, x
  const __m128 u = _mm_sub_ps(p0, p1);
  const __m128 v = _mm_sub_ps(p0, p2);
  // z, x, y of the cross product, and what came of the bytes behind the positions.
  const __m128 zxy = _mm_sub_ps(_mm_mul_ps(u, turned(v)), _mm_mul_ps(turned(u), v));
#if defined(__SSE4_1__)
  return _mm_blend_ps(turned(zxy), _mm_set1_ps(1), 8);
#else
  const __m128 is_vector = _mm_castsi128_ps(_mm_setr_epi32(-1, -1, -1, 0));
  return _mm_or_ps(_mm_and_ps(turned(zxy), is_vector), _mm_setr_ps(0, 0, 0, 1));
#endif
}

/// Areas in groups: a `Groups` as in term_groups.h. `Corners` says how many triangles are a group,
/// and looks at their corners:
///
///   static constexpr Index kSize
///   static uint64_t inside(const Index*, const SumBlock&)   bit c: corner c is in the block
///   static bool is_among(const Index*, Index v)             whether one of them is v
template <class Corners, class Rows>
struct AreaGroups {
  static constexpr NormalWeight kWeight = NormalWeight::area;
  static constexpr auto fill_rest = fill_term_rows_scalar;
  static constexpr auto add_rest = add_terms_scalar;
  static constexpr Index kSize = Corners::kSize;

  const Rows& points;

  [[gnu::always_inline]] void prefetch(const Index* corners, std::ptrdiff_t left) const noexcept {
    points.template prefetch<kSize>(corners, left);
  }
  static std::uint64_t inside(const Index* corners, const SumBlock& block) noexcept {
    return Corners::inside(corners, block);
  }
  [[nodiscard, gnu::always_inline]] bool has_last(const Index* corners) const noexcept {
    return Corners::is_among(corners, points.last());
  }
  [[gnu::always_inline]] bool make(const Index* corners, __m128* rows) const noexcept {
    if (has_last(corners)) [[unlikely]]
      return false;
    for (Index i = 0; i < kSize; ++i, corners += 3) {
      rows[i] = area_row(points[corners[0]], points[corners[1]], points[corners[2]]);
    }
    return true;
  }
};

template <bool kInside, class Groups>
void add_areas(const Triangles& triangles, const TermSums& to, const Groups& groups) noexcept {
  const SumsById sums(to.block);
  for_each_touching<kInside>(
      triangles, to, groups,
      [&](const Index* corners) __attribute__((always_inline)) {
        if (groups.has_last(corners)) [[unlikely]]
          return false;
#pragma GCC unroll 8
        for (Index i = 0; i < Groups::kSize; ++i, corners += 3) {
          // Loaded before the first sum is stored, which might be an index for all that the
          // compiler knows.
          const Index a = corners[0];
          const Index b = corners[1];
          const Index c = corners[2];
          const __m128 row = area_row(groups.points[a], groups.points[b], groups.points[c]);
          add_row(sums[a], row);
          add_row(sums[b], row);
          add_row(sums[c], row);
        }
        return true;
      },
      [&](const Index* corners, std::uint64_t in_block) {
        if (groups.has_last(corners)) [[unlikely]]
          return false;
        for (std::uint64_t left = in_block; left != 0; left >>= 3, corners += 3) {
          if ((left & 7) == 0) continue;
          const __m128 row = area_row(groups.points[corners[0]], groups.points[corners[1]],
                                      groups.points[corners[2]]);
          for (int k = 0; k < 3; ++k) {
            if ((left >> k & 1) != 0) add_row(sums[corners[k]], row);
          }
        }
        return true;
      });
}

/// The two tasks of term_rows.h for areas.
template <class Corners>
void fill_area_rows(const Triangles& triangles, const Points& points, TermRow* rows) noexcept {
  with_point_rows(points, [&]<class Rows>(const Rows& point_rows) {
    fill_groups(triangles, points, AreaGroups<Corners, Rows>{point_rows}, rows);
  });
}
template <class Corners>
void add_all_areas(const Triangles& triangles, const TermSums& to) noexcept {
  with_point_rows(to.points, [&]<class Rows>(const Rows& point_rows) {
    const AreaGroups<Corners, Rows> groups{point_rows};
    to.is_inside ? add_areas<true>(triangles, to, groups) : add_areas<false>(triangles, to, groups);
  });
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
