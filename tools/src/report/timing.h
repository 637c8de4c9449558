#pragma once

#include <algorithm>
#include <vector>

#include "clock.h"
#include "report/stage.h"

namespace hedgerow::tool {

inline constexpr int kMinRuns = 3;
inline constexpr int kMaxRuns = 15;
inline constexpr double kEnoughMs = 300;  ///< more than kMinRuns only until this much time is spent

struct Timing {
  double ms = 0;  ///< median
  int runs = 0;
};

/// Runs `work` several times and returns the median. \pre `work` has been run once, to check it.
template <class Work>
[[nodiscard]] Timing time_median(Work&& work) {
  std::vector<double> times;
  double total = 0;
  while (times.size() < kMinRuns || (total < kEnoughMs && times.size() < kMaxRuns)) {
    const Clock clock;
    work();
    times.push_back(clock.ms());
    total += times.back();
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return {*middle, static_cast<int>(times.size())};
}

}  // namespace hedgerow::tool
