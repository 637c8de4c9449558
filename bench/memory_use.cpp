// The linker sends calls of aligned_alloc to the first function below (see CMakeLists.txt), and the
// operators stand in for the library's.
#include "memory_use.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>

namespace {

std::atomic<bool> is_counting = false;
std::atomic<std::int64_t> allocation_count = 0;
std::atomic<std::int64_t> byte_count = 0;

void note(std::size_t bytes) noexcept {
  if (!is_counting.load(std::memory_order_relaxed)) return;
  allocation_count.fetch_add(1, std::memory_order_relaxed);
  byte_count.fetch_add(static_cast<std::int64_t>(bytes), std::memory_order_relaxed);
}

void* allocate(std::size_t bytes) noexcept {
  note(bytes);
  return std::malloc(bytes == 0 ? 1 : bytes);
}

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void* __real_aligned_alloc(std::size_t alignment, std::size_t bytes);
extern "C" void* __wrap_aligned_alloc(std::size_t alignment, std::size_t bytes) {
  note(bytes);
  return __real_aligned_alloc(alignment, bytes);
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* operator new(std::size_t bytes) {
  void* memory = allocate(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  void* memory = std::aligned_alloc(step, (bytes + step - 1) / step * step);  // counts
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace hedgerow::bench {

namespace {

/// Lets the kernel measure the largest resident size anew.
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5\n"; }

/// "VmHWM:     1234 kB"
std::int64_t peak_resident_bytes() {
  std::ifstream status("/proc/self/status");
  std::string key;
  while (status >> key) {
    std::int64_t kilobytes = 0;
    if (key == "VmHWM:" && status >> kilobytes) return kilobytes * 1024;
    std::getline(status, key);
  }
  return 0;
}

}  // namespace

MemoryUse memory_use_of(const std::function<void()>& run) {
  forget_peak();
  allocation_count = 0;
  byte_count = 0;
  is_counting = true;
  run();
  is_counting = false;
  return {allocation_count, byte_count, peak_resident_bytes()};
}

std::int64_t allocations_so_far() noexcept { return allocation_count; }

}  // namespace hedgerow::bench
