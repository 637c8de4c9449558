#pragma once

#include <cstdint>
#include <functional>

namespace hedgerow::bench {

/// What one run asks of the memory.
struct MemoryUse {
  std::int64_t allocations = 0;  ///< by operator new, and by aligned_alloc, which buffers use
  std::int64_t allocated_bytes = 0;
  std::int64_t peak_bytes = 0;  ///< largest resident size of the process meanwhile; 0: not known
};

/// Runs `run`. Only allocations meanwhile are counted: those of a measured run pay one branch.
/// Threads    All are counted, so no other work may run beside it.
[[nodiscard]] MemoryUse memory_use_of(const std::function<void()>& run);

/// Allocations since the last call of `memory_use_of` began: for the parts of a run.
[[nodiscard]] std::int64_t allocations_so_far() noexcept;

}  // namespace hedgerow::bench
