#pragma once

#include <cstddef>
#include <cstdint>

#include "hedgerow/index.h"

namespace hedgerow {

/// The caller's vertex positions: float x, y, z each `stride_bytes` apart (12, 16 or more, a
/// multiple of 4). Not copied, not owned; no byte behind the last z is read. The unit of length is
/// the caller's.
///
/// Pre        Indexing: 0 <= i < count; not checked.
/// Lifetime   The array must outlive the call that it is passed to.
struct Positions {
  const float* data = nullptr;
  std::int64_t count = 0;
  std::size_t stride_bytes = 3 * sizeof(float);

  [[nodiscard]] const float* operator[](Index i) const noexcept {
    return reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(data) +
                                          static_cast<std::size_t>(i) * stride_bytes);
  }
};

/// Where normals are written: float x, y, z each `stride_bytes` apart (12, 16 or more, a multiple
/// of 4); bytes between are left alone. Pre and lifetime as those of `Positions`.
struct NormalsOut {
  float* data = nullptr;
  std::int64_t count = 0;
  std::size_t stride_bytes = 3 * sizeof(float);

  [[nodiscard]] float* operator[](Index i) const noexcept {
    return reinterpret_cast<float*>(reinterpret_cast<std::byte*>(data) +
                                    static_cast<std::size_t>(i) * stride_bytes);
  }
};

}  // namespace hedgerow
