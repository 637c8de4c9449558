#pragma once

#include <cstddef>

#include "kernels/normals_weight.h"
#include "kernels/term_groups.h"
#include "kernels/term_rows.h"

#if defined(__AVX2__)

/// The terms of weights that differ between the corners of a triangle. Each waits for a square
/// root, divisions and a polynomial, longer than a processor looks ahead; so they are taken in
/// steps, each for many triangles that do not wait for one another.
///
/// A `Loader` says how wide that is:
///
///   using Float                                  as many triangles as it has lanes are a group
///   static constexpr Index kLanes
///   void prefetch(const Index*, ptrdiff_t left)  asks for what later groups take
///   void load_turned(const Index*, Vec3<Float> (&p)[3])
///                                                the corners of a group, each triangle in a lane
///   static void store_turned(const Vec3<Float>&, float, __m128* rows)
///                                                lanes as rows, in the order of the triangles
///
/// Local to each source, as those are compiled for different processors.
namespace hedgerow::kernels {
namespace {

template <NormalWeight W, class Loader>
class WeighedTerms {
 public:
  static constexpr Index kGroup = Loader::kLanes;
  static constexpr Index kMost = 64;  // triangles: their terms take 4 KB

  explicit WeighedTerms(const Loader& loader) noexcept : loader_(loader) {}

  /// Finds the terms of all whole groups of `part`, kMost triangles at the most, and returns how
  /// many triangles these have.
  Index find(const Triangles& part) noexcept {
    const Index groups = part.count / kGroup;
    begin(part, groups);
    for (Index g = 0; g < groups; ++g) {
      finish_terms<W>(terms_[g]);
      Loader::store_turned(terms_[g].base, 1, bases_ + kGroup * g);
    }
    for (Index g = 0; g < groups; ++g) {
      Float weights[3];
      corner_weights<W>(terms_[g], weights);
      Loader::store_turned({weights[0], weights[1], weights[2]}, 0, weights_ + kGroup * g);
    }
    return groups * kGroup;
  }

  /// Whether the rows of the group from triangle i on may be used.
  [[nodiscard]] bool is_usual(Index i) const noexcept { return (unusual_ >> i / kGroup & 1) == 0; }

  /// Calls visit(k, row) for what each corner of triangle i adds. It is counted by its weight,
  /// which is as good: it is not 0.
  template <class Visit>
  [[gnu::always_inline]] void for_each_row(Index i, const Visit& visit) const noexcept {
    const __m128 base = bases_[i];
    __m128 weights = weights_[i];
    asm("" : "+x"(weights));
    visit(0, _mm_mul_ps(base, _mm_permute_ps(weights, 0x00)));
    visit(1, _mm_mul_ps(base, _mm_permute_ps(weights, 0x55)));
    visit(2, _mm_mul_ps(base, _mm_permute_ps(weights, 0xaa)));
  }

 private:
  using Float = typename Loader::Float;

  void begin(const Triangles& part, Index groups) noexcept {
    unusual_ = 0;
    if (groups == 0) return;
    const Index* corners = part.corners;
    const Index* last = corners + part.index_count - 3 * kGroup;
    for (Index g = 0; g < groups; ++g, corners += 3 * kGroup) {
      loader_.prefetch(corners, last - corners);
      Vec3<Float> p[3];
      loader_.load_turned(corners, p);
      const auto usual = begin_terms<W>(p[0], p[1], p[2], terms_[g]);
      unusual_ |= static_cast<unsigned>(!usual.all()) << g;
    }
  }

  const Loader& loader_;
  TriangleTerms<Float> terms_[kMost / kGroup];
  alignas(64) __m128 bases_[kMost];
  alignas(64) __m128 weights_[kMost];  // those of corners 0, 1 and 2
  unsigned unusual_ = 0;               // a bit for each group
};

// Calls group(i, first) for a group of triangles from triangle i on, which has its terms from
// `first` on, and rest(i, triangles) for those that need the narrower form.
template <class Terms, class Group, class Rest>
void for_each_weighed(const Triangles& triangles, Terms& terms, const Group& group,
                      const Rest& rest) noexcept {
  constexpr Index kGroup = Terms::kGroup;
  for (Index begin = 0; begin < triangles.count; begin += Terms::kMost) {
    const Triangles part = triangles.part(begin, Terms::kMost);
    const Index whole = terms.find(part);
    for (Index i = 0; i < whole; i += kGroup) {
      if (terms.is_usual(i)) [[likely]] {
        group(begin + i, i);
      } else {
        rest(begin + i, part.part(i, kGroup));
      }
    }
    if (whole < part.count) rest(begin + whole, part.part(whole, kGroup));
  }
}

template <NormalWeight W, class Loader, class Rest>
void fill_weighed(const Triangles& triangles, const Loader& loader, TermRow* out,
                  const Rest& rest) noexcept {
  WeighedTerms<W, Loader> terms(loader);
  const auto place = [out](Index i) { return out + 3 * static_cast<std::ptrdiff_t>(i); };
  for_each_weighed(
      triangles, terms,
      [&](Index triangle, Index i) {
        auto* to = reinterpret_cast<float*>(place(triangle));
        for (Index end = i + terms.kGroup; i < end; ++i, to += 12) {
          terms.for_each_row(i, [&](int k, __m128 row) { _mm_store_ps(to + 4 * k, row); });
        }
      },
      [&](Index triangle, const Triangles& few) { rest(few, place(triangle)); });
}

// Whether a corner of these triangles is in the block.
[[nodiscard]] inline bool touches(const Triangles& triangles, const SumBlock& block) noexcept {
  bool any = false;
  for (Index c = 0; c < 3 * triangles.count; ++c) any |= block.holds(triangles.corners[c]);
  return any;
}

template <NormalWeight W, bool kInside, class Loader, class Rest>
void add_weighed(const Triangles& triangles, const SumBlock& block, const Loader& loader,
                 const Rest& rest) noexcept {
  using Terms = WeighedTerms<W, Loader>;
  Terms terms(loader);
  const SumsById sums(block);
  const auto add = [&](Index triangle, Index i) {
    const Index* corner = triangles.corners + 3 * static_cast<std::ptrdiff_t>(triangle);
#pragma GCC unroll 4
    for (Index j = 0; j < Terms::kGroup; ++j, corner += 3) {
      terms.for_each_row(i + j, [&](int k, __m128 row) {
        if (kInside || block.holds(corner[k])) add_row(sums[corner[k]], row);
      });
    }
  };
  if constexpr (kInside) {
    for_each_weighed(triangles, terms, add, [&](Index, const Triangles& few) { rest(few); });
  } else {
    for (Index begin = 0; begin < triangles.count; begin += Terms::kMost) {
      const Triangles part = triangles.part(begin, Terms::kMost);
      if (!touches(part, block)) continue;
      for_each_weighed(
          part, terms, [&](Index triangle, Index i) { add(begin + triangle, i); },
          [&](Index, const Triangles& few) { rest(few); });
    }
  }
}

template <NormalWeight W, class Loader, class Rest>
void add_all_weighed(const Triangles& triangles, const TermSums& to, const Loader& loader,
                     const Rest& rest) noexcept {
  to.is_inside ? add_weighed<W, true>(triangles, to.block, loader, rest)
               : add_weighed<W, false>(triangles, to.block, loader, rest);
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
