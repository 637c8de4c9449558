#pragma once

#include "kernels/normals_avx2.h"
#include "kernels/term_rows.h"

#if defined(__AVX2__)

/// The terms of weights that differ between the corners of a triangle. Each waits for a square
/// root, two divisions and a polynomial, longer than a processor looks ahead; so they are taken in
/// steps, each for many triangles that do not wait for one another. For sources compiled for AVX2,
/// and local to each.
namespace hedgerow::kernels {
namespace {

template <NormalWeight W, class Loader>
class WeighedTerms {
 public:
  static constexpr Index kGroup = 8;
  static constexpr Index kMost = 64;  // triangles: their terms take 3 KB

  explicit WeighedTerms(const Loader& loader) noexcept : loader_(loader) {}

  /// Finds the terms of all whole groups of `part`, kMost triangles at the most, and returns how
  /// many triangles these have.
  Index find(const Triangles& part) noexcept {
    const Index whole = part.count / kGroup * kGroup;
    find_bases(part, whole / kGroup);
    for (Float8(&weights)[kGroups] : weights_) {
      for (Index g = 0; g < whole / kGroup; ++g) {
        weights[g] = corner_weight<W>(lengths_[g], weights[g]);
      }
    }
    return whole;
  }

  /// Whether the rows of the group from triangle i on may be used.
  [[nodiscard]] bool is_usual(Index i) const noexcept { return (unusual_ >> i / kGroup & 1) == 0; }
  /// What corner k of triangle i adds. It is counted by its weight, which is as good: it is not 0.
  [[nodiscard]] __m128 row(Index i, int k) const noexcept {
    const auto* weights = reinterpret_cast<const float*>(weights_[k]);
    return _mm_mul_ps(bases_[i], _mm_broadcast_ss(weights + i));
  }

 private:
  static constexpr Index kGroups = kMost / kGroup;

  void find_bases(const Triangles& part, Index groups) noexcept {
    unusual_ = 0;
    if (groups == 0) return;
    const Index* corners = part.corners;
    const Index* last = corners + part.index_count - 3 * kGroup;
    for (Index g = 0; g < groups; ++g, corners += 3 * kGroup) {
      loader_.prefetch(corners, last - corners);
      Vec3<Float8> p[3];
      loader_.load(corners, p);
      TriangleTerms<Float8> terms;
      const Mask8 usual = triangle_terms<W>(p[0], p[1], p[2], terms);
      unusual_ |= static_cast<unsigned>(usual.lanes() != 0xff) << g;
      const Rows8 rows = to_rows(terms.base, 1);
      for (int i = 0; i < kGroup; ++i) bases_[kGroup * g + i] = rows.row[i];
      if constexpr (W == NormalWeight::angle) lengths_[g] = terms.length;
      for (int k = 0; k < 3; ++k) weights_[k][g] = terms.factor[k];
    }
  }

  const Loader& loader_;
  __m128 bases_[kMost];
  Float8 lengths_[kGroups];
  Float8 weights_[3][kGroups];  // first what they follow from
  unsigned unusual_ = 0;        // a bit for each group
};

}  // namespace
}  // namespace hedgerow::kernels

#endif
