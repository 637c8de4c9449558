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

/// Sums by vertex id, though the first ones need not exist: one addition to an offset.
class SumsById {
 public:
  explicit SumsById(const SumBlock& block) noexcept
      : zeroth_(reinterpret_cast<std::uintptr_t>(block.sums) -
                sizeof(TermRow) * static_cast<std::uintptr_t>(block.begin)) {}

  [[nodiscard, gnu::always_inline]] TermRow& operator[](Index v) const noexcept {
    static_assert(sizeof(TermRow) == 16);
    std::uintptr_t twice = 2 * static_cast<std::uintptr_t>(v);
    asm("" : "+r"(twice));  // load and store take a factor of eight, but none of sixteen
    return *reinterpret_cast<TermRow*>(zeroth_ + 8 * twice);
  }

 private:
  std::uintptr_t zeroth_;
};

// Calls all(corners) for groups that lie in the block, and some(corners, bits) for those that touch
// it, where bit c says that corner c is in it. Both return false if the plain form is needed.
template <bool kInside, class Groups, class All, class Some>
[[gnu::always_inline]] inline void for_each_touching(const Triangles& triangles, const TermSums& to,
                                                     const Groups& groups, const All& all,
                                                     const Some& some) noexcept {
  constexpr std::uint64_t kAll = (std::uint64_t{1} << 3 * Groups::kSize) - 1;
  for_each_group(
      triangles, groups,
      [&](Index, const Index* corners) {
        const std::uint64_t in_block = kInside ? kAll : groups.inside(corners, to.block);
        if (in_block == kAll) [[likely]]
          return all(corners);
        return in_block == 0 || some(corners, in_block);
      },
      [&](Index, const Triangles& few) { Groups::add_rest(few, to); });
}

template <bool kInside, class Groups>
void add_groups(const Triangles& triangles, const TermSums& to, const Groups& groups) noexcept {
  constexpr bool kIsOne = rows_of(Groups::kWeight) == 1;
  constexpr Index kRows = Groups::kSize * rows_of(Groups::kWeight);
  const SumsById sums(to.block);
  for_each_touching<kInside>(
      triangles, to, groups,
      [&](const Index* corners) __attribute__((always_inline)) {
        __m128 rows[kRows];
        if (!groups.make(corners, rows)) [[unlikely]]
          return false;
#pragma GCC unroll 48
        for (Index c = 0; c < 3 * Groups::kSize; ++c) {
          add_row(sums[corners[c]], rows[kIsOne ? c / 3 : c]);
        }
        return true;
      },
      [&](const Index* corners, std::uint64_t in_block) {
        __m128 rows[kRows];
        if (!groups.make(corners, rows)) [[unlikely]]
          return false;
        for (std::uint64_t left = in_block; left != 0; left &= left - 1) {
          const int c = std::countr_zero(left);
          add_row(sums[corners[c]], rows[kIsOne ? c / 3 : c]);
        }
        return true;
      });
}

template <class Groups>
void add_all_groups(const Triangles& triangles, const TermSums& to, const Groups& groups) noexcept {
  to.is_inside ? add_groups<true>(triangles, to, groups) : add_groups<false>(triangles, to, groups);
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
