#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/vector.h"

namespace hedgerow::tool {

/// A picture in linear light, row by row from the top.
class Image {
 public:
  Image(int width, int height)
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] Vec3& at(int x, int y) noexcept { return pixels_[index(x, y)]; }
  [[nodiscard]] const Vec3& at(int x, int y) const noexcept { return pixels_[index(x, y)]; }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  int width_;
  int height_;
  std::vector<Vec3> pixels_;
};

/// The colour that is written as #rrggbb, in linear light.
[[nodiscard]] Vec3 linear_colour(std::uint32_t rrggbb);

/// The bytes of a PNG file, 8 bits a channel, sRGB. Throws `Failure` (limit) if libpng cannot.
[[nodiscard]] std::string png_bytes(const Image& image);

}  // namespace hedgerow::tool
