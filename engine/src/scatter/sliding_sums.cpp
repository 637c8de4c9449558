#include "scatter/sliding_sums.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace hedgerow::detail {

namespace {

using kernels::ScatterInput;
using kernels::SumBlock;
using kernels::VertexSum;

constexpr Index kMostSums = 1 << 15;  // 512 KB, which stay in the L2 cache

void clear(VertexSum* sums, Index count) noexcept {
  // All bits zero is a sum of nothing; clearing bytes is a quarter of the work of copying sums.
  static_assert(std::is_trivially_copyable_v<VertexSum>);
  std::memset(static_cast<void*>(sums), 0, static_cast<std::size_t>(count) * sizeof(VertexSum));
}

// Calls visit(run, is_inside) for each that touches one of the blocks, in ascending order.
template <class Visit>
void for_each_run(const RunTable& table, IndexRange blocks, const Visit& visit) {
  const IndexRange runs = table.runs_of(blocks);
  for (Index run = runs.begin; run < runs.end; ++run) {
    const RunTable::Touch touch = table.touch(run, blocks);
    if (touch.any) visit(run, touch.only);
  }
}

// The normals of sums that are complete.
NormalStats finish(const ScatterInput& input, const RunTable& table, const SumBlock& block,
                   const kernels::NormalWriter& writer) noexcept {
  Index again_count = 0;
  const NormalStats stats = kernels::finish_sums(block, writer, again_count);
  if (again_count == 0) return stats;
  const ScatterPlan& plan = table.plan();
  const IndexRange blocks{block.begin >> plan.block_shift,
                          ((block.begin + block.size - 1) >> plan.block_shift) + 1};
  for_each_run(table, blocks, [&](Index run, bool) {
    kernels::scatter_exponents(plan.faces_of(run), input, block);
  });
  for_each_run(table, blocks,
               [&](Index run, bool) { kernels::scatter_scaled(plan.faces_of(run), input, block); });
  return kernels::merge(stats, kernels::finish_scaled(block, writer));
}

class Window {
 public:
  Window(const ScatterInput& input, const RunTable& table, IndexRange vertices, Index size,
         VertexSum* sums, const kernels::NormalWriter& writer) noexcept
      : input_(input),
        table_(table),
        writer_(writer),
        end_(vertices.end),
        touched_(vertices.begin),
        sums_{vertices.begin, std::min(size, vertices.size()), sums} {
    clear(sums, sums_.size);
  }

  [[nodiscard]] Index end() const noexcept { return sums_.begin + sums_.size; }
  [[nodiscard]] const NormalStats& stats() const noexcept { return stats_; }

  void add(Index run) noexcept {
    const IndexRange range = table_.range_of(run);
    touched_ = std::max(touched_, std::min(range.end, end()));
    kernels::scatter_faces(table_.plan().faces_of(run), input_, sums_,
                           range.begin >= sums_.begin && range.end <= end());
  }

  // \pre no run that is still to come touches a vertex before `begin`
  void move_to(Index begin) noexcept {
    while (sums_.begin < begin) {
      const Index count = std::min(begin - sums_.begin, sums_.size);
      stats_ =
          kernels::merge(stats_, finish(input_, table_, {sums_.begin, count, sums_.sums}, writer_));
      drop(count);
    }
  }

 private:
  // Moves what lies behind the first `count` sums to the front.
  void drop(Index count) noexcept {
    const Index used = std::max(touched_ - sums_.begin, count);
    const Index kept = used - count;
    std::memmove(static_cast<void*>(sums_.sums), sums_.sums + count,
                 static_cast<std::size_t>(kept) * sizeof(VertexSum));
    clear(sums_.sums + kept, used - kept);
    sums_.begin += count;
    sums_.size = std::min(sums_.size, end_ - sums_.begin);
  }

  const ScatterInput& input_;
  const RunTable& table_;
  const kernels::NormalWriter& writer_;
  Index end_;      // of the task's vertices
  Index touched_;  // no vertex from here on has been added to
  SumBlock sums_;
  NormalStats stats_;
};

}  // namespace

WindowPlan::WindowPlan(const RunTable& table, Index group) noexcept : table_(table), group_(group) {
  // Backwards, so that of two tasks that share a run the lower one has its entry.
  for (Index task = task_count(); task-- > 0;) {
    const IndexRange blocks = blocks_of(task);
    if (table.plan().vertices_of(blocks).size() <= window_size()) continue;
    ++large_count_;
    slides_[at(task)] = find_needed(blocks);
    sliding_count_ += slides_[at(task)];
  }
}

IndexRange WindowPlan::blocks_of(Index task) const noexcept {
  return {task * group_, std::min(table_.plan().block_count, (task + 1) * group_)};
}

Index WindowPlan::window_size() const noexcept {
  return std::min(table_.plan().block_size(), kMostSums);
}

// Finds what is needed of each run of a task, and whether a window gets through.
bool WindowPlan::find_needed(IndexRange blocks) noexcept {
  const IndexRange vertices = table_.plan().vertices_of(blocks);
  const IndexRange runs = table_.runs_of(blocks);
  Index needed = vertices.end;
  for (Index run = runs.end; run-- > runs.begin;) {
    if (!table_.touch(run, blocks).any) continue;
    const Index first = table_.range_of(run).begin;
    needed = std::min(needed, std::max(first, vertices.begin));
    if (first >= vertices.begin) table_.needed()[run] = needed;
  }
  Index begin = vertices.begin;
  for (Index run = runs.begin; run < runs.end; ++run) {
    if (!table_.touch(run, blocks).any) continue;
    const Index end = std::min(table_.range_of(run).end, vertices.end);
    if (end > begin + window_size()) begin = first_needed(run, vertices.begin);
    if (end > begin + window_size()) return false;
  }
  return true;
}

NormalStats scatter_sliding(const ScatterInput& input, const RunTable& table,
                            const WindowPlan& plan, Index task, VertexSum* sums,
                            const kernels::NormalWriter& writer) noexcept {
  const IndexRange blocks = plan.blocks_of(task);
  const IndexRange vertices = table.plan().vertices_of(blocks);
  Window window(input, table, vertices, plan.window_size(), sums, writer);
  for_each_run(table, blocks, [&](Index run, bool) {
    if (std::min(table.range_of(run).end, vertices.end) > window.end()) {
      window.move_to(plan.first_needed(run, vertices.begin));
    }
    window.add(run);
  });
  window.move_to(vertices.end);
  return window.stats();
}

NormalStats scatter_whole(const ScatterInput& input, const RunTable& table, IndexRange blocks,
                          VertexSum* sums, const kernels::NormalWriter& writer) noexcept {
  const IndexRange vertices = table.plan().vertices_of(blocks);
  const SumBlock block{vertices.begin, vertices.size(), sums};
  clear(sums, block.size);
  for_each_run(table, blocks, [&](Index run, bool is_inside) {
    kernels::scatter_faces(table.plan().faces_of(run), input, block, is_inside);
  });
  return finish(input, table, block, writer);
}

}  // namespace hedgerow::detail
