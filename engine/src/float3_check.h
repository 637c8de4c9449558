#pragma once

#include <cstdint>

#include "hedgerow/positions.h"
#include "hedgerow/result.h"

namespace hedgerow::detail {

/// What every operation asks of an array of float x, y, z that its caller owns: `Positions` to
/// read, `NormalsOut` to write. The one place that decides what a stride may be.
///
/// Errors     count_mismatch with fewer than `needed` elements, bad_stride, and null_pointer where
///            an element is needed; looked for in this order.
template <class Array>
[[nodiscard]] Result<void> check_float3(const Array& array, std::int64_t needed) noexcept {
  constexpr auto kLeast = static_cast<std::int64_t>(3 * sizeof(float));
  const auto stride = static_cast<std::int64_t>(array.stride_bytes);
  if (array.count < needed) {
    return fail({ErrorCode::count_mismatch, kInvalidIndex, array.count, needed});
  }
  if (stride < kLeast || array.stride_bytes % sizeof(float) != 0) {
    return fail({ErrorCode::bad_stride, kInvalidIndex, stride, kLeast});
  }
  if (needed > 0 && array.data == nullptr) return fail({ErrorCode::null_pointer});
  return {};
}

}  // namespace hedgerow::detail
