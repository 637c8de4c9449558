#pragma once

#include <string>

namespace hedgerow::bench {

/// How to measure for the record.
struct RoundsOptions {
  std::string out;            ///< JSON file to write
  std::string filter;         ///< regular expression that a name must match somewhere; empty: all
  int rounds = 5;             ///< times that each benchmark is measured; five times that below 2 ms
  double budget_seconds = 2;  ///< after so long a slow benchmark is measured no more than twice
  bool is_smoke = false;      ///< tiny bandwidth arrays
};

/// Measures the registered cases in rounds: all cases of a group once, then all of them once more,
/// each for at least two milliseconds a time, and between them the bandwidth kernels with the same
/// mix of reads and writes on as many bytes and threads. So neighbours in a table have seen the
/// same moments of the machine. Writes every single time to `options.out`; progress goes to
/// standard error.
///
/// Returns the number of cases that gave a wrong answer. Throws std::runtime_error if the file
/// cannot be written.
[[nodiscard]] int run_rounds(const RoundsOptions& options);

}  // namespace hedgerow::bench
