#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run.h"

namespace hedgerow::tool {

struct Cache {
  int level = 0;
  std::string type;  ///< "data", "instruction" or "unified"
  std::int64_t bytes = 0;
  std::string shared_with;  ///< processors, as the system writes them, e.g. "0-1"
};

/// What the numbers of a run depend on. Text is "unknown" and counts are 0 where the system does
/// not say.
struct Machine {
  std::string cpu;
  int cores = 0;              ///< processors that this process may run on
  std::vector<Cache> caches;  ///< of the first processor
  std::int64_t memory_bytes = 0;
  std::string os;
};

[[nodiscard]] Machine describe_machine();
/// The `machine` object of CLI.md: the machine and the build.
[[nodiscard]] Json machine_json(const Machine& machine);
/// The same as lines for people.
[[nodiscard]] std::string machine_text(const Machine& machine, bool colour);

/// The most memory that this process has had resident so far; 0 if the system does not say.
[[nodiscard]] std::int64_t peak_resident_bytes();

}  // namespace hedgerow::tool
