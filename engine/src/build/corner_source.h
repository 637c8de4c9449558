#pragma once

#include <span>

#include "build/survey.h"
#include "kernels/corner_blocks.h"

/// The two ways in which a block of vertices gets its corners. Both answer the same calls, in
/// ascending half-edge order: `count` adds to the corners of each vertex, `place` writes them.
namespace hedgerow::detail {

/// Scans the runs of faces that touch the block. Nothing is stored, but a run that touches several
/// blocks is read for each: right for inputs whose order is local.
class WindowSource {
 public:
  WindowSource(const kernels::FaceColumns& faces, const Survey& survey)
      : faces_(faces), runs_(runs_of_blocks(survey)) {}

  void count(Index b, kernels::VertexBlock block, Index* counts) const noexcept {
    for_each_run(b, [&](IndexRange run) { kernels::count_corners(run, faces_, block, counts); });
  }
  void place(Index b, kernels::VertexBlock block, Index* ends,
             kernels::Corner* corners) const noexcept {
    for_each_run(
        b, [&](IndexRange run) { kernels::place_corners(run, faces_, block, ends, corners); });
  }

 private:
  template <class Visit>
  void for_each_run(Index b, const Visit& visit) const noexcept {
    const auto block = static_cast<std::size_t>(b);
    for (Index i = runs_.first[block]; i < runs_.first[block + 1]; ++i) {
      const Index begin = runs_.runs[static_cast<std::size_t>(i)] * Survey::kRunLength;
      const Index end = begin + Survey::kRunLength;
      visit(IndexRange{begin, end < faces_.face_count ? end : faces_.face_count});
    }
  }

  const kernels::FaceColumns& faces_;
  BlockRuns runs_;
};

/// Partitions all corners by block first. Reads the faces twice and writes 20 bytes a corner, in
/// any order of the input.
class PartitionSource {
 public:
  PartitionSource(const kernels::FaceColumns& faces, const Blocks& blocks,
                  const Execution& execution);

  void count(Index b, kernels::VertexBlock block, Index* counts) const noexcept {
    kernels::count_loose(corners_of(b), block, counts);
  }
  void place(Index b, kernels::VertexBlock block, Index* ends,
             kernels::Corner* corners) const noexcept {
    kernels::place_loose(corners_of(b), block, ends, corners);
  }

 private:
  [[nodiscard]] std::span<const kernels::LooseCorner> corners_of(Index b) const noexcept {
    const auto block = static_cast<std::size_t>(b);
    const auto begin = static_cast<std::size_t>(first_[block]);
    return loose_.span().subspan(begin, static_cast<std::size_t>(first_[block + 1]) - begin);
  }

  Buffer<Index> first_;
  Buffer<kernels::LooseCorner> loose_;
};

/// The face of a half-edge: arithmetic for triangles, a binary search for polygons.
[[nodiscard]] FaceId face_of(const kernels::FaceColumns& faces, HalfedgeId h) noexcept;

}  // namespace hedgerow::detail
