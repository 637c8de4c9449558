#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "hedgerow/execution.h"

namespace hedgerow::bench {

/// Calls `body(begin, end)` for ranges that partition [0, count): one range on one thread, else
/// ranges of about `grain` on the threads of `execution`, as a caller of the engine would.
template <class Size, class Body>
void for_ranges(const Execution& execution, Size count, std::size_t grain, const Body& body) {
  if (execution.threads() == 1) {
    body(Size{0}, count);
    return;
  }
  auto loop = [&] {
    tbb::parallel_for(tbb::blocked_range<Size>(0, count, grain),
                      [&](const auto& range) { body(range.begin(), range.end()); });
  };
  execution.enter()(
      execution.context(), [](void* user) { (*static_cast<decltype(loop)*>(user))(); }, &loop);
}

}  // namespace hedgerow::bench
