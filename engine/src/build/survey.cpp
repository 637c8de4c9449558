#include "build/survey.h"

#include <algorithm>

#include "kernels/corner_blocks.h"
#include "parallel/parallel.h"

namespace hedgerow::detail {

namespace {

// 8,192 slots of 128 bytes are 1 MB, half of many second-level caches; PERF.md, "Did not help".
constexpr int kMinShift = 13;
constexpr Index kMaxBlocks = 1 << 16;
constexpr Index kSurveyGrain = 32;  // runs a task: 16,384 faces

bool is_wide(const kernels::RunBlocks& run) noexcept {
  return run.count > kernels::RunBlocks::kCapacity;
}

template <class Visit>
void for_each_block(const kernels::RunBlocks& run, Index block_count, const Visit& visit) {
  if (is_wide(run)) {
    for (Index b = 0; b < block_count; ++b) visit(b);
  } else {
    for (Index i = 0; i < run.count; ++i) visit(run.block[i]);
  }
}

}  // namespace

Blocks blocks_of(const kernels::FaceColumns& faces) noexcept {
  if (faces.vertex_count == 0) return {};
  int shift = kMinShift;
  while ((faces.vertex_count - 1) >> shift >= kMaxBlocks) ++shift;
  return {shift, ((faces.vertex_count - 1) >> shift) + 1};
}

Survey survey(const kernels::FaceColumns& faces, BuildScratch& scratch,
              const Execution& execution) {
  Survey result;
  result.blocks = blocks_of(faces);
  const Index run_count = (faces.face_count + Survey::kRunLength - 1) / Survey::kRunLength;
  const std::span<kernels::RunBlocks> runs = grown(scratch.runs, run_count);
  result.runs = runs;
  result.check = par::reduce<kernels::FaceCheck>(
      execution, run_count, kSurveyGrain,
      [&](IndexRange range) {
        return kernels::check_runs(range, faces, Survey::kRunLength, result.blocks.shift,
                                   runs.data());
      },
      [](kernels::FaceCheck a, kernels::FaceCheck b) { return a + b; });
  std::int64_t scanned = 0;
  for (const kernels::RunBlocks& run : result.runs) {
    scanned += is_wide(run) ? result.blocks.count : run.count;
  }
  if (run_count > 0) {
    result.scan_per_mille = 1000 * scanned * Survey::kRunLength / faces.face_count;
  }
  return result;
}

BlockRuns runs_of_blocks(const Survey& survey, BuildScratch& scratch) {
  const Index block_count = survey.blocks.count;
  const std::span<Index> first = grown(scratch.block_runs_first, block_count + 1);
  std::fill(first.begin(), first.end(), Index{0});
  for (const kernels::RunBlocks& run : survey.runs) {
    for_each_block(run, block_count, [&](Index b) { ++first[static_cast<std::size_t>(b)]; });
  }
  const Index total = kernels::exclusive_scan(first.data(), block_count + 1);
  const std::span<Index> runs = grown(scratch.block_runs, total);
  const std::span<Index> end = grown(scratch.block_runs_end, block_count + 1);
  std::copy(first.begin(), first.end(), end.begin());
  for (std::size_t r = 0; r < survey.runs.size(); ++r) {
    for_each_block(survey.runs[r], block_count, [&](Index b) {
      runs[static_cast<std::size_t>(end[static_cast<std::size_t>(b)]++)] = static_cast<Index>(r);
    });
  }
  return {first, runs};
}

}  // namespace hedgerow::detail
