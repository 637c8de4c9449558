#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

#include "at.h"
#include "hedgerow/normals.h"
#include "kernels/scatter_normals.h"
#include "normals_check.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kRunLength = 1 << 11;  // faces
constexpr Index kMaxBlocks = 256;      // of vertices, one bit each in the table of runs
// Vertices: 128 to 512 KB of sums, which stay in the L2 cache. The larger, the fewer runs of faces
// straddle two blocks and are looked at twice.
constexpr Index kSmallBlock = 1 << 13;
constexpr Index kLargeBlock = 1 << 15;
constexpr Index kBlocks = 64;    // wanted, between the two sizes
constexpr Index kRunGrain = 16;  // runs a task
constexpr std::size_t kCacheLine = 64;

// How the vertices are cut into blocks and the faces into runs: a function of the counts alone, so
// that the scratch size can be told before the faces are read.
struct Plan {
  Index run_count = 0;
  int block_shift = 0;
  Index block_count = 0;
  std::size_t words_per_run = 0;
  std::size_t sums_bytes = 0;

  [[nodiscard]] std::size_t bits_bytes() const noexcept {
    const std::size_t bytes = static_cast<std::size_t>(run_count) * words_per_run * 8;
    return (bytes + kCacheLine - 1) / kCacheLine * kCacheLine;
  }
  [[nodiscard]] std::size_t scratch_bytes() const noexcept { return bits_bytes() + sums_bytes; }
};

Plan plan_of(const FaceList& faces, const Execution& execution) noexcept {
  Plan plan;
  const auto vertices = static_cast<Index>(faces.vertex_count);
  const auto face_count = static_cast<Index>(faces.face_count);
  plan.run_count = face_count / kRunLength + (face_count % kRunLength != 0 ? 1 : 0);
  const Index size = std::clamp(vertices / kBlocks, kSmallBlock, kLargeBlock);
  const Index wanted = std::max(par::grain_of(execution, size), vertices / kMaxBlocks + 1);
  while ((Index{1} << plan.block_shift) < wanted && plan.block_shift < 30) ++plan.block_shift;
  plan.block_count = vertices == 0 ? 0 : ((vertices - 1) >> plan.block_shift) + 1;
  plan.words_per_run = (static_cast<std::size_t>(plan.block_count) + 63) / 64;
  plan.sums_bytes = static_cast<std::size_t>(vertices) * sizeof(kernels::VertexSum);
  return plan;
}

// Which runs of faces touch which blocks of vertices.
class Incidence {
 public:
  Incidence(const Plan& plan, const kernels::FaceSource& faces, std::uint64_t* bits) noexcept
      : plan_(plan), faces_(faces), bits_(bits) {}

  [[nodiscard]] IndexRange faces_of(Index run) const noexcept {
    const Index begin = run * kRunLength;
    return {begin,
            faces_.face_count() - begin < kRunLength ? faces_.face_count() : begin + kRunLength};
  }
  [[nodiscard]] IndexRange corners_of(Index run) const noexcept {
    const IndexRange faces = faces_of(run);
    return {faces_.begin(faces.begin), faces_.begin(faces.end)};
  }

