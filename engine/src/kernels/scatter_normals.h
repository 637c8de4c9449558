#pragma once

#include <type_traits>

#include "kernels/term_rows.h"

/// The linear face list, for one block of vertices: add the faces, finish, and where a sum left the
/// range of float, add those again in full range.
namespace hedgerow::kernels {

/// The sum at one vertex. Its count is above 0 once a corner was added, so 0 is "on no face"; once
/// found out of range, negative: the largest exponent of its terms so far, minus a bias.
using VertexSum = TermRow;

struct ScatterInput {
  FaceSource faces;
  Points points;
  NormalWeight weight{};
  PolygonMethod polygon{};
};

/// Adds what each corner in `range` adds to the vertices of the block, in ascending corner order.
/// `is_inside`: every corner is known to be in the block.
void scatter_faces(IndexRange range, const ScatterInput& input, const SumBlock& block,
                   bool is_inside) noexcept;

/// Writes the normals of the block and marks the sums that are to be added again, whose number it
/// adds to `again_count`.
[[nodiscard]] NormalStats finish_sums(const SumBlock& block, const NormalWriter& writer,
                                      Index& again_count) noexcept;

/// The plain form; four sums at a time; and eight (\pre the processor has AVX2).
[[nodiscard]] NormalStats finish_sums_scalar(const SumBlock& block, const NormalWriter& writer,
                                             Index& again_count) noexcept;
[[nodiscard]] NormalStats finish_sums_sse(const SumBlock& block, const NormalWriter& writer,
                                          Index& again_count) noexcept;
[[nodiscard]] NormalStats finish_sums_avx2(const SumBlock& block, const NormalWriter& writer,
                                           Index& again_count) noexcept;

/// For marked sums: the largest exponent of a term; then the sum of the terms scaled by it; then
/// the normals.
void scatter_exponents(IndexRange range, const ScatterInput& input, const SumBlock& block) noexcept;
void scatter_scaled(IndexRange range, const ScatterInput& input, const SumBlock& block) noexcept;
[[nodiscard]] NormalStats finish_scaled(const SumBlock& block, const NormalWriter& writer) noexcept;

/// Which blocks of 2^shift vertices a run of faces touches, as a row of bits.
void mark_blocks(IndexRange corners, const FaceSource& faces, int shift,
                 std::uint64_t* bits) noexcept;

}  // namespace hedgerow::kernels
