#include "mesh_source.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace hedgerow::bench {

namespace {

/// Rows of squares, each cut in two, 2 to 1 in extent, with a gentle relief.
Soup grid(std::int64_t triangle_count) {
  const auto rows = static_cast<Index>(std::sqrt(static_cast<double>(triangle_count) / 4));
  const auto columns = static_cast<Index>(triangle_count / 2 / rows);
  Soup soup;
  soup.xyz = Buffer<float>(3 * static_cast<std::size_t>((rows + 1) * (columns + 1)));
  soup.corners = Buffer<Index>(6 * static_cast<std::size_t>(rows * columns));
  float* xyz = soup.xyz.data();
  for (Index row = 0; row <= rows; ++row) {
    for (Index column = 0; column <= columns; ++column) {
      const auto x = static_cast<float>(column);
      const auto y = static_cast<float>(row);
      *xyz++ = x;
      *xyz++ = y;
      *xyz++ = 4 * std::sin(0.05F * x) * std::cos(0.03F * y);
    }
  }
  Index* corner = soup.corners.data();
  for (Index row = 0; row < rows; ++row) {
    for (Index column = 0; column < columns; ++column) {
      const Index v = row * (columns + 1) + column;
      const Index above = v + columns + 1;
      for (const Index i : {v, v + 1, above + 1, v, above + 1, above}) *corner++ = i;
    }
  }
  return soup;
}

/// A cone: one vertex that every triangle shares.
Soup fan(std::int64_t triangle_count) {
  const auto count = static_cast<Index>(triangle_count);
  Soup soup;
  soup.xyz = Buffer<float>(3 * static_cast<std::size_t>(count + 1));
  soup.corners = Buffer<Index>(3 * static_cast<std::size_t>(count));
  soup.xyz[0] = 0;
  soup.xyz[1] = 0;
  soup.xyz[2] = 1;
  for (Index i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    float* p = &soup.xyz[3 * static_cast<std::size_t>(i + 1)];
    p[0] = static_cast<float>(std::cos(angle));
    p[1] = static_cast<float>(std::sin(angle));
    p[2] = 0;
    Index* corner = &soup.corners[3 * static_cast<std::size_t>(i)];
    corner[0] = 0;
    corner[1] = i + 1;
    corner[2] = i + 1 == count ? 1 : i + 2;
  }
  return soup;
}

}  // namespace

Soup generate_soup(const std::string& shape, std::int64_t triangle_count) {
  if (shape == "grid") return grid(triangle_count);
  if (shape == "fan") return fan(triangle_count);
  throw std::runtime_error("no shape is called " + shape);
}

Soup read_soup(const std::string& path) {
  throw std::runtime_error(path + ": file formats are not part of this build");
}

}  // namespace hedgerow::bench
