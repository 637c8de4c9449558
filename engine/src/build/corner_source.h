#pragma once

#include <span>

#include "build/survey.h"
#include "kernels/corner_slots.h"

/// The two ways in which a block of vertices gets its corners, in ascending half-edge order. Both
/// answer the same calls: `limit` says how many there are at the most, `place` adds them to slots.
namespace hedgerow::detail {

/// Scans the runs of faces that touch the block. Nothing is stored, but a run that touches several
/// blocks is read for each: right for inputs whose order is local.
class WindowSource {
 public:
  WindowSource(const kernels::FaceColumns& faces, const Survey& survey, BuildScratch& scratch)
      : faces_(faces), runs_of_faces_(survey.runs), runs_(runs_of_blocks(survey, scratch)) {}

  [[nodiscard]] Index limit(Index b) const noexcept {
    Index corners = 0;
    for_each_run(b, [&](Index, IndexRange run) {
      corners += faces_.begin(run.end) - faces_.begin(run.begin);
    });
    return corners;
  }
  void place(Index b, kernels::CornerSlots& slots) const noexcept {
    for_each_run(b, [&](Index r, IndexRange run) {
      const bool is_inside = runs_of_faces_[static_cast<std::size_t>(r)].count == 1;
      kernels::place_corners(run, faces_,
                             is_inside ? kernels::Faces::all_inside : kernels::Faces::some_outside,
                             slots);
    });
  }

 private:
  template <class Visit>
  void for_each_run(Index b, const Visit& visit) const noexcept {
    const auto block = static_cast<std::size_t>(b);
    for (Index i = runs_.first[block]; i < runs_.first[block + 1]; ++i) {
      const Index r = runs_.runs[static_cast<std::size_t>(i)];
      const Index begin = r * Survey::kRunLength;
      const Index end = begin + Survey::kRunLength;
      visit(r, IndexRange{begin, end < faces_.face_count ? end : faces_.face_count});
    }
  }

  const kernels::FaceColumns& faces_;
  std::span<const kernels::RunBlocks> runs_of_faces_;
  BlockRuns runs_;
};

/// Partitions all corners by block first. Reads the faces twice and writes 16 bytes a corner, 20 of
/// polygons, in any order of the input.
template <class Loose>
class PartitionSource {
 public:
  /// `memory` has room for all corners.
  PartitionSource(const kernels::FaceColumns& faces, const Blocks& blocks, std::span<Loose> memory,
                  BuildScratch& scratch, const Execution& execution);

  [[nodiscard]] Index limit(Index b) const noexcept {
    return static_cast<Index>(corners_of(b).size());
  }
  void place(Index b, kernels::CornerSlots& slots) const noexcept {
    kernels::place_loose(corners_of(b), slots);
  }

 private:
  [[nodiscard]] std::span<const Loose> corners_of(Index b) const noexcept {
    const auto block = static_cast<std::size_t>(b);
    const auto begin = static_cast<std::size_t>(first_[block]);
    return loose_.subspan(begin, static_cast<std::size_t>(first_[block + 1]) - begin);
  }

  std::span<Index> first_;
  std::span<Loose> loose_;
};

/// The face of a half-edge: arithmetic for triangles, a binary search for polygons.
[[nodiscard]] FaceId face_of(const kernels::FaceColumns& faces, HalfedgeId h) noexcept;

}  // namespace hedgerow::detail
