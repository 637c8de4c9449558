#pragma once

#include <string>

namespace hedgerow::bench {

/// Runs each registered case of one thread that matches the regular expression once, checked as
/// always, and writes a line of JSON for each to standard output: its name, element counts and the
/// bytes that had to move.
///
/// Under callgrind (`--instr-atstart=no`) only that run is counted, from empty caches, and dumped
/// as a part of its own that bears the name: see bench/count.py. Elsewhere nothing is counted.
///
/// Returns the number of cases that gave a wrong answer. Throws std::regex_error, and
/// std::runtime_error if this build knows nothing of callgrind.
[[nodiscard]] int count_cases(const std::string& filter);

}  // namespace hedgerow::bench
