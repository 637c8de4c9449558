#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace benchmark {
class State;
}

namespace hedgerow::bench {

/// How to run with Google Benchmark, one after the other: for a look, or for a program that
/// compares two builds.
struct GoogleOptions {
  std::int64_t iterations = 0;  ///< exactly, of each benchmark; 0: as Google Benchmark thinks fit
  /// Whether answers are compared with the reference first, which takes longer than most
  /// measurements; who compares two builds compares their digests.
  bool is_checked = true;
  /// What is left of the command line, in Google Benchmark's own words.
  std::vector<std::string> others;
};

/// Something that only Google Benchmark runs: no operation on a mesh. `name` is the whole name.
void add_extra(std::string name, std::function<void(benchmark::State&)> function);

/// Runs, or lists, what was registered and passes --benchmark_filter, by the names that the rows
/// bear: those of `Case::name_with_class`. Beside time, items and bytes, a row of an operation has
/// the counters
///   digest_hi, digest_lo  two halves of a 64-bit hash of the answer, whole numbers
///   allocs, alloc_bytes   what one run allocates after one to warm up; serial rows only, since the
///                         scheduler decides for the others
///   peak_bytes            largest resident size of the process during that run
/// and what else the operation notes, as bytes_per_halfedge where it makes a mesh.
///
/// Returns the number of benchmarks that reported an error. Throws UsageError on an option that is
/// unknown, on a filter that is no regular expression and on one that nothing passes.
[[nodiscard]] int run_google(const char* program, const GoogleOptions& options);

/// The command line is wrong, and `what` says how.
class UsageError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace hedgerow::bench
