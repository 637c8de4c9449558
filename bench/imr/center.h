#pragma once

#include "hedgerow/buffer.h"
#include "hedgerow/execution.h"

namespace hedgerow::bench {

/// Takes the mean of all points from each of them: `xyz` holds x, y, z of each, packed. The sum is
/// in double, over blocks of the same size on any number of threads, so it is the same for all.
void center(Buffer<float>& xyz, const Execution& execution);

}  // namespace hedgerow::bench
