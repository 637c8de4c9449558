#pragma once

#include <array>

#include "kernels/scatter_normals.h"
#include "scatter/run_table.h"

/// The sums of a task in a window over its vertices. Where faces and vertices are in a local order,
/// no face touches what lies behind by some rows of the mesh any more: it is finished, and the
/// window slides on. So a task may have many vertices and yet all its sums in the L2 cache, and few
/// faces straddle two tasks and are added for each.
namespace hedgerow::detail {

/// Which tasks of `group` blocks each can have such a window.
class WindowPlan {
 public:
  /// Refers to the table and writes its `needed`. O(runs).
  WindowPlan(const RunTable& table, Index group) noexcept;

  [[nodiscard]] Index group() const noexcept { return group_; }
  [[nodiscard]] Index task_count() const noexcept {
    return (table_.plan().block_count + group_ - 1) / group_;
  }
  /// How many tasks have more vertices than a window, and how many of these can slide it.
  [[nodiscard]] Index large_count() const noexcept { return large_count_; }
  [[nodiscard]] Index sliding_count() const noexcept { return sliding_count_; }

  [[nodiscard]] IndexRange blocks_of(Index task) const noexcept;
  [[nodiscard]] bool slides(Index task) const noexcept { return slides_[at(task)]; }
  /// Vertices at once.
  [[nodiscard]] Index window_size() const noexcept;
  /// The first vertex from `begin` on, where a task begins, that this run or one after it touches.
  [[nodiscard]] Index first_needed(Index run, Index begin) const noexcept {
    return table_.range_of(run).begin < begin ? begin : table_.needed()[run];
  }

 private:
  bool find_needed(IndexRange blocks) noexcept;

  const RunTable& table_;
  Index group_;
  Index large_count_ = 0;
  Index sliding_count_ = 0;
  std::array<bool, ScatterPlan::kMaxBlocks> slides_{};
};

/// Adds the faces of a task to its vertices and writes their normals, by a window that slides; by
/// one that holds them all. `sums`: `window_size()` of them; one for each vertex.
[[nodiscard]] NormalStats scatter_sliding(const kernels::ScatterInput& input, const RunTable& table,
                                          const WindowPlan& plan, Index task,
                                          kernels::VertexSum* sums,
                                          const kernels::NormalWriter& writer) noexcept;
[[nodiscard]] NormalStats scatter_whole(const kernels::ScatterInput& input, const RunTable& table,
                                        IndexRange blocks, kernels::VertexSum* sums,
                                        const kernels::NormalWriter& writer) noexcept;

}  // namespace hedgerow::detail
