#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hedgerow::bench {

/// What a reader needs to judge the results, by name: processor, memory, system, huge pages,
/// governor, compiler, flags, index width, path of the kernels, versions of the peers, and what is
/// known to be odd about the framework.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> machine_context();

}  // namespace hedgerow::bench
