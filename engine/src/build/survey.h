#pragma once

#include <cstdint>
#include <span>

#include "build/scratch.h"
#include "hedgerow/execution.h"
#include "kernels/check_faces.h"
#include "kernels/face_columns.h"

namespace hedgerow::detail {

/// Blocks of 2^block_shift vertices: the unit in which corners are brought together, small enough
/// that the corners of a block stay in a second-level cache.
struct Blocks {
  int shift = 0;
  Index count = 0;

  [[nodiscard]] Index begin(Index block) const noexcept { return block << shift; }
};

[[nodiscard]] Blocks blocks_of(const kernels::FaceColumns& faces) noexcept;

/// One look at every face: what cannot be kept, and which runs of faces touch which blocks.
struct Survey {
  static constexpr Index kRunLength = 512;  ///< faces: 6 KB of triangle indices

  kernels::FaceCheck check;
  Blocks blocks;
  std::span<const kernels::RunBlocks> runs;  ///< in the scratch memory
  /// Faces that all blocks would scan together, per face, times 1000: 1000 is a perfect order.
  std::int64_t scan_per_mille = 0;
};

[[nodiscard]] Survey survey(const kernels::FaceColumns& faces, BuildScratch& scratch,
                            const Execution& execution);

/// The survey the other way round: for each block, the runs that touch it, ascending.
struct BlockRuns {
  std::span<const Index> first;  ///< blocks + 1
  std::span<const Index> runs;
};

[[nodiscard]] BlockRuns runs_of_blocks(const Survey& survey, BuildScratch& scratch);

}  // namespace hedgerow::detail
