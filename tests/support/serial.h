#pragma once

#include "hedgerow/execution.h"

namespace hedgerow::test {

/// On the calling thread.
inline const Execution kSerial = Execution::serial();

}  // namespace hedgerow::test
