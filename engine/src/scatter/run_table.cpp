#include "scatter/run_table.h"

#include <algorithm>

#include "kernels/scatter_normals.h"
#include "parallel/parallel.h"

namespace hedgerow::detail {

namespace {

// Vertices: 128 to 512 KB of sums, which stay in the L2 cache. The larger, the fewer runs of faces
// straddle two blocks and are looked at twice.
constexpr Index kSmallBlock = 1 << 13;
constexpr Index kLargeBlock = 1 << 15;
constexpr Index kBlocks = 64;    // wanted, between the two sizes
constexpr Index kRunGrain = 16;  // runs a task

constexpr std::size_t whole_lines(std::size_t bytes) noexcept {
  constexpr std::size_t kCacheLine = 64;
  return (bytes + kCacheLine - 1) / kCacheLine * kCacheLine;
}

struct NotBad {
  bool value = true;
};

// Bits [begin, end) of a row that fall in the word that starts at bit `word`.
std::uint64_t mask_of(Index word, IndexRange blocks) noexcept {
  const Index low = std::clamp<Index>(blocks.begin - word, 0, 64);
  const Index high = std::clamp<Index>(blocks.end - word, 0, 64);
  const auto below = [](Index n) {
    return n == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1;
  };
  return below(high) & ~below(low);
}

}  // namespace

std::size_t ScatterPlan::bits_bytes() const noexcept {
  return whole_lines(static_cast<std::size_t>(run_count) * words_per_run * sizeof(std::uint64_t));
}
std::size_t ScatterPlan::ranges_bytes() const noexcept {
  return whole_lines(static_cast<std::size_t>(run_count) * sizeof(IndexRange));
}
std::size_t ScatterPlan::needed_bytes() const noexcept {
  return whole_lines(static_cast<std::size_t>(run_count) * sizeof(Index));
}
std::size_t ScatterPlan::sums_bytes() const noexcept {
  return static_cast<std::size_t>(vertex_count) * sizeof(kernels::VertexSum);
}

IndexRange ScatterPlan::faces_of(Index run) const noexcept {
  const Index begin = run * kRunLength;
  return {begin, face_count - begin < kRunLength ? face_count : begin + kRunLength};
}

IndexRange ScatterPlan::vertices_of(IndexRange blocks) const noexcept {
  return {blocks.begin << block_shift,
          blocks.end == block_count ? vertex_count : blocks.end << block_shift};
}

ScatterPlan scatter_plan(const FaceList& faces, const Execution& execution) noexcept {
  ScatterPlan plan;
  plan.vertex_count = static_cast<Index>(faces.vertex_count);
  plan.face_count = static_cast<Index>(faces.face_count);
  const Index last_run = plan.face_count % ScatterPlan::kRunLength != 0 ? 1 : 0;
  plan.run_count = plan.face_count / ScatterPlan::kRunLength + last_run;
  const Index size = std::clamp(plan.vertex_count / kBlocks, kSmallBlock, kLargeBlock);
  const Index least = plan.vertex_count / ScatterPlan::kMaxBlocks + 1;
  const Index wanted = std::max(par::grain_of(execution, size), least);
  while (plan.block_size() < wanted && plan.block_shift < 30) ++plan.block_shift;
  plan.block_count = plan.vertex_count == 0 ? 0 : ((plan.vertex_count - 1) >> plan.block_shift) + 1;
  plan.words_per_run = (static_cast<std::size_t>(plan.block_count) + 63) / 64;
  return plan;
}

RunTable::RunTable(const ScatterPlan& plan, const kernels::FaceSource& faces,
                   std::byte* memory) noexcept
    : plan_(plan),
      faces_(faces),
      bits_(reinterpret_cast<std::uint64_t*>(memory)),
      ranges_(reinterpret_cast<IndexRange*>(memory + plan.bits_bytes())),
      needed_(reinterpret_cast<Index*>(memory + plan.bits_bytes() + plan.ranges_bytes())) {}

bool RunTable::fill(const Execution& execution) {
  const NotBad good = par::reduce<NotBad>(
      execution.with_grain(0), plan_.run_count, kRunGrain,
      [&](IndexRange runs) {
        NotBad part;
        for (Index run = runs.begin; run < runs.end; ++run) part.value &= fill_run(run);
        return part;
      },
      [](NotBad a, NotBad b) { return NotBad{a.value && b.value}; });
  find_runs();
  return good.value;
}

std::int64_t RunTable::corner_count(Index run) const noexcept { return corners_of(run).size(); }

RunTable::Touch RunTable::touch(Index run, IndexRange blocks) const noexcept {
  const std::uint64_t* row = row_of(run);
  bool any = false;
  bool other = false;
  for (std::size_t w = 0; w < plan_.words_per_run; ++w) {
    const std::uint64_t mask = mask_of(static_cast<Index>(w) * 64, blocks);
    any |= (row[w] & mask) != 0;
    other |= (row[w] & ~mask) != 0;
  }
  return {any, !other};
}

IndexRange RunTable::runs_of(IndexRange blocks) const noexcept {
  IndexRange runs{plan_.run_count, 0};
  for (Index b = blocks.begin; b < blocks.end; ++b) {
    const IndexRange& its = runs_[at(b)];
    runs = {std::min(runs.begin, its.begin), std::max(runs.end, its.end)};
  }
  return runs;
}

std::int64_t RunTable::count_groups(Index run, Index size) const noexcept {
  std::int64_t count = 0;
  Index last = kInvalidIndex;
  for_each_block(run, [&](Index b) {
    const Index group = b / size;
    count += group != last;
    last = group;
  });
  return count;
}

IndexRange RunTable::corners_of(Index run) const noexcept {
  const IndexRange faces = plan_.faces_of(run);
  return {faces_.begin(faces.begin), faces_.begin(faces.end)};
}

void RunTable::find_runs() noexcept {
  std::fill_n(runs_.begin(), plan_.block_count, IndexRange{plan_.run_count, 0});
  for (Index run = 0; run < plan_.run_count; ++run) {
    for_each_block(run, [&](Index b) {
      IndexRange& runs = runs_[at(b)];
      runs = {std::min(runs.begin, run), run + 1};
    });
  }
}

bool RunTable::fill_run(Index run) const noexcept {
  std::uint64_t* row = row_of(run);
  std::fill_n(row, plan_.words_per_run, std::uint64_t{0});
  ranges_[run] = {0, 0};
  const IndexRange corners = corners_of(run);
  if (corners.size() == 0) return true;
  const kernels::CornerBounds bounds = kernels::corner_bounds(corners, faces_);
  if (bounds.smallest < 0 || bounds.largest >= faces_.list.vertex_count) return false;
  ranges_[run] = {static_cast<Index>(bounds.smallest), static_cast<Index>(bounds.largest) + 1};
  const auto first = static_cast<Index>(bounds.smallest) >> plan_.block_shift;
  const auto last = static_cast<Index>(bounds.largest) >> plan_.block_shift;
  if (last - first <= 1) {
    // All of one or two neighbouring blocks is touched; no need to look again.
    row[first >> 6] |= std::uint64_t{1} << (first & 63);
    row[last >> 6] |= std::uint64_t{1} << (last & 63);
  } else {
    kernels::mark_blocks(corners, faces_, plan_.block_shift, row);
  }
  return true;
}

}  // namespace hedgerow::detail
