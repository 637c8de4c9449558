#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#include <sys/utsname.h>
#endif

#include <gtest/gtest.h>

#include "hedgerow/buffer.h"

namespace hedgerow {
namespace {

// What the kernel says of the mapping that holds `address` in the line that begins with `key`; ""
// if nothing.
std::string said_of(const void* address, std::string_view key) {
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool is_inside = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0;
    std::uintptr_t end = 0;
    char dash = 0;
    if (words >> std::hex >> begin >> dash >> end && dash == '-') {
      is_inside = begin <= wanted && wanted < end;
    } else if (is_inside && line.starts_with(key)) {
      return line.substr(key.size()) + " ";
    }
  }
  return "";
}

bool is_off() {
  const char* setting = std::getenv("HEDGEROW_HUGE_PAGES");
  return setting != nullptr && std::string_view(setting) == "off";
}

long huge_kilobytes_at(const void* address) {
  return std::strtol(said_of(address, "AnonHugePages:").c_str(), nullptr, 10);
}

// Runs twice: as it is, and with the variable that turns huge pages off.
TEST(HugePages, AreAskedForUnlessTheEnvironmentSaysOff) {
  Buffer<std::byte> large(std::size_t{32} << 20U);
  // The middle of the allocation: its ends may share a mapping with something else.
  const std::string flags = said_of(large.data() + large.size() / 2, "VmFlags:");
  if (flags.empty()) GTEST_SKIP() << "the system lists no flags of mappings";
  EXPECT_EQ(flags.find(" hg ") != std::string::npos, !is_off()) << flags;
}

#if defined(__GLIBC__)
// Others have left small pages in the heap; a column there is to lie in huge ones all the same.
TEST(HugePages, ReplaceSmallOnesThatTheHeapHandsOutAgain) {
  if (is_off()) GTEST_SKIP() << "they are turned off";
  constexpr std::size_t kBytes = std::size_t{16} << 20U;
  Buffer<std::byte> fresh(kBytes, std::byte{1});
  if (huge_kilobytes_at(fresh.data() + kBytes / 2) == 0) {
    GTEST_SKIP() << "the system gives no huge pages";
  }
  // Large blocks come from the heap, too, and it keeps what is freed.
  if (mallopt(M_MMAP_THRESHOLD, 1 << 30) == 0 || mallopt(M_TRIM_THRESHOLD, 1 << 30) == 0) {
    GTEST_SKIP() << "another heap than that of the C library";
  }
  std::vector<char> used(4 * kBytes, 'x');
  const auto begin = reinterpret_cast<std::uintptr_t>(used.data());
  const std::uintptr_t end = begin + used.size();
  used = std::vector<char>();
  const Buffer<std::byte> column(kBytes);
  const std::byte* middle = column.data() + kBytes / 2;
  const auto place = reinterpret_cast<std::uintptr_t>(middle);
  if (place < begin || place >= end) GTEST_SKIP() << "this heap takes memory from elsewhere";
  utsname kernel{};
  ASSERT_EQ(uname(&kernel), 0);
  if (std::string_view(kernel.release) < "6.1") GTEST_SKIP() << "Linux before 6.1 cannot";
  EXPECT_GT(huge_kilobytes_at(middle), 0);
}
#endif

}  // namespace
}  // namespace hedgerow
