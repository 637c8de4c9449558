#include "kernels/scatter_normals.h"

#include <algorithm>

#include "kernels/normals_weight.h"
#include "kernels/term_rows.h"

namespace hedgerow::kernels {

namespace {

// State of a sum to be added again: exponent - kBias, always negative, kNoTerm before the first.
constexpr float kBias = 1000;
constexpr float kNoTerm = -3000;

void add(VertexSum& sum, const TermRow& row) noexcept {
  sum.term = sum.term + row.term;
  sum.count += row.count;
}

template <NormalWeight W>
void scatter_polygons(IndexRange range, const ScatterInput& input, const SumBlock& block) noexcept {
  for (Index f = range.begin; f < range.end; ++f) {
    const Index begin = input.faces.begin(f);
    const Index degree = input.faces.begin(f + 1) - begin;
    const auto point = [&](Index k) { return input.points[input.faces.corner(begin + k)]; };
    Wide face;
    bool is_known = false;
    for (Index k = 0; k < degree; ++k) {
      const Index v = input.faces.corner(begin + k);
      if (!block.holds(v)) continue;
      if (!is_known) face = face_vector<W>(input.faces, f, input.points, input.polygon);
      is_known = true;
      add(block[v], {plain_face_corner<W>(face, degree, k, point), 1});
    }
  }
}

// Calls visit(sum, term) for each corner at a marked sum of the block.
template <NormalWeight W, class Visit>
void for_each_marked(IndexRange range, const ScatterInput& input, const SumBlock& block,
                     const Visit& visit) noexcept {
  for (Index f = range.begin; f < range.end; ++f) {
    const Index begin = input.faces.begin(f);
    const Index degree = input.faces.begin(f + 1) - begin;
    const auto point = [&](Index k) { return input.points[input.faces.corner(begin + k)]; };
    Wide face;
    bool is_known = input.faces.is_triangles();
    for (Index k = 0; k < degree; ++k) {
      const Index v = input.faces.corner(begin + k);
      if (!block.holds(v) || !(block[v].count < 0)) continue;
      if (!is_known) face = face_vector<W>(input.faces, f, input.points, input.polygon);
      is_known = true;
      visit(block[v], face_corner<W>(face, degree, k, point));
    }
  }
}

}  // namespace

void scatter_faces(IndexRange range, const ScatterInput& input, const SumBlock& block,
                   bool is_inside) noexcept {
  if (!input.faces.is_triangles()) {
    with_weight(input.weight,
                [&](auto weight) { scatter_polygons<weight()>(range, input, block); });
    return;
  }
  for_each_packed(range, input.faces, [&](IndexRange piece, const Index* corners) {
    // Most often the next run of faces is the next to be added.
    const bool is_native = input.faces.native != nullptr;
    const Index end = is_native ? input.faces.face_count() : piece.end;
    const std::ptrdiff_t index_count = 3 * static_cast<std::ptrdiff_t>(end - piece.begin);
    add_terms({corners, piece.size(), index_count}, {input.points, input.weight, block, is_inside});
  });
}

NormalStats finish_sums(const SumBlock& block, const NormalWriter& writer,
                        Index& again_count) noexcept {
  return has_avx2() ? finish_sums_avx2(block, writer, again_count)
                    : finish_sums_sse(block, writer, again_count);
}

NormalStats finish_sums_scalar(const SumBlock& block, const NormalWriter& writer,
                               Index& again_count) noexcept {
  NormalStats stats;
  for (Index i = 0; i < block.size; ++i) {
    VertexSum& sum = block.sums[i];
    Float3 unit;
    if (normalise(sum.term, unit)) [[likely]] {
      writer.write(block.begin + i, unit);
    } else if (sum.count == 0) {
      writer.write_degenerate(block.begin + i, stats);
    } else {
      sum = {{0, 0, 0}, kNoTerm};
      ++again_count;
    }
  }
  return stats;
}

void scatter_exponents(IndexRange range, const ScatterInput& input,
                       const SumBlock& block) noexcept {
  with_weight(input.weight, [&](auto weight) {
    for_each_marked<weight()>(range, input, block, [](VertexSum& sum, const Wide& term) {
      const int exponent = exponent_of(term);
      if (exponent == kNoExponent) return;
      sum.count = std::max(sum.count, static_cast<float>(exponent) - kBias);
    });
  });
}

void scatter_scaled(IndexRange range, const ScatterInput& input, const SumBlock& block) noexcept {
  with_weight(input.weight, [&](auto weight) {
    for_each_marked<weight()>(range, input, block, [](VertexSum& sum, const Wide& term) {
      if (sum.count == kNoTerm) return;
      sum.term = sum.term + scaled(term, static_cast<int>(sum.count + kBias));
    });
  });
}

NormalStats finish_scaled(const SumBlock& block, const NormalWriter& writer) noexcept {
  NormalStats stats;
  for (Index i = 0; i < block.size; ++i) {
    if (!(block.sums[i].count < 0)) continue;
    Float3 unit;
    if (normalise_wide(block.sums[i].term, unit)) {
      writer.write(block.begin + i, unit);
    } else {
      writer.write_degenerate(block.begin + i, stats);
    }
  }
  return stats;
}

void mark_blocks(IndexRange corners, const FaceSource& faces, int shift,
                 std::uint64_t* bits) noexcept {
  Index last = kInvalidIndex;
  for (Index c = corners.begin; c < corners.end; ++c) {
    const Index b = faces.corner(c) >> shift;
    if (b == last) continue;
    last = b;
    bits[b >> 6] |= std::uint64_t{1} << (b & 63);
  }
}

}  // namespace hedgerow::kernels
