#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace hedgerow::bench {

/// One number of a run of the frame program.
struct Row {
  std::string stage;    ///< "S0" to "S6"
  std::string what;     ///< what is measured
  std::string variant;  ///< by whom or how
  double value = 0;
  std::string unit;
  std::string note;  ///< counts and rates that belong to it
};

/// Collects rows and wrong answers; prints as it goes, so that a long run shows where it is.
class Rows {
 public:
  void add(Row row);
  /// Records that an answer is wrong: the program then ends with status 1.
  void fail(const std::string& what);

  [[nodiscard]] const std::vector<Row>& rows() const noexcept { return rows_; }
  [[nodiscard]] const std::vector<std::string>& failed() const noexcept { return failed_; }
  /// Machine, mesh and rows as JSON. Throws std::runtime_error if it cannot be written.
  void write(const std::string& path,
             const std::vector<std::pair<std::string, std::string>>& context) const;

 private:
  std::vector<Row> rows_;
  std::vector<std::string> failed_;
};

[[nodiscard]] inline double now_ms() {
  return std::chrono::duration<double, std::milli>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Milliseconds of the fastest of some runs after one that does not count.
template <class Work>
[[nodiscard]] double best_ms(int runs, Work&& work) {
  work();
  double best = 1e300;
  for (int i = 0; i < runs; ++i) {
    const double start = now_ms();
    work();
    const double ms = now_ms() - start;
    if (ms < best) best = ms;
  }
  return best;
}

/// The value that this share of `values` does not exceed. \pre values is not empty
[[nodiscard]] double percentile(std::vector<double> values, double share);

}  // namespace hedgerow::bench
