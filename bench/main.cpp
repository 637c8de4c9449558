#include <cstdint>
#include <exception>
#include <iostream>
#include <regex>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "counting.h"
#include "google.h"
#include "plan.h"
#include "rounds.h"
#include "runner.h"

namespace {

using hedgerow::bench::GoogleOptions;
using hedgerow::bench::Plan;
using hedgerow::bench::PlanOptions;
using hedgerow::bench::RoundsOptions;

constexpr std::int64_t kMaxIterations = 1'000'000'000;

struct Options {
  PlanOptions plan;
  RoundsOptions rounds;
  GoogleOptions google;
  std::string counted;  // regular expression
};

void describe(CLI::App& app, Options& options) {
  app.footer(
      "Without --out, Google Benchmark runs one after the other, for a look, and takes its own\n"
      "options (--benchmark_filter=REGEX and others). Names are operation/dataset/size/threads,\n"
      "with /variant behind it for a baseline, a peer library or another way; then, but not with\n"
      "--out and --count, the class of the working set: /L1, /L2, /LLC or /DRAM. An item is a\n"
      "half-edge. Each answer is checked before it is timed; one that is wrong gives status 1.\n"
      "Example: hedgerow_bench --benchmark_filter='^build/grid/4M'");
  app.add_option("--out", options.rounds.out,
                 "Measure in rounds, for the record, and write every time as JSON");
  app.add_option("--rounds", options.rounds.rounds,
                 "How often each benchmark is measured; those below 2 ms five times that")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--budget", options.rounds.budget_seconds,
                 "After so many seconds a slow one is measured no more than twice")
      ->capture_default_str();
  app.add_option("--filter", options.rounds.filter, "Only what has such a name, in rounds");
  app.add_option("--count", options.counted,
                 "Run what has such a name once, on one thread, for bench/count.py");
  app.add_option("--fixed-iterations", options.google.iterations,
                 "Exactly so many of each benchmark; answers are not compared with the reference, "
                 "but their digests are printed, for whoever compares two builds")
      ->check(CLI::Range(std::int64_t{1}, kMaxIterations));
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
  app.add_flag("--imr", options.plan.is_imr,
               "The six tests of the IMR 2011 suite, and nothing else");
  app.add_flag("--smoke", options.plan.is_smoke, "Every benchmark once, on tiny meshes");
  app.allow_extras();
}

void add_all(const Plan& plan) {
  add_bandwidth(plan);
  add_buffer(plan);
  add_build(plan);
  add_boundary(plan);
  add_normals(plan);
  add_dirty(plan);
  add_circulate(plan);
  add_query(plan);
  add_validate(plan);
  add_reorder(plan);
  add_planar(plan);
  add_decimate(plan);
  add_subdivide(plan);
  add_representations(plan);
  add_imr(plan);
}

/// Returns the number of wrong answers.
int run_chosen(const char* program, const Options& options) {
  const bool is_google = options.counted.empty() && options.rounds.out.empty();
  if (is_google) return hedgerow::bench::run_google(program, options.google);
  if (!options.google.others.empty()) {
    throw hedgerow::bench::UsageError(options.google.others.front() +
                                      ": not known, or not beside --out and --count");
  }
  return options.counted.empty() ? hedgerow::bench::run_rounds(options.rounds)
                                 : hedgerow::bench::count_cases(options.counted);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times the engine, and other mesh libraries beside it.", "hedgerow_bench");
  Options options;
  describe(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  options.google.others = app.remaining();
  options.google.is_checked = options.google.iterations == 0;
  options.plan.is_recorded = !options.rounds.out.empty();
  options.plan.is_counted = !options.counted.empty();
  options.rounds.is_smoke = options.plan.is_smoke;
  if (options.plan.is_smoke) {
    options.plan.meshes.clear();
    if (options.google.is_checked) options.google.iterations = 1;
  }
  try {
    add_all(hedgerow::bench::make_plan(options.plan));
    return run_chosen(argv[0], options) == 0 ? 0 : 1;
  } catch (const hedgerow::bench::UsageError& error) {
    std::cerr << "hedgerow_bench: " << error.what() << "\n";
    return 2;
  } catch (const std::regex_error& error) {
    std::cerr << "hedgerow_bench: the filter: " << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "hedgerow_bench: " << error.what() << "\n";
    return 3;
  }
}
