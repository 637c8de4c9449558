#include "runner.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <stdexcept>
#include <time.h>
#include <type_traits>
#include <unistd.h>
#include <utility>

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

namespace hedgerow::bench {

namespace {

using Clock = std::chrono::steady_clock;

/// The prepared work of the benchmark that ran last: the framework calls a benchmark several times,
/// to find the number of iterations and for each repetition, and checking takes longer than timing.
struct Prepared {
  std::string name;
  Work work;
};
Prepared& last_prepared() {
  static Prepared prepared;
  return prepared;
}

const Work& prepare(const std::string& name, const Case& benchmark, const Dataset& data) {
  Prepared& last = last_prepared();
  if (last.name != name) {
    last = {};  // frees the previous meshes before new ones are made
    last = {name, benchmark.prepare(data, execution_with(benchmark.threads))};
  }
  return last.work;
}

std::vector<Case>& mutable_cases() {
  static std::vector<Case> cases;
  return cases;
}

void measure(benchmark::State& state, const std::string& case_name, const Case& benchmark) try {
  const Dataset& data = dataset(benchmark.data);
  const Work& work = prepare(case_name, benchmark, data);
  if (!work.error.empty()) {
    state.SkipWithError(work.error.c_str());
    return;
  }
  double processor_seconds = 0;
  for (auto _ : state) {
    const double processor_start = processor_time();
    const Clock::time_point start = Clock::now();
    work.run();
    const std::chrono::duration<double> elapsed = Clock::now() - start;
    processor_seconds += processor_time() - processor_start;
    state.SetIterationTime(elapsed.count());
    if (work.cleanup) work.cleanup();
  }
  const auto iterations = static_cast<double>(state.iterations());
  const Counts counts = counts_of(data);
  const double bytes = benchmark.traffic(data).total();
  state.SetItemsProcessed(static_cast<std::int64_t>(iterations * counts.halfedges));
  state.SetBytesProcessed(static_cast<std::int64_t>(iterations * bytes));
  state.counters["processor_ns"] = processor_seconds / iterations * 1e9;
} catch (const std::runtime_error& error) {
  state.SkipWithError(error.what());
}

/// Names as they were registered, without what the framework appends to them, and the number of
/// benchmarks that failed.
template <class Base>
class PlainNames final : public Base {
 public:
  using Base::Base;
  using Run = benchmark::BenchmarkReporter::Run;

  void ReportRuns(const std::vector<Run>& reports) override {
    std::vector<Run> plain = reports;
    for (Run& run : plain) {
      const std::string name = run.run_name.function_name;
      run.run_name = {};
      run.run_name.function_name = name;
      if (run.error_occurred) ++error_count_;
      if constexpr (std::is_same_v<Base, benchmark::ConsoleReporter>) {
        run.counters.erase("bytes");
        run.counters.erase("processor_ns");
      }
    }
    Base::ReportRuns(plain);
  }
  [[nodiscard]] int error_count() const noexcept { return error_count_; }

 private:
  int error_count_ = 0;
};

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

std::string Case::group() const {
  return (family.empty() ? operation : family) + "/" + data.family() + "/" + data.size();
}

bool Plan::has_peers(const DatasetKey& key) const {
  return std::ranges::find(with_peers, key) != with_peers.end();
}

const std::vector<Case>& all_cases() { return mutable_cases(); }

void add(const Plan& plan, Case benchmark) {
  const std::string case_name = benchmark.name();
  mutable_cases().push_back(benchmark);
  auto* registered = benchmark::RegisterBenchmark(
      case_name.c_str(), [case_name, benchmark = std::move(benchmark)](benchmark::State& state) {
        measure(state, case_name, benchmark);
      });
  registered->UseManualTime()->Unit(benchmark::kMillisecond);
  if (plan.is_smoke) registered->Iterations(1);
}

int run_all(bool has_output_file) {
  using Console = benchmark::ConsoleReporter;
  const bool is_terminal = isatty(STDOUT_FILENO) == 1;
  PlainNames<Console> console(is_terminal ? Console::OO_ColorTabular : Console::OO_Tabular);
  PlainNames<benchmark::JSONReporter> file;
  // The framework wants a file reporter exactly when the user named a file.
  if (has_output_file) {
    benchmark::RunSpecifiedBenchmarks(&console, &file);
  } else {
    benchmark::RunSpecifiedBenchmarks(&console);
  }
  last_prepared() = {};
  return console.error_count();
}

}  // namespace hedgerow::bench
