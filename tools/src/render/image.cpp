#include "render/image.h"

#include <algorithm>
#include <cmath>
#include <png.h>

#include "failure.h"

namespace hedgerow::tool {
namespace {

// The curve of sRGB: IEC 61966-2-1.
float to_linear(float encoded) {
  if (encoded <= 0.04045F) return encoded / 12.92F;
  return std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}
std::uint8_t to_byte(float linear) {
  const float light = std::clamp(linear, 0.0F, 1.0F);
  const float encoded =
      light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1 / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

}  // namespace

Vec3 linear_colour(std::uint32_t rrggbb) {
  const auto channel = [&](unsigned shift) {
    return to_linear(static_cast<float>((rrggbb >> shift) & 0xFFU) / 255);
  };
  return {channel(16), channel(8), channel(0)};
}

std::string png_bytes(const Image& image) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * static_cast<std::size_t>(image.width()) *
                static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (const float channel : image.at(x, y)) bytes.push_back(to_byte(channel));
    }
  }
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width());
  header.height = static_cast<png_uint_32>(image.height());
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string out(size, '\0');
  if (png_image_write_to_memory(&header, out.data(), &size, 0, bytes.data(), 0, nullptr) == 0) {
    throw Failure{ExitStatus::limit, "hedgerow", "cannot-encode", header.message, {}};
  }
  out.resize(size);
  return out;
}

}  // namespace hedgerow::tool
