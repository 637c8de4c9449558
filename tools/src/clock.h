#pragma once

#include <chrono>

namespace hedgerow::tool {

/// Milliseconds since it was made, on a clock that never goes back.
class Clock {
 public:
  [[nodiscard]] double ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
        .count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace hedgerow::tool
