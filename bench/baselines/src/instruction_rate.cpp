#include "baselines/instruction_rate.h"

#include <algorithm>
#include <chrono>

namespace hedgerow::baselines {

double instructions_per_ns() noexcept {
#if defined(__x86_64__)
  constexpr int kPasses = 20;
  constexpr int kIterations = 100'000;
  constexpr int kInstructions = 18;  // an iteration: sixteen additions, and the loop's two
  double best = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    const auto start = std::chrono::steady_clock::now();
    // In assembly, since a compiler would add up the additions.
    for (int i = 0; i < kIterations; ++i) {
      asm volatile(
          "add $1, %%rax\n add $1, %%rcx\n add $1, %%rdx\n add $1, %%rsi\n"
          "add $1, %%rdi\n add $1, %%r8\n  add $1, %%r9\n  add $1, %%r10\n"
          "add $1, %%rax\n add $1, %%rcx\n add $1, %%rdx\n add $1, %%rsi\n"
          "add $1, %%rdi\n add $1, %%r8\n  add $1, %%r9\n  add $1, %%r10\n"
          :
          :
          : "rax", "rcx", "rdx", "rsi", "rdi", "r8", "r9", "r10", "cc");
    }
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    best = std::max(best, double{kInstructions} * kIterations / time.count());
  }
  return best;
#else
  return 0;
#endif
}

}  // namespace hedgerow::baselines
