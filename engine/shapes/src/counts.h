#pragma once

#include <cstdint>
#include <limits>

#include "hedgerow/result.h"
#include "hedgerow/soup.h"

namespace hedgerow::shapes {

/// a * b, or the largest number if that is too large. \pre a, b >= 0
[[nodiscard]] constexpr std::int64_t saturating_product(std::int64_t a, std::int64_t b) noexcept {
  constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
  return b != 0 && a > kLargest / b ? kLargest : a * b;
}

/// count_mismatch if `value` is below `smallest`.
[[nodiscard]] inline Result<void> at_least(std::int64_t smallest, std::int64_t value) {
  if (value >= smallest) return {};
  return fail({.code = ErrorCode::count_mismatch, .value = value, .limit = smallest});
}

/// A soup with room for these elements. Polygons get an offset column.
[[nodiscard]] inline Result<Soup> make_soup(std::int64_t vertices, std::int64_t faces,
                                            std::int64_t degree, bool are_polygons) {
  const std::int64_t floats = saturating_product(vertices, 3);
  const std::int64_t corners = saturating_product(faces, degree);
  for (const std::int64_t count : {floats, corners}) {
    if (count > kMaxCount) {
      return fail({.code = ErrorCode::too_many_elements, .value = count, .limit = kMaxCount});
    }
  }
  Soup soup;
  soup.xyz = Buffer<float>(static_cast<std::size_t>(floats));
  soup.corners = Buffer<Index>(static_cast<std::size_t>(corners));
  if (are_polygons) soup.offsets = Buffer<Index>(static_cast<std::size_t>(faces) + 1);
  return soup;
}

[[nodiscard]] inline Result<Soup> make_triangles(std::int64_t vertices, std::int64_t triangles) {
  return make_soup(vertices, triangles, 3, false);
}

/// Writes positions one after the other.
class PointWriter {
 public:
  explicit PointWriter(Soup& soup) noexcept : xyz_(soup.xyz.data()) {}
  void add(double x, double y, double z) noexcept {
    xyz_[0] = static_cast<float>(x);
    xyz_[1] = static_cast<float>(y);
    xyz_[2] = static_cast<float>(z);
    xyz_ += 3;
  }

 private:
  float* xyz_;
};

/// Writes triangles one after the other.
class TriangleWriter {
 public:
  explicit TriangleWriter(Soup& soup) noexcept : corner_(soup.corners.data()) {}
  void add(std::int64_t a, std::int64_t b, std::int64_t c) noexcept {
    corner_[0] = static_cast<Index>(a);
    corner_[1] = static_cast<Index>(b);
    corner_[2] = static_cast<Index>(c);
    corner_ += 3;
  }
  /// The square a b c d, counter-clockwise, cut from a to c.
  void add_square(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) noexcept {
    add(a, b, c);
    add(a, c, d);
  }

 private:
  Index* corner_;
};

}  // namespace hedgerow::shapes
