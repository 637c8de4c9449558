#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "at.h"
#include "hedgerow/execution.h"
#include "hedgerow/face_list.h"
#include "kernels/normals_source.h"

/// Which runs of faces touch which vertices: what the linear face list has to know before it adds.
namespace hedgerow::detail {

/// How the vertices are cut into blocks and the faces into runs: a function of the counts alone, so
/// that the scratch size can be told before the faces are read.
struct ScatterPlan {
  static constexpr Index kRunLength = 1 << 11;  // faces
  static constexpr Index kMaxBlocks = 256;      // of vertices, one bit each in the table of runs

  Index face_count = 0;
  Index vertex_count = 0;
  Index run_count = 0;
  int block_shift = 0;
  Index block_count = 0;
  std::size_t words_per_run = 0;

  [[nodiscard]] std::size_t bits_bytes() const noexcept;
  [[nodiscard]] std::size_t ranges_bytes() const noexcept;
  [[nodiscard]] std::size_t needed_bytes() const noexcept;
  [[nodiscard]] std::size_t sums_bytes() const noexcept;
  [[nodiscard]] std::size_t table_bytes() const noexcept {
    return bits_bytes() + ranges_bytes() + needed_bytes();
  }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept { return table_bytes() + sums_bytes(); }

  [[nodiscard]] Index block_size() const noexcept { return Index{1} << block_shift; }
  [[nodiscard]] IndexRange faces_of(Index run) const noexcept;
  /// The vertices of blocks [begin, end).
  [[nodiscard]] IndexRange vertices_of(IndexRange blocks) const noexcept;
};

[[nodiscard]] ScatterPlan scatter_plan(const FaceList& faces, const Execution& execution) noexcept;

/// A bit for each run of faces and block of vertices, and the range of vertices of each run.
class RunTable {
 public:
  /// In `plan.table_bytes()` bytes of memory, 64-byte aligned, as long as the table is used.
  RunTable(const ScatterPlan& plan, const kernels::FaceSource& faces, std::byte* memory) noexcept;

  /// False: an index is out of range.
  [[nodiscard]] bool fill(const Execution& execution);

  [[nodiscard]] const ScatterPlan& plan() const noexcept { return plan_; }
  [[nodiscard]] std::int64_t corner_count(Index run) const noexcept;

  /// From the smallest vertex of a run to behind the largest; none if it has no corner.
  [[nodiscard]] IndexRange range_of(Index run) const noexcept { return ranges_[run]; }

  /// Whether the run touches one of these blocks, and no others.
  struct Touch {
    bool any;
    bool only;
  };
  [[nodiscard]] Touch touch(Index run, IndexRange blocks) const noexcept;

  /// The first run that touches one of these blocks, and one behind the last.
  [[nodiscard]] IndexRange runs_of(IndexRange blocks) const noexcept;

  /// How many groups of `size` blocks the run touches.
  [[nodiscard]] std::int64_t count_groups(Index run, Index size) const noexcept;

  /// An entry a run, for whoever plans with the table.
  [[nodiscard]] Index* needed() const noexcept { return needed_; }

 private:
  [[nodiscard]] std::uint64_t* row_of(Index run) const noexcept {
    return bits_ + static_cast<std::size_t>(run) * plan_.words_per_run;
  }
  // Calls visit(block) for those that the run touches, in ascending order.
  template <class Visit>
  void for_each_block(Index run, const Visit& visit) const noexcept {
    const std::uint64_t* row = row_of(run);
    for (std::size_t w = 0; w < plan_.words_per_run; ++w) {
      for (std::uint64_t word = row[w]; word != 0; word &= word - 1) {
        visit(static_cast<Index>(w) * 64 + std::countr_zero(word));
      }
    }
  }
  [[nodiscard]] IndexRange corners_of(Index run) const noexcept;
  void find_runs() noexcept;
  bool fill_run(Index run) const noexcept;

  const ScatterPlan& plan_;
  const kernels::FaceSource& faces_;
  std::uint64_t* bits_;
  IndexRange* ranges_;
  Index* needed_;
  std::array<IndexRange, ScatterPlan::kMaxBlocks> runs_;  // for each block
};

}  // namespace hedgerow::detail
