#pragma once

#include <bit>
#include <cstdint>

#include "kernels/normals_weight.h"
#include "kernels/term_rows.h"

#if defined(__SSE2__)

#include <emmintrin.h>

/// Going through triangles in groups, for the wider forms of term_rows.h. A `Groups` says
///
///   static constexpr NormalWeight kWeight;
///   static constexpr Index kSize;                     triangles a group, sixteen at the most
///   void prefetch(const Index*, std::ptrdiff_t left)  asks for what later groups take
///   bool make(const Index* corners, __m128* rows)     the rows of one; false: one of its triangles
///                                                     needs the plain form
///   uint64_t inside(const Index*, const SumBlock&)    bit c: corner c of one is in the block
///   fill_rest, add_rest                               the next narrower form
///
/// Local to each source, as those are compiled for different processors.
namespace hedgerow::kernels {
namespace {

// Calls group(i, corners) for groups from triangle i on, and rest(i, triangles) where that returns
// false, or what is left is no group.
template <class Groups, class Group, class Rest>
[[gnu::always_inline]] inline void for_each_group(const Triangles& triangles, const Groups& groups,
                                                  const Group& group, const Rest& rest) noexcept {
  constexpr Index kSize = Groups::kSize;
  if (triangles.count < kSize) {
    if (triangles.count > 0) rest(0, triangles);
    return;
  }
  const Index* corners = triangles.corners;
  const Index* last = corners + triangles.index_count - 3 * kSize;
  Index i = 0;
  for (; i + kSize <= triangles.count; i += kSize, corners += 3 * kSize) {
    groups.prefetch(corners, last - corners);
    if (!group(i, corners)) [[unlikely]]
      rest(i, triangles.part(i, kSize));
  }
  if (i < triangles.count) rest(i, triangles.part(i, kSize));
}

template <class Groups>
void fill_groups(const Triangles& triangles, const Points& points, const Groups& groups,
                 TermRow* out) noexcept {
  constexpr Index kRows = rows_of(Groups::kWeight);
  const auto place = [out](Index i) { return out + static_cast<std::ptrdiff_t>(i) * kRows; };
  for_each_group(
      triangles, groups,
      [&](Index i, const Index* corners) {
        __m128 rows[Groups::kSize * kRows];
        if (!groups.make(corners, rows)) [[unlikely]]
          return false;
        auto* to = reinterpret_cast<float*>(place(i));
        for (Index r = 0; r < Groups::kSize * kRows; ++r) _mm_store_ps(to + 4 * r, rows[r]);
        return true;
      },
      [&](Index i, const Triangles& few) {
        Groups::fill_rest(few, points, Groups::kWeight, place(i));
      });
}

inline void add_row(TermRow& sum, __m128 row) noexcept {
  auto* to = reinterpret_cast<float*>(&sum);
  _mm_store_ps(to, _mm_add_ps(_mm_load_ps(to), row));
}

/// Sums by vertex id, though the first ones need not exist: one addition to an offset. \pre with
/// BMI2: offsets fit 32 bits
class SumsById {
 public:
  explicit SumsById(const SumBlock& block) noexcept
      : zeroth_(reinterpret_cast<std::uintptr_t>(block.sums) -
                sizeof(TermRow) * static_cast<std::uintptr_t>(block.begin)) {}

  /// By reference: BMI2 loads and turns the index in memory by one instruction.
  [[nodiscard, gnu::always_inline]] TermRow& operator[](const Index& v) const noexcept {
    return *reinterpret_cast<TermRow*>(zeroth_ + offset_of(v));
  }

 private:
  [[gnu::always_inline]] static std::uintptr_t offset_of(const Index& v) noexcept {
    static_assert(sizeof(TermRow) == 1 << 4);
#if defined(__BMI2__)
    return std::rotl(static_cast<std::uint32_t>(v), 4);
#else
    return static_cast<std::uintptr_t>(v) << 4;
#endif
  }

  std::uintptr_t zeroth_;
};

template <bool kInside, class Groups>
void add_groups(const Triangles& triangles, const TermSums& to, const Groups& groups) noexcept {
  constexpr std::uint64_t kAll = (std::uint64_t{1} << 3 * Groups::kSize) - 1;
  constexpr bool kIsOne = rows_of(Groups::kWeight) == 1;
  const SumsById sums(to.block);
  for_each_group(
      triangles, groups,
      [&](Index, const Index* corners) {
        const std::uint64_t in_block = kInside ? kAll : groups.inside(corners, to.block);
        if (in_block == 0) return true;
        __m128 rows[Groups::kSize * rows_of(Groups::kWeight)];
        if (!groups.make(corners, rows)) [[unlikely]]
          return false;
        if (in_block == kAll) [[likely]] {
#pragma GCC unroll 48
          for (Index c = 0; c < 3 * Groups::kSize; ++c) {
            add_row(sums[corners[c]], rows[kIsOne ? c / 3 : c]);
          }
        } else {
          for (std::uint64_t left = in_block; left != 0; left &= left - 1) {
            const int c = std::countr_zero(left);
            add_row(sums[corners[c]], rows[kIsOne ? c / 3 : c]);
          }
        }
        return true;
      },
      [&](Index, const Triangles& few) { Groups::add_rest(few, to); });
}

template <class Groups>
void add_all_groups(const Triangles& triangles, const TermSums& to, const Groups& groups) noexcept {
  to.is_inside ? add_groups<true>(triangles, to, groups) : add_groups<false>(triangles, to, groups);
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
