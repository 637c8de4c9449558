#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

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

/// Adds triangles to sums. Indices are loaded before the first sum is stored, which might be one of
/// them for all that the compiler knows.
template <class Rows>
class AreaAdder {
 public:
  AreaAdder(const Rows& points, const SumBlock& block) noexcept : points_(points), sums_(block) {}

  [[gnu::always_inline]] void add_triangle(const Index* corners) const noexcept {
    const Index a = corners[0];
    const Index b = corners[1];
    const Index c = corners[2];
    const __m128 row = area_row(points_[a], points_[b], points_[c]);
    add_row(sums_[a], row);
    add_row(sums_[b], row);
    add_row(sums_[c], row);
  }

  /// Two triangles of which the second has two corners of the first, then a new one: four positions
  /// and four sums in place of six. \pre `is_cut_quad` or `is_turned_quad` holds, as `kTurned` says
  template <bool kTurned>
  [[gnu::always_inline]] void add_quad(const Index* corners) const noexcept {
    const Index a = corners[0];
    const Index b = corners[1];
    const Index c = corners[2];
    const Index d = corners[5];
    const __m128 pa = points_[a];
    const __m128 pb = points_[b];
    const __m128 pc = points_[c];
    const __m128 first = area_row(pa, pb, pc);
    const __m128 second = kTurned ? area_row(pc, pb, points_[d]) : area_row(pa, pc, points_[d]);
    kTurned ? add_row(sums_[a], first) : add_rows(sums_[a], first, second);
    kTurned ? add_rows(sums_[b], first, second) : add_row(sums_[b], first);
    add_rows(sums_[c], first, second);
    add_row(sums_[d], second);
  }

  /// What a triangle adds to those of its corners whose bit of `wanted` is set.
  [[gnu::always_inline]] void add_some(const Index* corners, std::uint64_t wanted) const noexcept {
    const Index a = corners[0];
    const Index b = corners[1];
    const Index c = corners[2];
    const __m128 row = area_row(points_[a], points_[b], points_[c]);
    if ((wanted & 1) != 0) add_row(sums_[a], row);
    if ((wanted & 2) != 0) add_row(sums_[b], row);
    if ((wanted & 4) != 0) add_row(sums_[c], row);
  }

 private:
  [[gnu::always_inline]] static void add_rows(TermRow& sum, __m128 first, __m128 second) noexcept {
    auto* to = reinterpret_cast<float*>(&sum);
    _mm_store_ps(to, _mm_add_ps(_mm_add_ps(_mm_load_ps(to), first), second));
  }

  const Rows& points_;
  SumsById sums_;
};

/// Triangles a, b, c and a, c, d, as most programs cut quads.
[[nodiscard, gnu::always_inline]] inline bool is_cut_quad(const Index* corners) noexcept {
  return corners[3] == corners[0] && corners[4] == corners[2];
}
/// Triangles a, b, c and c, b, d, as a numbering by fronts leaves every other row.
[[nodiscard, gnu::always_inline]] inline bool is_turned_quad(const Index* corners) noexcept {
  return corners[3] == corners[2] && corners[4] == corners[1];
}

/// Calls quad(turned, corners) for pairs that are a quad cut in two, where `turned` is a constant,
/// and triangle(corners) for what is left.
template <class Quad, class Triangle>
[[gnu::always_inline]] inline void for_each_quad(const Index* corners, Index count,
                                                 const Quad& quad,
                                                 const Triangle& triangle) noexcept {
  const Index* const end = corners + 3 * static_cast<std::ptrdiff_t>(count);
  while (corners + 6 <= end) {
    if (is_cut_quad(corners)) {
      quad(std::false_type(), corners);
    } else if (is_turned_quad(corners)) {
      quad(std::true_type(), corners);
    } else {
      triangle(corners);
      corners += 3;
      continue;
    }
    corners += 6;
  }
  if (corners < end) triangle(corners);
}

/// Whether most triangles come in such pairs. Told by the first few, as a test that is not foreseen
/// costs more than it gains.
[[nodiscard]] inline bool are_cut_quads(const Triangles& triangles) noexcept {
  constexpr Index kLooked = 32;
  if (triangles.count < kLooked) return false;
  Index single_count = 0;
  for_each_quad(
      triangles.corners, kLooked, [](auto, const Index*) {}, [&](const Index*) { ++single_count; });
  return single_count <= kLooked / 8;
}

template <bool kInside, class Groups>
void add_areas(const Triangles& triangles, const TermSums& to, const Groups& groups) noexcept {
  const AreaAdder adder(groups.points, to.block);
  for_each_touching<kInside>(
      triangles, to, groups,
      [&](const Index* corners) __attribute__((always_inline)) {
        if (groups.has_last(corners)) [[unlikely]]
          return false;
#pragma GCC unroll 8
        for (Index i = 0; i < Groups::kSize; ++i) adder.add_triangle(corners + 3 * i);
        return true;
      },
      [&](const Index* corners, std::uint64_t in_block) {
        if (groups.has_last(corners)) [[unlikely]]
          return false;
        for (std::uint64_t left = in_block; left != 0; left >>= 3, corners += 3) {
          if ((left & 7) != 0) adder.add_some(corners, left);
        }
        return true;
      });
}

/// The same for triangles that are cut quads for the most part. \pre all corners are in the block
template <class Groups, class Rest>
void add_quads(const Triangles& triangles, const TermSums& to, const Groups& groups,
               const Rest& rest) noexcept {
  const AreaAdder adder(groups.points, to.block);
  for_each_group(
      triangles, groups,
      [&](Index, const Index* corners) __attribute__((always_inline)) {
        if (groups.has_last(corners)) [[unlikely]]
          return false;
        for_each_quad(
            corners, Groups::kSize,
            [&](auto turned, const Index* quad)
                __attribute__((always_inline)) { adder.template add_quad<turned()>(quad); },
            [&](const Index* triangle)
                __attribute__((always_inline)) { adder.add_triangle(triangle); });
        return true;
      },
      [&](Index, const Triangles& few) { rest(few); });
}

/// The two tasks of term_rows.h for areas.
template <template <Index> class Corners>
void fill_area_rows(const Triangles& triangles, const Points& points, TermRow* rows) noexcept {
  with_point_rows(points, [&]<class Rows>(const Rows& point_rows) {
    fill_groups(triangles, points, AreaGroups<Corners<8>, Rows>{point_rows}, rows);
  });
}
template <template <Index> class Corners>
void add_all_areas(const Triangles& triangles, const TermSums& to) noexcept {
  with_point_rows(to.points, [&]<class Rows>(const Rows& point_rows) {
    const AreaGroups<Corners<8>, Rows> groups{point_rows};
    if (!to.is_inside) {
      add_areas<false>(triangles, to, groups);
    } else if (are_cut_quads(triangles)) {
      add_quads(triangles, to, AreaGroups<Corners<32>, Rows>{point_rows},
                [&](const Triangles& few) { add_areas<true>(few, to, groups); });
    } else {
      add_areas<true>(triangles, to, groups);
    }
  });
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
