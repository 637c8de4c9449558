#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "hedgerow/buffer.h"
#include "hedgerow/build.h"
#include "kernels/check_faces.h"
#include "kernels/corner_slots.h"
#include "kernels/link_irregular.h"

namespace hedgerow::detail {

/// Makes room for `needed` elements and returns them; what was there is lost where it grows.
template <class T>
std::span<T> grown(Buffer<T>& buffer, Index needed) {
  const auto size = static_cast<std::size_t>(needed);
  if (buffer.size() < size) buffer = Buffer<T>(size);
  return buffer.span().first(size);
}

/// What one worker needs for one block of vertices at a time.
struct WorkerScratch {
  Buffer<kernels::CornerSlot> slots;
  Buffer<Index> counts;
  Buffer<Index> irregular;
  Buffer<Index> large_ends;
  Buffer<kernels::LooseCorner> overflow;
  Buffer<kernels::Corner> large;
  std::vector<kernels::Spoke> spokes;
  std::vector<Index> links;
  std::vector<Defect> defects;
  std::vector<FanStart> fans;

  [[nodiscard]] kernels::CornerSlots slots_for(kernels::VertexBlock block, Index corner_limit) {
    grown(irregular, block.size);
    grown(large_ends, block.size);
    kernels::CornerSlots result{block, grown(slots, block.size).data(),
                                grown(counts, block.size).data(),
                                grown(overflow, corner_limit).data()};
    kernels::clear_slots(result);
    return result;
  }

  [[nodiscard]] kernels::IrregularScratch irregular_for(std::size_t k) {
    spokes.resize(std::max(spokes.size(), 4 * k));
    links.resize(std::max(links.size(), 3 * k));
    defects.resize(std::max(defects.size(), 2 * k + 1));
    fans.resize(std::max(fans.size(), k));
    const std::span<Index> all(links);
    return {std::span(spokes).first(4 * k), all.first(k), all.subspan(k, k),
            all.subspan(2 * k, k),          defects,      fans};
  }
};

/// What a block found that most blocks do not.
struct BlockFindings {
  kernels::LinkStats stats;
  std::vector<Defect> defects;
  std::vector<FanStart> fans;

  void clear() {
    stats = {};
    defects.clear();
    fans.clear();
  }
};

/// All that a build needs beside its result. Grows and stays.
struct BuildScratch {
  Buffer<kernels::RunBlocks> runs;  ///< survey.h
  Buffer<Index> block_runs_first;
  Buffer<Index> block_runs_end;
  Buffer<Index> block_runs;
  Buffer<Index> loose_first;  ///< corner_source.h
  Buffer<Index> chunk_ends;
  Buffer<kernels::LooseCorner> loose;
  Buffer<kernels::LooseTriangleCorner> loose_triangles;
  std::vector<WorkerScratch> workers;  ///< pair.h
  std::vector<BlockFindings> findings;
};

}  // namespace hedgerow::detail
