#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace hedgerow::tool {

/// A progress bar on standard error, drawn once the work has taken half a second (or as many
/// milliseconds as the environment variable HEDGEROW_PROGRESS_DELAY says) and wiped at the end.
/// Steps are counted, not timed: the bar says how many of those announced are done.
///
/// Threads   Its own thread draws; the members are called from one thread.
class Progress {
 public:
  explicit Progress(bool enabled);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { finish(); }

  /// Announces `step_count` steps and starts the clock.
  void begin(int step_count);
  /// The previous step is done and the one called `label` begins.
  void step(std::string label);
  /// How far the step has come.
  void part(std::int64_t done, std::int64_t total);
  /// Wipes the bar. Anything may be printed afterwards.
  void finish();

 private:
  void draw_until_finished();
  void draw() const;
  [[nodiscard]] std::string line() const;

  bool enabled_;
  std::chrono::milliseconds delay_;
  bool finished_ = true;
  int step_count_ = 0;
  int steps_begun_ = 0;
  double part_ = 0;
  std::string label_;
  std::chrono::steady_clock::time_point start_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::thread thread_;
};

}  // namespace hedgerow::tool
