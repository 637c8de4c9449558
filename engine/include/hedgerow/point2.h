#pragma once

#include <array>

namespace hedgerow {

/// x and y of a point in the plane.
using Point2 = std::array<double, 2>;

/// A rectangle along the axes.
struct Box2 {
  Point2 low{};
  Point2 high{};
};

}  // namespace hedgerow
