#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "hedgerow/buffer.h"

namespace hedgerow {
namespace {

// The line of flags of the mapping that holds `address`, from the kernel's own list; "" if it has
// none.
std::string flags_of(const void* address) {
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
    } else if (is_inside && line.starts_with("VmFlags:")) {
      return line + " ";
    }
  }
  return "";
}

// Runs twice: as it is, and with the variable that turns huge pages off.
TEST(HugePages, AreAskedForUnlessTheEnvironmentSaysOff) {
  const char* setting = std::getenv("HEDGEROW_HUGE_PAGES");
  const bool is_off = setting != nullptr && std::string_view(setting) == "off";
  Buffer<std::byte> large(std::size_t{32} << 20U);
  // The middle of the allocation: its ends may share a mapping with something else.
  const std::string flags = flags_of(large.data() + large.size() / 2);
  if (flags.empty()) GTEST_SKIP() << "the system lists no flags of mappings";
  EXPECT_EQ(flags.find(" hg ") != std::string::npos, !is_off) << flags;
}

}  // namespace
}  // namespace hedgerow
