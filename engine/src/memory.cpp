#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <string_view>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "hedgerow/buffer.h"
#include "hedgerow/workspace.h"

namespace hedgerow {

namespace detail {

namespace {
constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kHugePage = std::size_t{1} << 21;

// Read once: who sets it wants all columns alike.
bool wants_huge_pages() noexcept {
  static const bool wanted = [] {
    const char* setting = std::getenv("HEDGEROW_HUGE_PAGES");
    return setting == nullptr || std::string_view(setting) != "off";
  }();
  return wanted;
}
}  // namespace

// A fresh 100 MB column is 25,000 page faults in 4 KB pages and 50 in 2 MB ones; PERF.md, "memory".
void* allocate_bytes(std::size_t bytes) {
  if (bytes == 0) return nullptr;
  if (bytes > static_cast<std::size_t>(PTRDIFF_MAX) - 2 * kHugePage) throw std::bad_alloc();
  const bool is_huge = bytes >= 2 * kHugePage && wants_huge_pages();
  const std::size_t alignment = is_huge ? kHugePage : kCacheLine;
  const std::size_t size = (bytes + kReadableTailBytes + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, size);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  // Advice only: where huge pages are off, nothing changes but the time.
  if (is_huge) (void)madvise(memory, size, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_bytes(void* memory) noexcept { std::free(memory); }

void prefer_huge_pages(void* memory, std::size_t bytes) noexcept {
  if (bytes < 2 * kHugePage || !wants_huge_pages()) return;
  std::size_t size = bytes;
  if (std::align(kHugePage, kHugePage, memory, size) == nullptr) return;
#if defined(__linux__)
  (void)madvise(memory, size / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
}

}  // namespace detail

Workspace::Workspace(std::span<std::byte> memory) noexcept : is_fixed_(true) {
  void* start = memory.data();
  std::size_t space = memory.size();
  if (start != nullptr && std::align(detail::kCacheLine, 1, start, space) != nullptr) {
    fixed_ = {static_cast<std::byte*>(start), space};
  }
}

bool Workspace::reserve(std::size_t bytes) {
  if (bytes <= size_bytes()) return true;
  if (is_fixed_) return false;
  owned_ = Buffer<std::byte>();
  owned_ = Buffer<std::byte>(bytes);
  return true;
}

std::byte* Workspace::data() noexcept { return is_fixed_ ? fixed_.data() : owned_.data(); }

std::size_t Workspace::size_bytes() const noexcept {
  return is_fixed_ ? fixed_.size() : owned_.size();
}

}  // namespace hedgerow
