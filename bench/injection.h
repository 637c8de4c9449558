#pragma once

#include <chrono>
#include <string>

namespace hedgerow::bench {

/// Makes one benchmark slower by a known share, to prove that a gate sees it. Only the test bench
/// does that, where PERFGATE_INJECT=NAME:+5% names the row and the share: then this spins until the
/// run that began at `start` has taken so much longer. In hedgerow_bench it does nothing.
/// Returns the seconds waited. Throws UsageError if the variable is set and cannot be read.
double inject_delay(const std::string& name, std::chrono::steady_clock::time_point start);

}  // namespace hedgerow::bench