  // False: an index is out of range.
  [[nodiscard]] bool fill(const Execution& execution) {
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

  // Whether the run touches blocks [begin, end), and no others.
  struct Touch {
    bool any;
    bool only;
  };
  [[nodiscard]] Touch touch(Index run, Index begin, Index end) const noexcept {
    const std::uint64_t* row = row_of(run);
    bool any = false;
    bool other = false;
    for (std::size_t w = 0; w < plan_.words_per_run; ++w) {
      const std::uint64_t mask = mask_of(static_cast<Index>(w) * 64, begin, end);
      any |= (row[w] & mask) != 0;
      other |= (row[w] & ~mask) != 0;
    }
    return {any, !other};
  }

  // The first run that touches one of blocks [begin, end), and one behind the last.
  [[nodiscard]] IndexRange runs_of(IndexRange blocks) const noexcept {
    IndexRange runs{plan_.run_count, 0};
    for (Index b = blocks.begin; b < blocks.end; ++b) {
      const IndexRange& its = runs_[at(b)];
      runs = {std::min(runs.begin, its.begin), std::max(runs.end, its.end)};
    }
    return runs;
  }

  // How many groups of `size` blocks the run touches.
  [[nodiscard]] std::int64_t count_groups(Index run, Index size) const noexcept {
    std::int64_t count = 0;
    Index last = kInvalidIndex;
    for_each_block(run, [&](Index b) {
      const Index group = b / size;
      count += group != last;
      last = group;
    });
    return count;
  }

 private:
  struct NotBad {
    bool value = true;
  };

  [[nodiscard]] std::uint64_t* row_of(Index run) const noexcept {
    return bits_ + static_cast<std::size_t>(run) * plan_.words_per_run;
  }

  // Bits [begin, end) of the row that fall in the word that starts at bit `word`.
  static std::uint64_t mask_of(Index word, Index begin, Index end) noexcept {
    const Index low = std::clamp<Index>(begin - word, 0, 64);
    const Index high = std::clamp<Index>(end - word, 0, 64);
    const auto below = [](Index n) {
      return n == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1;
    };
    return below(high) & ~below(low);
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

  void find_runs() noexcept {
    std::fill_n(runs_.begin(), plan_.block_count, IndexRange{plan_.run_count, 0});
    for (Index run = 0; run < plan_.run_count; ++run) {
      for_each_block(run, [&](Index b) {
        IndexRange& runs = runs_[at(b)];
        runs = {std::min(runs.begin, run), run + 1};
      });
    }
  }

  bool fill_run(Index run) const noexcept {
    std::uint64_t* row = row_of(run);
    std::fill_n(row, plan_.words_per_run, std::uint64_t{0});
    const IndexRange corners = corners_of(run);
    if (corners.size() == 0) return true;
    const kernels::CornerBounds bounds = kernels::corner_bounds(corners, faces_);
    if (bounds.smallest < 0 || bounds.largest >= faces_.list.vertex_count) return false;
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

  const Plan& plan_;
  const kernels::FaceSource& faces_;
  std::uint64_t* bits_;
  std::array<IndexRange, kMaxBlocks> runs_;  // for each block
};

// Blocks a task: the fewest that keep the visits of runs below 3/2 of the corners, and no more
// tasks than threads where no number does (faces in random order).
Index choose_group(const Plan& plan, const Incidence& incidence, const Execution& execution,
                   std::int64_t corner_count) noexcept {
  const auto threads = static_cast<Index>(execution.threads());
  const Index per_thread = (plan.block_count + threads - 1) / threads;
  for (Index size = 1; size < per_thread; size *= 2) {
    std::int64_t visited = 0;
    for (Index run = 0; run < plan.run_count && 2 * visited <= 3 * corner_count; ++run) {
      visited += static_cast<std::int64_t>(incidence.corners_of(run).size()) *
                 incidence.count_groups(run, size);
    }
    if (2 * visited <= 3 * corner_count) return size;
  }
  return std::max<Index>(per_thread, 1);
}

NormalStats scatter_block(const kernels::ScatterInput& input, const Incidence& incidence,
                          IndexRange blocks, const kernels::SumBlock& block,
                          const kernels::NormalWriter& writer) {
  // All bits zero is a sum of nothing; clearing bytes is a quarter of the work of copying sums.
  static_assert(std::is_trivially_copyable_v<kernels::VertexSum>);
  std::memset(static_cast<void*>(block.sums), 0,
              static_cast<std::size_t>(block.size) * sizeof(kernels::VertexSum));
  const IndexRange runs = incidence.runs_of(blocks);
  const auto for_each_run = [&](const auto& visit) {
    for (Index run = runs.begin; run < runs.end; ++run) {
      const Incidence::Touch touch = incidence.touch(run, blocks.begin, blocks.end);
      if (touch.any) visit(incidence.faces_of(run), touch.only);
    }
  };
  for_each_run([&](IndexRange faces, bool is_inside) {
    kernels::scatter_faces(faces, input, block, is_inside);
  });
  Index again_count = 0;
  const NormalStats stats = kernels::finish_sums(block, writer, again_count);
  if (again_count == 0) return stats;
  for_each_run([&](IndexRange faces, bool) { kernels::scatter_exponents(faces, input, block); });
  for_each_run([&](IndexRange faces, bool) { kernels::scatter_scaled(faces, input, block); });
  return kernels::merge(stats, kernels::finish_scaled(block, writer));
}

}  // namespace

std::size_t scatter_vertex_normals_scratch_bytes(const FaceList& faces, const NormalOptions&,
                                                 const Execution& execution) {
  return plan_of(faces, execution).scratch_bytes();
}

Result<NormalStats> scatter_vertex_normals(const FaceList& faces, Positions positions,
                                           NormalsOut out, const NormalOptions& options,
                                           const Execution& execution, Workspace& workspace) {
  if (auto ok = check(faces); !ok) return fail(ok.error());
  if (auto ok = detail::check_arrays(positions, faces.vertex_count, out, faces.vertex_count); !ok) {
    return fail(ok.error());
  }
  const Plan plan = plan_of(faces, execution);
  if (!workspace.reserve(plan.scratch_bytes())) {
    return fail({ErrorCode::scratch_too_small, kInvalidIndex,
                 static_cast<std::int64_t>(workspace.size_bytes()),
                 static_cast<std::int64_t>(plan.scratch_bytes())});
  }
  const kernels::ScatterInput input{
      kernels::FaceSource(faces), {positions}, options.weight, options.polygon};
  Incidence incidence(plan, input.faces, reinterpret_cast<std::uint64_t*>(workspace.data()));
  if (!incidence.fill(execution)) return fail(detail::find_bad_index(input.faces));

  auto* sums = reinterpret_cast<kernels::VertexSum*>(workspace.data() + plan.bits_bytes());
  const kernels::NormalWriter writer =
      detail::normal_writer(out, faces.vertex_count, options.degenerate);
  const Index group = choose_group(plan, incidence, execution, faces.corner_count());
  const Index task_count = (plan.block_count + group - 1) / group;
  const auto vertices = static_cast<Index>(faces.vertex_count);
  // Sums are only needed while their block is added to, so tasks take turns in the same memory.
  const bool has_turns = par::slot_count(execution, task_count) < task_count;
  return par::reduce_tasks<NormalStats>(
      execution, task_count,
      [&](Index task, Index slot) {
        const IndexRange blocks{task * group, std::min(plan.block_count, (task + 1) * group)};
        const Index begin = blocks.begin << plan.block_shift;
        const Index size =
            blocks.end == plan.block_count ? vertices - begin : blocks.size() << plan.block_shift;
        const std::size_t place = static_cast<std::size_t>(has_turns ? slot : task) *
                                  (static_cast<std::size_t>(group) << plan.block_shift);
        return scatter_block(input, incidence, blocks, {begin, size, sums + place}, writer);
      },
      kernels::merge);
}

}  // namespace hedgerow
