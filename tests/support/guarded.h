#pragma once

#include <cstddef>
#include <cstring>
#include <sys/mman.h>
#include <unistd.h>

namespace hedgerow::test {

/// Memory between two pages that may not be touched. `at_end`: the bytes end where the page behind
/// starts; else they start where the page before ends.
class Guarded {
 public:
  Guarded(std::size_t bytes, bool at_end) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t inner = (bytes + page - 1) / page * page + page;
    size_ = inner + 2 * page;
    base_ = static_cast<std::byte*>(
        mmap(nullptr, size_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    const int status = mprotect(base_ + page, inner, PROT_READ | PROT_WRITE);
    is_ready_ = base_ != MAP_FAILED && status == 0;
    data_ = at_end ? base_ + page + inner - bytes : base_ + page;
  }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;
  ~Guarded() { munmap(base_, size_); }

  [[nodiscard]] bool is_ready() const { return is_ready_; }
  [[nodiscard]] float* floats() const { return reinterpret_cast<float*>(data_); }

 private:
  std::byte* base_ = nullptr;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  bool is_ready_ = false;
};

}  // namespace hedgerow::test
