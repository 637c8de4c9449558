#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "hedgerow/point2.h"

/// Points in the plane, spread as algorithms like it and as they do not.
namespace hedgerow::test {

enum class Spread : std::uint8_t {
  uniform,
  clusters,     ///< a few, of very different sizes
  repeated,     ///< uniform, but most places several times
  tenths,       ///< a grid whose steps are not exact in binary
  small_whole,  ///< whole numbers in a small square: lines, circles and repetition
  grid,         ///< whole numbers, each once, shuffled
  line,         ///< along one line, of any direction
  two_lines,
  circle,  ///< rounded onto a circle
  wide,    ///< magnitudes from 2^-190 to 2^190
};
inline constexpr int kSpreadCount = 10;

inline std::vector<Point2> uniform_points(std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Point2> points(count);
  for (Point2& p : points) p = {coordinate(random), coordinate(random)};
  return points;
}

inline std::vector<Point2> clustered_points(std::size_t count, std::mt19937_64& random) {
  std::normal_distribution<double> offset;
  std::uniform_int_distribution<int> exponent(-40, 0);
  const std::vector<Point2> centres = uniform_points(4, random);
  std::vector<Point2> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double size = std::ldexp(1.0, exponent(random));
    const Point2& centre = centres[i % 4];
    points[i] = {centre[0] + size * offset(random), centre[1] + size * offset(random)};
  }
  return points;
}

inline std::vector<Point2> whole_points(std::size_t count, double step, std::mt19937_64& random) {
  const int side = 1 + static_cast<int>(std::sqrt(static_cast<double>(count)));
  std::uniform_int_distribution<int> coordinate(0, side);
  std::vector<Point2> points(count);
  for (Point2& p : points) p = {step * coordinate(random), step * coordinate(random)};
  return points;
}

inline std::vector<Point2> grid_points(std::size_t count, std::mt19937_64& random) {
  const auto width = 1 + static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
  std::vector<Point2> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    points[i] = {static_cast<double>(i % width), static_cast<double>(i / width)};
  }
  std::shuffle(points.begin(), points.end(), random);
  return points;
}

inline std::vector<Point2> line_points(std::size_t count, int lines, std::mt19937_64& random) {
  std::uniform_int_distribution<int> step(-3, 3);
  std::uniform_int_distribution<int> place(0, 1000);
  const Point2 direction{static_cast<double>(step(random)), static_cast<double>(step(random))};
  std::vector<Point2> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = place(random);
    const double shift = lines == 2 && i % 2 == 1 ? 1 : 0;
    points[i] = {t * direction[0] + shift, t * direction[1] - 2 * shift};
  }
  return points;
}

inline std::vector<Point2> circle_points(std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(0, 6.2831853);
  std::vector<Point2> points(count);
  for (Point2& p : points) {
    const double t = angle(random);
    p = {std::cos(t), std::sin(t)};
  }
  return points;
}

inline std::vector<Point2> wide_points(std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> mantissa(0.5, 1);
  std::uniform_int_distribution<int> exponent(-190, 190);
  std::vector<Point2> points(count);
  for (Point2& p : points) {
    for (double& c : p) {
      c = std::ldexp(mantissa(random), exponent(random)) * (random() % 2 == 0 ? 1 : -1);
    }
  }
  return points;
}

inline std::vector<Point2> points_of(Spread spread, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  switch (spread) {
    case Spread::uniform:
      return uniform_points(count, random);
    case Spread::clusters:
      return clustered_points(count, random);
    case Spread::repeated: {
      std::vector<Point2> points = uniform_points(count, random);
      for (Point2& p : points) p = points[random() % (count / 3 + 1)];
      return points;
    }
    case Spread::tenths:
      return whole_points(count, 0.1, random);
    case Spread::small_whole:
      return whole_points(count, 1, random);
    case Spread::grid:
      return grid_points(count, random);
    case Spread::line:
      return line_points(count, 1, random);
    case Spread::two_lines:
      return line_points(count, 2, random);
    case Spread::circle:
      return circle_points(count, random);
    case Spread::wide:
      return wide_points(count, random);
  }
  return {};
}

}  // namespace hedgerow::test
