#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "kernels/curve_keys.h"
#include "parallel/parallel.h"
#include "reorder/orders.h"
#include "reorder/stable_sort.h"

namespace hedgerow::detail {

namespace {

constexpr Index kCurveGrain = 1 << 14;  // vertices a task: 400 KB read and written

Buffer<Index> along_curve(const Positions& positions, Index vertex_count,
                          const Execution& execution, kernels::CurveKey* key_of, float shift = 0) {
  kernels::Box box = par::reduce<kernels::Box>(
      execution, vertex_count, kCurveGrain,
      [&](IndexRange range) { return kernels::find_box(range, positions); },
      [](const kernels::Box& a, const kernels::Box& b) { return join(a, b); });
  float longest = 0;
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, box.high[k] - box.low[k]);
  for (float& low : box.low) {
    const float lower = low - shift * longest;
    if (std::isfinite(lower)) low = lower;
  }
  const kernels::Lattice lattice(box);
  Buffer<kernels::KeyedItem> items(static_cast<std::size_t>(vertex_count));
  par::for_each_range(execution, vertex_count, kCurveGrain, [&](IndexRange range) {
    kernels::fill_curve_keys(range, positions, lattice, key_of, items.data());
  });
  return sorted_items(std::move(items), execution);
}

std::uint64_t cell_key(kernels::Cell cell) noexcept {
  constexpr unsigned kAxisBits = 11;
  return kernels::morton_key(cell) >> 3 * (kernels::kBitsPerAxis - kAxisBits);
}

}  // namespace

Buffer<Index> vertices_by_cells(const Positions& positions, Index vertex_count,
                                const Execution& execution, float shift) {
  return along_curve(positions, vertex_count, execution, cell_key, shift);
}

Buffer<Index> hilbert_vertices(const Positions& positions, Index vertex_count,
                               const Execution& execution) {
  return along_curve(positions, vertex_count, execution, kernels::hilbert_key);
}

Buffer<Index> morton_vertices(const Positions& positions, Index vertex_count,
                              const Execution& execution) {
  return along_curve(positions, vertex_count, execution, kernels::morton_key);
}

}  // namespace hedgerow::detail
