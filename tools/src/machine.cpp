#include "machine.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <sys/utsname.h>
#include <unistd.h>

#include <fmt/format.h>
#include <tbb/info.h>

#include "build_info.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

constexpr const char* kUnknown = "unknown";

/// The rest of the first line of `path` that begins with `key`, without the separator; else "".
std::string value_of(const char* path, std::string_view key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t begin = line.find_first_not_of(" \t:=", key.size());
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return {};
}

std::string first_line(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

std::string without_quotes(const std::string& text) {
  return text.size() >= 2 && text.front() == '"' ? text.substr(1, text.size() - 2) : text;
}

/// "32K" or "512 kB" as bytes; both files count in units of 1024.
std::int64_t parse_bytes(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return 0;
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  const std::size_t letter = unit.find_first_of("kKM");
  if (letter == std::string_view::npos) return number;
  return unit[letter] == 'M' ? number << 20 : number << 10;
}

std::vector<Cache> read_caches() {
  std::vector<Cache> caches;
  for (int i = 0;; ++i) {
    const std::filesystem::path folder =
        fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}", i);
    const std::string level = first_line(folder / "level");
    if (level.empty()) return caches;
    Cache cache;
    cache.level = static_cast<int>(parse_bytes(level));
    cache.type = first_line(folder / "type");
    for (char& letter : cache.type) letter = static_cast<char>(letter | 0x20);
    cache.bytes = parse_bytes(first_line(folder / "size"));
    cache.shared_with = first_line(folder / "shared_cpu_list");
    caches.push_back(cache);
  }
}

std::string or_unknown(std::string text) { return text.empty() ? kUnknown : std::move(text); }

std::string operating_system() {
  const std::string name = without_quotes(value_of("/etc/os-release", "PRETTY_NAME"));
  utsname kernel{};
  if (uname(&kernel) != 0) return or_unknown(name);
  return fmt::format("{}, {} {}", or_unknown(name), kernel.sysname, kernel.release);
}

}  // namespace

Machine describe_machine() {
  Machine machine;
  machine.cpu = or_unknown(value_of("/proc/cpuinfo", "model name"));
  machine.cores = tbb::info::default_concurrency();
  machine.caches = read_caches();
  machine.memory_bytes = parse_bytes(value_of("/proc/meminfo", "MemTotal"));
  machine.os = operating_system();
  return machine;
}

Json machine_json(const Machine& machine) {
  Json caches = Json::array();
  for (const Cache& cache : machine.caches) {
    caches.push_back({{"level", cache.level},
                      {"type", cache.type},
                      {"bytes", cache.bytes},
                      {"shared_with", cache.shared_with}});
  }
  const BuildInfo& build = build_info();
  Json json;
  json["cpu"] = machine.cpu;
  json["cores"] = machine.cores;
  json["caches"] = std::move(caches);
  json["memory"] = machine.memory_bytes;
  json["os"] = machine.os;
  json["compiler"] = build.compiler;
  json["flags"] = build.flags;
  json["simd"] = build.simd;
  return json;
}

std::string machine_text(const Machine& machine, bool colour) {
  const BuildInfo& build = build_info();
  std::string caches;
  for (const Cache& cache : machine.caches) {
    caches += fmt::format("{}L{} {} {}", caches.empty() ? "" : ", ", cache.level, cache.type,
                          byte_text(cache.bytes));
  }
  Table table({{"machine", Table::Align::left}, {"", Table::Align::left}});
  table.add({"cpu", machine.cpu});
  table.add({"cores", fmt::format("{}", machine.cores)});
  table.add({"caches", or_unknown(caches)});
  table.add({"memory", byte_text(machine.memory_bytes)});
  table.add({"os", machine.os});
  table.add({"compiler", fmt::format("{}, {}", build.compiler, build.build_type)});
  table.add({"flags", build.flags});
  table.add({"SIMD", build.simd});
  return table.text(colour);
}

std::int64_t peak_resident_bytes() { return parse_bytes(value_of("/proc/self/status", "VmHWM")); }

}  // namespace hedgerow::tool
