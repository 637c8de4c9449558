#include "google.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <regex>
#include <string_view>
#include <type_traits>
#include <unistd.h>
#include <utility>

#include <benchmark/benchmark.h>

#include "injection.h"
#include "machine.h"
#include "memory_use.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

using Clock = std::chrono::steady_clock;

struct Extra {
  std::string name;
  std::function<void(benchmark::State&)> function;
};
std::vector<Extra>& extras() {
  static std::vector<Extra> all;
  return all;
}

/// The prepared work of the benchmark that ran last: the framework calls a benchmark several times,
/// to find the number of iterations and for each repetition, and checking takes longer than timing.
struct Prepared {
  std::string name;
  Work work;
  Answer answer;
  MemoryUse memory;
};
Prepared& last_prepared() {
  static Prepared prepared;
  return prepared;
}

const Prepared& prepare(const Case& benchmark, bool is_checked) {
  Prepared& last = last_prepared();
  const std::string name = benchmark.name_with_class();
  if (last.name == name) return last;
  last = {};  // frees the previous meshes before new ones are made
  last.name = name;
  last.work = benchmark.prepare(dataset(benchmark.data), execution_with(benchmark.threads));
  last.answer = first_answer(last.work, is_checked);
  if (!last.answer.error.empty()) return last;
  if (last.work.setup) last.work.setup();
  last.memory = memory_use_of(last.work.run);
  if (last.work.cleanup) last.work.cleanup();
  return last;
}

void set_counters(benchmark::State& state, const Case& benchmark, const Prepared& prepared) {
  constexpr std::uint64_t kLowHalf = 0xFFFF'FFFF;
  const std::uint64_t digest = prepared.answer.digest;
  state.counters["digest_hi"] = static_cast<double>(digest >> 32U);
  state.counters["digest_lo"] = static_cast<double>(digest & kLowHalf);
  if (benchmark.threads == 1) {
    state.counters["allocs"] = static_cast<double>(prepared.memory.allocations);
    state.counters["alloc_bytes"] = static_cast<double>(prepared.memory.allocated_bytes);
  }
  if (prepared.memory.peak_bytes > 0) {
    state.counters["peak_bytes"] = static_cast<double>(prepared.memory.peak_bytes);
  }
  for (const auto& [key, value] : prepared.answer.notes) state.counters[key] = value;
}

void measure(benchmark::State& state, const Case& benchmark, bool is_checked) try {
  const Prepared& prepared = prepare(benchmark, is_checked);
  if (!prepared.answer.error.empty()) {
    state.SkipWithError(prepared.answer.error.c_str());
    return;
  }
  const Work& work = prepared.work;
  double processor_seconds = 0;
  double injected_seconds = 0;
  for (auto _ : state) {
    if (work.setup) work.setup();
    const double processor_start = processor_time();
    const Clock::time_point start = Clock::now();
    work.run();
    injected_seconds += inject_delay(prepared.name, start);
    const std::chrono::duration<double> elapsed = Clock::now() - start;
    processor_seconds += processor_time() - processor_start;
    state.SetIterationTime(elapsed.count());
    if (work.cleanup) work.cleanup();
  }
  const auto iterations = static_cast<double>(state.iterations());
  const Dataset& data = dataset(benchmark.data);
  state.SetItemsProcessed(static_cast<std::int64_t>(iterations * counts_of(data).halfedges));
  state.SetBytesProcessed(static_cast<std::int64_t>(iterations * benchmark.traffic(data).total()));
  state.counters["processor_ns"] = processor_seconds / iterations * 1e9;
  if (injected_seconds > 0) state.counters["injected_ns"] = injected_seconds / iterations * 1e9;
  set_counters(state, benchmark, prepared);
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
      // A line of the terminal has room for the two rates.
      if constexpr (std::is_same_v<Base, benchmark::ConsoleReporter>) {
        std::erase_if(run.counters, [](const auto& counter) {
          return counter.first != "items_per_second" && counter.first != "bytes_per_second";
        });
      }
    }
    Base::ReportRuns(plain);
  }
  [[nodiscard]] int error_count() const noexcept { return error_count_; }

 private:
  int error_count_ = 0;
};

/// Those of Google Benchmark's options that are answered here, because its own answers know
/// benchmarks by longer names than their rows bear.
struct Answered {
  std::string filter;
  bool is_list = false;
  bool is_json = false;
  bool has_output_file = false;
};

