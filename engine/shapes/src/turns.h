#pragma once

#include <cmath>

namespace hedgerow::shapes {

/// sin(2 pi t) to within 1e-7, from additions and multiplications alone: the sine of the C library
/// differs in its last bit from one library to the next.
[[nodiscard]] inline double sine_of_turns(double t) noexcept {
  t -= std::floor(t + 0.5);  // -1/2 .. 1/2
  // sin(pi - x) = sin(x) leaves a quarter turn on either side of zero.
  if (t > 0.25) t = 0.5 - t;
  if (t < -0.25) t = -0.5 - t;
  const double x = 6.283185307179586 * t;
  const double x2 = x * x;
  double sum = 1.0 / 6227020800.0;
  sum = sum * x2 - 1.0 / 39916800.0;
  sum = sum * x2 + 1.0 / 362880.0;
  sum = sum * x2 - 1.0 / 5040.0;
  sum = sum * x2 + 1.0 / 120.0;
  sum = sum * x2 - 1.0 / 6.0;
  return x + x * x2 * sum;
}

[[nodiscard]] inline double cosine_of_turns(double t) noexcept { return sine_of_turns(t + 0.25); }

}  // namespace hedgerow::shapes
