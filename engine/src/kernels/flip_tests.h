#pragma once

#include <cstdint>

/// Whether an edge between two triangles should be flipped. The edge runs from a to b; d is the
/// corner across it on its left, c on its right.
namespace hedgerow::kernels {

enum class EdgeState : std::uint8_t {
  legal,
  illegal,
  undefined,  ///< a coordinate is not finite
};

/// By the sum of the angles at c and d; x, y and z.
[[nodiscard]] EdgeState test_angle_sum(const float* a, const float* b, const float* c,
                                       const float* d) noexcept;

/// By the circle through a, b and d; x and y, exact.
[[nodiscard]] EdgeState test_in_circle(const float* a, const float* b, const float* c,
                                       const float* d) noexcept;

}  // namespace hedgerow::kernels