/// The value of `--key=value`.
std::optional<std::string> value_of(std::string_view text, std::string_view key) {
  if (!text.starts_with(key) || text.substr(key.size(), 1) != "=") return std::nullopt;
  return std::string(text.substr(key.size() + 1));
}

Answered take_answered(std::vector<std::string>& others) {
  Answered answered;
  std::vector<std::string> left;
  for (const std::string& text : others) {
    if (const auto filter = value_of(text, "--benchmark_filter")) {
      answered.filter = *filter;
    } else if (const auto format = value_of(text, "--benchmark_format")) {
      if (*format != "json" && *format != "console") {
        throw UsageError(text + ": json and console are the formats");
      }
      answered.is_json = *format == "json";
    } else if (text.starts_with("--benchmark_list_tests")) {
      answered.is_list = !text.ends_with("=false");
    } else {
      answered.has_output_file |= text.starts_with("--benchmark_out=");
      left.push_back(text);
    }
  }
  others = std::move(left);
  return answered;
}

/// Whether a name passes the filter: as Google Benchmark has it, "-" in front means all others.
class Filter {
 public:
  explicit Filter(const std::string& text) try
      : is_negative_(text.starts_with('-')),
        pattern_(text == "all" ? "" : text.substr(is_negative_ ? 1 : 0)) {
  } catch (const std::regex_error& error) {
    throw UsageError("--benchmark_filter=" + text + ": " + error.what());
  }
  [[nodiscard]] bool passes(const std::string& name) const {
    return std::regex_search(name, pattern_) != is_negative_;
  }

 private:
  bool is_negative_;
  std::regex pattern_;
};

void add_to_framework(const std::string& name, std::function<void(benchmark::State&)> function,
                      const GoogleOptions& options) {
  auto* registered = benchmark::RegisterBenchmark(name.c_str(), std::move(function));
  registered->UseManualTime()->Unit(benchmark::kMillisecond);
  if (options.iterations > 0) registered->Iterations(options.iterations);
}

/// Registers what passes the filter, or prints the names. Returns how many passed.
int choose(const Answered& answered, const GoogleOptions& options) {
  const Filter filter(answered.filter);
  int count = 0;
  const auto is_chosen = [&](const std::string& name) {
    if (!filter.passes(name)) return false;
    ++count;
    if (answered.is_list) std::cout << name << "\n";
    return !answered.is_list;
  };
  for (const Extra& extra : extras()) {
    if (is_chosen(extra.name)) add_to_framework(extra.name, extra.function, options);
  }
  for (const Case& benchmark : all_cases()) {
    const std::string name = benchmark.name_with_class();
    if (!is_chosen(name)) continue;
    const bool is_checked = options.is_checked;
    add_to_framework(
        name,
        [&benchmark, is_checked](benchmark::State& state) {
          measure(state, benchmark, is_checked);
        },
        options);
  }
  return count;
}

void initialise_framework(const char* program, const std::vector<std::string>& others) {
  // The framework keeps the address of the first.
  static std::vector<std::string> texts;
  texts = {program};
  texts.insert(texts.end(), others.begin(), others.end());
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  auto count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (count > 1) throw UsageError(std::string(arguments[1]) + ": no such option");
  for (const auto& [key, value] : machine_context()) benchmark::AddCustomContext(key, value);
}

template <class Display>
int run_chosen(Display& display, bool has_output_file) {
  PlainNames<benchmark::JSONReporter> file;
  // The framework wants a file reporter exactly when the user named a file.
  benchmark::RunSpecifiedBenchmarks(&display, has_output_file ? &file : nullptr);
  last_prepared() = {};
  benchmark::Shutdown();
  return display.error_count();
}

}  // namespace

void add_extra(std::string name, std::function<void(benchmark::State&)> function) {
  extras().push_back({std::move(name), std::move(function)});
}

int run_google(const char* program, const GoogleOptions& options) {
  std::vector<std::string> others = options.others;
  const Answered answered = take_answered(others);
  initialise_framework(program, others);
  const int count = choose(answered, options);
  if (answered.is_list) return 0;
  if (count == 0) throw UsageError("no benchmark passes --benchmark_filter=" + answered.filter);
  if (answered.is_json) {
    PlainNames<benchmark::JSONReporter> json;
    return run_chosen(json, answered.has_output_file);
  }
  using Console = benchmark::ConsoleReporter;
  const bool is_terminal = isatty(STDOUT_FILENO) == 1;
  PlainNames<Console> console(is_terminal ? Console::OO_ColorTabular : Console::OO_Tabular);
  return run_chosen(console, answered.has_output_file);
}

}  // namespace hedgerow::bench
