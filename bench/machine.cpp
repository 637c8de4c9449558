#include "machine.h"

#include <fstream>
#include <string>
#include <sys/utsname.h>
#include <unistd.h>

#include "hedgerow/index.h"

namespace hedgerow::bench {

namespace {

/// The first line of a file, or `otherwise`.
std::string first_line(const std::string& path, const std::string& otherwise) {
  std::ifstream file(path);
  std::string line;
  return std::getline(file, line) && !line.empty() ? line : otherwise;
}

/// The value of the first "key : value" line of a file of such lines.
std::string value_of(const std::string& path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const std::size_t colon = line.find(':');
    const std::size_t start = line.find_first_not_of(" \t", colon + 1);
    if (colon != std::string::npos && start != std::string::npos) return line.substr(start);
  }
  return "unknown";
}

/// The word in brackets: "always [madvise] never" has "madvise".
std::string chosen(const std::string& choices) {
  const std::size_t open = choices.find('[');
  const std::size_t close = choices.find(']');
  if (open == std::string::npos || close == std::string::npos) return choices;
  return choices.substr(open + 1, close - open - 1);
}

std::string system_name() {
  utsname names{};
  if (uname(&names) != 0) return "unknown";
  const std::string release = names.release;
  // What is behind the number tells who built the kernel, not which it is.
  return std::string(names.sysname) + " " + release.substr(0, release.find('-')) + " " +
         names.machine;
}

std::string compiler_name() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "gcc " __VERSION__;
#endif
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machine_context() {
  const std::string cpu = "/sys/devices/system/cpu/cpu0";
  const auto pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
  const double gib = pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024 * 1024);
  std::vector<std::pair<std::string, std::string>> context;
  const auto add = [&](const char* key, const std::string& value) {
    context.emplace_back(key, value);
  };
  add("cpu", value_of("/proc/cpuinfo", "model name"));
  add("processors", std::to_string(sysconf(_SC_NPROCESSORS_ONLN)));
  add("memory_gib", std::to_string(static_cast<int>(gib + 0.5)));
  add("last_level_cache",
      first_line(cpu + "/cache/index3/size", first_line(cpu + "/cache/index2/size", "unknown")));
  add("system", system_name());
  add("transparent_huge_pages",
      chosen(first_line("/sys/kernel/mm/transparent_hugepage/enabled", "unknown")));
  add("governor", first_line(cpu + "/cpufreq/scaling_governor", "not reported"));
  add("compiler", compiler_name());
  add("flags", HEDGEROW_BENCH_FLAGS);
  add("index_bits", std::to_string(8 * sizeof(Index)));
  add("peers", HEDGEROW_BENCH_PEERS);
  add("benchmark_library", HEDGEROW_BENCH_LIBRARY);
  return context;
}

}  // namespace hedgerow::bench
