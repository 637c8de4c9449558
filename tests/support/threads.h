#pragma once

#include <array>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "hedgerow/execution.h"

namespace hedgerow::test {

/// The thread counts under which results must not change.
inline constexpr std::array kThreadCounts = {1, 2, 3, 8, 16};

/// An arena of so many threads. TBB caps its workers at the number of cores unless it is told
/// otherwise, so this tells it for as long as the object lives.
class Threads {
 public:
  explicit Threads(int count)
      : limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count)),
        arena_(count) {}

  [[nodiscard]] Execution execution(Index grain = 0) {
    return Execution::in(arena_).with_grain(grain);
  }

 private:
  tbb::global_control limit_;
  tbb::task_arena arena_;
};

}  // namespace hedgerow::test
