#include "kernels/predicates.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include "kernels/wide_integer.h"

namespace hedgerow::kernels {
namespace {

// value * 2^120 as a whole number; every coordinate below is a multiple of 2^-120.
WideInteger whole(double value) {
  int exponent = 0;
  const auto bits =
      static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(value), &exponent), 53));
  if (bits == 0) return {};
  const auto shift = static_cast<std::size_t>(exponent - 53 + 120);
  return WideInteger(static_cast<std::uint32_t>(bits >> 32U), shift + 32, value < 0) +
         WideInteger(static_cast<std::uint32_t>(bits), shift, value < 0);
}

struct Whole2 {
  WideInteger x;
  WideInteger y;
};

Whole2 difference(const Point2& a, const Point2& b) {
  return {whole(a[0]) - whole(b[0]), whole(a[1]) - whole(b[1])};
}
WideInteger cross(const Whole2& a, const Whole2& b) { return a.x * b.y - a.y * b.x; }
WideInteger lift(const Whole2& a) { return a.x * a.x + a.y * a.y; }

int slow_orient2d(const Point2& a, const Point2& b, const Point2& c) {
  return cross(difference(a, c), difference(b, c)).sign();
}
int slow_incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const Whole2 p = difference(a, d);
  const Whole2 q = difference(b, d);
  const Whole2 r = difference(c, d);
  return (lift(p) * cross(q, r) + lift(q) * cross(r, p) + lift(r) * cross(p, q)).sign();
}

using Quad = std::array<Point2, 4>;

void expect_the_slow_signs(const Quad& q) {
  EXPECT_EQ(orient2d(q[0], q[1], q[2]), slow_orient2d(q[0], q[1], q[2]));
  EXPECT_EQ(incircle(q[0], q[1], q[2], q[3]), slow_incircle(q[0], q[1], q[2], q[3]));
}

TEST(Orient2d, IsPositiveForALeftTurn) {
  EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orient2d({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(orient2d({0, 0}, {1, 1}, {3, 3}), 0);
}

TEST(Incircle, IsPositiveInsideForALeftTurn) {
  EXPECT_EQ(incircle({0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}), 1);
  EXPECT_EQ(incircle({0, 0}, {1, 0}, {0, 1}, {2, 2}), -1);
  EXPECT_EQ(incircle({0, 0}, {1, 0}, {0, 1}, {1, 1}), 0);
  EXPECT_EQ(incircle({0, 0}, {0, 1}, {1, 0}, {0.5, 0.5}), -1);
}

TEST(Predicates, AgreeWithWholeNumbersOnSmallGrids) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> coordinate(-3, 3);
  // Far from the origin the differences are few units; a step of 0.1 is not exact in binary.
  for (const double step : {0.1, 1.0, 0x1p-100}) {
    for (const double shift : {0.0, 1e6 * step}) {
      for (int i = 0; i < 2000; ++i) {
        Quad quad;
        for (Point2& p : quad) {
          p = {step * coordinate(random) + shift, step * coordinate(random) - shift};
        }
        expect_the_slow_signs(quad);
      }
    }
  }
}

TEST(Predicates, AgreeWithWholeNumbersOneStepFromLinesAndCircles) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> step(-2, 2);
  std::uniform_real_distribution<double> angle(0, 6.28);
  for (int i = 0; i < 5000; ++i) {
    Quad line;
    Quad circle;
    for (std::size_t k = 0; k < 4; ++k) {
      const double t = angle(random);
      line[k] = {12 + t + std::ldexp(step(random), -49), 12 + t};
      circle[k] = {12 + std::cos(t) + std::ldexp(step(random), -49), 12 + std::sin(t)};
    }
    expect_the_slow_signs(line);
    expect_the_slow_signs(circle);
  }
}

TEST(Predicates, AgreeWithWholeNumbersOnMixedMagnitudes) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-20, 40);
  const auto coordinate = [&] {
    // A float's mantissa keeps every bit above 2^-120.
    return std::ldexp(static_cast<double>(static_cast<float>(mantissa(random))), exponent(random));
  };
  for (int i = 0; i < 5000; ++i) {
    Quad quad;
    for (Point2& p : quad) p = {coordinate(), coordinate()};
    if (i % 2 == 0) quad[2] = {2 * quad[1][0] - quad[0][0], 2 * quad[1][1] - quad[0][1]};
    if (i % 3 == 0) quad[3] = quad[0];
    expect_the_slow_signs(quad);
  }
}

}  // namespace
}  // namespace hedgerow::kernels
