// The linker sends calls of aligned_alloc to the first function below (see CMakeLists.txt), and the
// operators stand in for the library's.
#include "support/allocations.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {
std::atomic<int> count = 0;
std::atomic<int> failing_count = -1;
}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void* __real_aligned_alloc(std::size_t alignment, std::size_t bytes);
extern "C" void* __wrap_aligned_alloc(std::size_t alignment, std::size_t bytes) {
  if (count++ == failing_count) return nullptr;
  return __real_aligned_alloc(alignment, bytes);
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* operator new(std::size_t bytes) {
  if (count++ == failing_count) throw std::bad_alloc();
  void* memory = std::malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  ++count;
  return std::malloc(bytes == 0 ? 1 : bytes);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace hedgerow::test {

int allocation_count() noexcept { return count; }

FailingAllocation::FailingAllocation(int after) noexcept { failing_count = count + after; }
FailingAllocation::~FailingAllocation() { failing_count = -1; }

}  // namespace hedgerow::test
