#pragma once

#include <cassert>

/// Checks a precondition of the caller in debug builds and costs nothing in release builds.
/// It guards against bugs, never against bad data: bad data comes back as an `Error`.
#define HEDGEROW_ASSERT(condition) assert(condition)
