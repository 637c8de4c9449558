#pragma once

namespace hedgerow::test {

/// How often this program has allocated so far: by operator new, or by aligned_alloc, which the
/// engine's buffers use. Every thread counts.
[[nodiscard]] int allocation_count() noexcept;

/// As long as it lives, an allocation fails after so many that do not.
class FailingAllocation {
 public:
  explicit FailingAllocation(int after) noexcept;
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;
  ~FailingAllocation();
};

}  // namespace hedgerow::test
