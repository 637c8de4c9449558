#pragma once

#include <array>

namespace hedgerow {

/// x and y of a point in the plane.
using Point2 = std::array<double, 2>;

}  // namespace hedgerow
