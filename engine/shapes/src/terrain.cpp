#include <algorithm>
#include <cmath>

#include "counts.h"
#include "hedgerow/shapes.h"
#include "random.h"

namespace hedgerow::shapes {

namespace {

constexpr int kOctaves = 7;

// -1 .. 1 at a point of the integer lattice.
double lattice_value(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  const std::uint64_t bits = mixed(mixed(mixed(seed) + static_cast<std::uint64_t>(x)) +
                                   static_cast<std::uint64_t>(y) * 0x9e3779b97f4a7c15U);
  return static_cast<double>(bits >> 11U) * 0x1p-52 - 1;
}

// 0 to 1 with slope 0 and curvature 0 at both ends.
double eased(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double smooth_noise(double x, double y, std::uint64_t seed) {
  const double floor_x = std::floor(x);
  const double floor_y = std::floor(y);
  const auto i = static_cast<std::int64_t>(floor_x);
  const auto j = static_cast<std::int64_t>(floor_y);
  const double u = eased(x - floor_x);
  const double v = eased(y - floor_y);
  const double low = (1 - u) * lattice_value(i, j, seed) + u * lattice_value(i + 1, j, seed);
  const double high =
      (1 - u) * lattice_value(i, j + 1, seed) + u * lattice_value(i + 1, j + 1, seed);
  return (1 - v) * low + v * high;
}

double height(double x, double y, std::uint64_t seed) {
  double sum = 0;
  double amplitude = 0.25;
  for (int octave = 0; octave < kOctaves; ++octave) {
    sum += amplitude * smooth_noise(x, y, seed + static_cast<std::uint64_t>(octave));
    x *= 2;
    y *= 2;
    amplitude *= 0.45;
  }
  return sum;
}

}  // namespace

Result<Soup> terrain(std::int64_t columns, std::int64_t rows, std::uint64_t seed) {
  Result<Soup> soup = grid(columns, rows);
  if (!soup) return soup;
  // The longer side is one unit; the widest hills take a third of it.
  const double scale = 1 / static_cast<double>(std::max(columns, rows));
  PointWriter points(*soup);
  for (std::int64_t j = 0; j <= rows; ++j) {
    for (std::int64_t i = 0; i <= columns; ++i) {
      const double x = scale * static_cast<double>(i);
      const double y = scale * static_cast<double>(j);
      points.add(x, y, height(3 * x, 3 * y, seed));
    }
  }
  return soup;
}

}  // namespace hedgerow::shapes
