#include "runner.h"

#include <algorithm>
#include <map>
#include <memory>
#include <time.h>
#include <utility>

#include <tbb/task_arena.h>

namespace hedgerow::bench {

namespace {

std::vector<Case>& mutable_cases() {
  static std::vector<Case> cases;
  return cases;
}

}  // namespace

Execution execution_with(int threads) {
  if (threads == 1) return Execution::serial();
  static std::map<int, std::unique_ptr<tbb::task_arena>> arenas;
  std::unique_ptr<tbb::task_arena>& arena = arenas[threads];
  if (!arena) arena = std::make_unique<tbb::task_arena>(threads);
  return Execution::in(*arena);
}

double processor_time() noexcept {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

const char* name(Mix mix) noexcept {
  return mix == Mix::read ? "read" : mix == Mix::copy ? "copy" : "triad";
}

std::string Case::name() const {
  std::string text =
      operation + "/" + data.shape + "/" + data.size() + "/" + std::to_string(threads);
  if (!variant.empty()) text += "/" + variant;
  return text;
}

std::string Case::name_with_class() const { return name() + "/" + data.working_set(); }

std::string Case::group() const {
  return (family.empty() ? operation : family) + "/" + data.family() + "/" + data.size();
}

bool Plan::has_peers(const DatasetKey& key) const {
  return std::ranges::find(with_peers, key) != with_peers.end();
}

const std::vector<Case>& all_cases() { return mutable_cases(); }

void add(Case benchmark) { mutable_cases().push_back(std::move(benchmark)); }

Answer first_answer(const Work& work, bool is_checked) {
  Answer answer{work.error, 0, {}};
  if (!answer.error.empty()) return answer;
  if (work.setup) work.setup();
  work.run();
  if (is_checked) answer.error = work.check();
  answer.digest = work.digest();
  if (work.notes) answer.notes = work.notes();
  if (work.cleanup) work.cleanup();
  return answer;
}

std::uint64_t digest_of(const Connectivity& mesh) { return digest(mesh, Execution::serial()); }

double bytes_per_halfedge(const Connectivity& mesh) {
  return static_cast<double>(mesh.bytes()) /
         static_cast<double>(std::max<Index>(1, mesh.halfedge_count()));
}

}  // namespace hedgerow::bench
