#pragma once

#include <cstddef>
#include <type_traits>

#include "kernels/normals_source.h"

/// What the corners of triangles add to their vertices, as rows of four floats: to add a row adds a
/// term, and to what tells a vertex with corners from one without.
namespace hedgerow::kernels {

struct alignas(16) TermRow {
  Float3 term{0, 0, 0};
  float count = 0;
};
static_assert(sizeof(TermRow) == 16);

/// Rows a triangle has: one where its three corners add the same, else one for each of them.
[[nodiscard]] constexpr int rows_of(NormalWeight weight) noexcept {
  return weight == NormalWeight::area || weight == NormalWeight::uniform ? 1 : 3;
}

/// Triangles in a row, by their packed corners.
struct Triangles {
  const Index* corners = nullptr;
  Index count = 0;
  /// From `corners` on so many indices exist. What lies behind the triangles is asked for ahead.
  std::ptrdiff_t index_count = 0;

  /// Those from `begin` on, `most` at the most.
  [[nodiscard]] Triangles part(Index begin, Index most) const noexcept {
    const std::ptrdiff_t corner = 3 * static_cast<std::ptrdiff_t>(begin);
    return {corners + corner, count - begin < most ? count - begin : most, index_count - corner};
  }
};

/// Writes `rows_of(weight)` rows a triangle: to the last bit what `triangle_corners` says
/// of the corner, and a count above 0. \pre rows are 64-byte aligned
void fill_term_rows(const Triangles& triangles, const Points& points, NormalWeight weight,
                    TermRow* rows) noexcept;

/// The sums of vertices [begin, begin + size): sums[0 .. size).
struct SumBlock {
  Index begin = 0;
  Index size = 0;
  TermRow* sums = nullptr;

  [[nodiscard]] bool holds(Index v) const noexcept {
    return static_cast<std::make_unsigned_t<Index>>(v - begin) <
           static_cast<std::make_unsigned_t<Index>>(size);
  }
  [[nodiscard]] TermRow& operator[](Index v) const noexcept { return sums[v - begin]; }
};

/// What is added to what.
struct TermSums {
  const Points& points;
  NormalWeight weight{};
  SumBlock block;
  bool is_inside = false;  ///< every corner is known to be in the block
};

/// Adds what each corner in the block adds to its sum there, in ascending corner order.
void add_terms(const Triangles& triangles, const TermSums& to) noexcept;

/// The forms of both: the plain one; and four, eight and sixteen triangles at a time. Where the
/// build cannot, the next narrower one. \pre of the last two: `suits_avx2(points)`,
/// `suits_avx512(points)`
void fill_term_rows_scalar(const Triangles& triangles, const Points& points, NormalWeight weight,
                           TermRow* rows) noexcept;
void fill_term_rows_sse(const Triangles& triangles, const Points& points, NormalWeight weight,
                        TermRow* rows) noexcept;
void fill_term_rows_avx2(const Triangles& triangles, const Points& points, NormalWeight weight,
                         TermRow* rows) noexcept;
void add_terms_scalar(const Triangles& triangles, const TermSums& to) noexcept;
void add_terms_sse(const Triangles& triangles, const TermSums& to) noexcept;
void add_terms_avx2(const Triangles& triangles, const TermSums& to) noexcept;
void fill_term_rows_avx512(const Triangles& triangles, const Points& points, NormalWeight weight,
                           TermRow* rows) noexcept;
void add_terms_avx512(const Triangles& triangles, const TermSums& to) noexcept;

}  // namespace hedgerow::kernels
