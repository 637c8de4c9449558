#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <thread>

#include "hedgerow/execution.h"

namespace hedgerow {

/// Threads without TBB. That is not built for the thread sanitizer, which then reports races inside
/// it; through the callback of an `Execution` it is not called at all, so whatever the sanitizer
/// reports here is ours.
inline constexpr int kThreads = 4;

// Thread t takes ranges t, t + kThreads, ...: neighbours always run on different threads.
inline void run_on_threads(void*, Index count, Index grain, void (*body)(void*, Index, Index),
                           void* user) {
  std::array<std::thread, kThreads> threads;
  for (Index t = 0; t < kThreads; ++t) {
    threads[static_cast<std::size_t>(t)] = std::thread([=] {
      for (Index begin = t * grain; begin < count; begin += kThreads * grain) {
        body(user, begin, std::min(begin + grain, count));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

inline Execution plain_threads() { return Execution::callback(&run_on_threads, nullptr, kThreads); }

}  // namespace hedgerow
