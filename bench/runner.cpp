#include "runner.h"

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

/// Seconds that all threads of this process have run.
double processor_time() noexcept {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

void measure(benchmark::State& state, const std::string& name, const Case& benchmark) try {
  const Dataset& data = dataset(benchmark.data);
  const Work& work = prepare(name, benchmark, data);
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
  const double bytes = benchmark.compulsory_bytes(data);
  state.SetItemsProcessed(static_cast<std::int64_t>(iterations * counts.halfedges));
  state.SetBytesProcessed(static_cast<std::int64_t>(iterations * bytes));
  state.counters["halfedges"] = counts.halfedges;
  state.counters["vertices"] = counts.vertices;
  state.counters["faces"] = counts.faces;
  state.counters["mesh_bytes"] = static_cast<double>(data.mesh.bytes());
  state.counters["bytes"] = bytes;
  // Far below the time that passed (times the threads): others had the processors meanwhile.
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
      // Inputs, not results: for the tables, not for the terminal.
      if constexpr (std::is_same_v<Base, benchmark::ConsoleReporter>) {
        for (const char* input :
             {"bytes", "faces", "halfedges", "mesh_bytes", "processor_ns", "vertices"}) {
          run.counters.erase(input);
        }
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

void add(const Plan& plan, Case benchmark) {
  std::string name = benchmark.operation + "/" + benchmark.data.shape + "/" +
                     benchmark.data.size() + "/" + std::to_string(benchmark.threads);
  if (!benchmark.variant.empty()) name += "/" + benchmark.variant;
  auto* registered = benchmark::RegisterBenchmark(
      name.c_str(), [name, benchmark = std::move(benchmark)](benchmark::State& state) {
        measure(state, name, benchmark);
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
