#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>

#include "counting.h"
#include "machine.h"
#include "plan.h"
#include "rounds.h"
#include "runner.h"

namespace {

using hedgerow::bench::Plan;
using hedgerow::bench::PlanOptions;
using hedgerow::bench::RoundsOptions;

struct Options {
  PlanOptions plan;
  RoundsOptions rounds;
  std::string counted;  // regular expression
  std::vector<std::string> others;
};

void describe(CLI::App& app, Options& options) {
  app.footer(
      "Without --out, Google Benchmark runs one after the other, for a look, and takes its own\n"
      "options (--benchmark_filter=REGEX and others). Names are operation/dataset/size/threads,\n"
      "with /variant behind it for a baseline, a peer library or another way. An item is a\n"
      "half-edge. Each answer is checked before it is timed; one that is wrong gives status 1.\n"
      "Example: hedgerow_bench --benchmark_filter='^build/grid/4M'");
  app.add_option("--out", options.rounds.out,
                 "Measure in rounds, for the record, and write every time as JSON");
  app.add_option("--rounds", options.rounds.rounds, "How often each benchmark is measured")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--budget", options.rounds.budget_seconds,
                 "After so many seconds a slow one is measured no more than twice")
      ->capture_default_str();
  app.add_option("--filter", options.rounds.filter, "Only what has such a name, in rounds");
  app.add_option("--count", options.counted,
                 "Run what has such a name once, on one thread, for bench/count.py");
  app.add_option("--mesh", options.plan.meshes,
                 "Measure on this file, too; from the second on, only how the builder chooses")
      ->envname("HEDGEROW_MESH")
      ->type_name("FILE");
  app.add_option("--threads", options.plan.threads, "Numbers of threads (default: 1 and all)")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  app.add_option("--largest", options.plan.largest,
                 "Triangles of the largest meshes (default: by cache and memory)");
  app.add_flag("--representations", options.plan.is_represented,
               "Ask every representation the same questions, and nothing else");
  app.add_flag("--smoke", options.plan.is_smoke, "Every benchmark once, on tiny meshes");
  app.allow_extras();
}

void add_all(const Plan& plan) {
  add_bandwidth(plan);
  add_buffer(plan);
  add_build(plan);
  add_boundary(plan);
  add_normals(plan);
  add_circulate(plan);
  add_query(plan);
  add_validate(plan);
  add_reorder(plan);
  add_representations(plan);
}

/// Hands what is left of the command line to Google Benchmark; false if that does not know it.
bool initialise_benchmark(const char* program, const std::vector<std::string>& others) {
  std::vector<std::string> texts{program};
  texts.insert(texts.end(), others.begin(), others.end());
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  auto count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  return !benchmark::ReportUnrecognizedArguments(count, arguments.data());
}

int run_chosen(const Options& options) {
  if (!options.counted.empty()) return hedgerow::bench::count_cases(options.counted);
  if (!options.rounds.out.empty()) return hedgerow::bench::run_rounds(options.rounds);
  for (const auto& [key, value] : hedgerow::bench::machine_context()) {
    benchmark::AddCustomContext(key, value);
  }
  bool has_output_file = false;
  for (const std::string& text : options.others) {
    has_output_file |= text.starts_with("--benchmark_out=");
  }
  return hedgerow::bench::run_all(has_output_file);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times the engine, and other mesh libraries beside it.", "hedgerow_bench");
  Options options;
  describe(app, options);
  CLI11_PARSE(app, argc, argv);
  options.others = app.remaining();
  options.rounds.is_smoke = options.plan.is_smoke;
  if (options.plan.is_smoke) options.plan.meshes.clear();
  if (!initialise_benchmark(argv[0], options.others)) return 2;
  try {
    add_all(hedgerow::bench::make_plan(options.plan));
    const int error_count = run_chosen(options);
    benchmark::Shutdown();
    return error_count == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "hedgerow_bench: " << error.what() << "\n";
    return 3;
  }
}
