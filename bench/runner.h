#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dataset.h"
#include "hedgerow/execution.h"

namespace hedgerow::bench {

/// The work of one benchmark, ready to be timed.
struct Work {
  std::function<void()> run;      ///< timed
  std::function<void()> cleanup;  ///< not timed, after each run; may be empty
  std::string error;              ///< why it must not be timed: the answer is wrong; else empty
};

/// One benchmark, named `operation/dataset/size/threads`, with `/variant` behind it if it is not
/// the engine that is measured.
struct Case {
  std::string operation;
  DatasetKey data;
  int threads = 1;
  std::string variant;
  /// Sets the work up, runs it once and compares the answer with the reference.
  std::function<Work(const Dataset&, const Execution&)> prepare;
  /// Bytes that any implementation of the operation has to move, for GB/s.
  std::function<double(const Dataset&)> compulsory_bytes;
};

/// What to register: from the command line.
struct Plan {
  std::vector<DatasetKey> all;    ///< every dataset
  std::vector<DatasetKey> large;  ///< those that do not fit a cache: peers and slow operations
  std::vector<int> threads;       ///< 1, 2, 4 .. the number of processors
  bool is_smoke = false;          ///< tiny meshes, one iteration each
};

/// Registers one benchmark. An item is a half-edge, always.
void add(const Plan& plan, Case benchmark);

/// An arena of `threads` threads, kept for the whole run; serial for 1.
[[nodiscard]] Execution execution_with(int threads);

// One for each source file of benchmarks.
void add_bandwidth(const Plan& plan);
void add_boundary(const Plan& plan);
void add_buffer(const Plan& plan);
void add_build(const Plan& plan);
void add_circulate(const Plan& plan);
void add_normals(const Plan& plan);
void add_query(const Plan& plan);
void add_reorder(const Plan& plan);
void add_validate(const Plan& plan);

/// Runs what was registered and passed the filter; returns the number that reported an error.
/// \pre `has_output_file` says whether --benchmark_out was given.
[[nodiscard]] int run_all(bool has_output_file);

/// Bytes of one index, as a factor for `compulsory_bytes`.
inline constexpr double kIndexBytes = sizeof(Index);
inline constexpr double kPointBytes = 3 * sizeof(float);

}  // namespace hedgerow::bench
