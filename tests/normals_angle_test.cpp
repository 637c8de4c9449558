#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hedgerow/normals.h"
#include "kernels/normals_math.h"

namespace hedgerow {
namespace {

long double exact(float c, float d) {
  return std::atan2(static_cast<long double>(c), static_cast<long double>(d));
}

double worst_error(float c, float d) {
  return static_cast<double>(std::abs(static_cast<long double>(angle_between(c, d)) - exact(c, d)));
}

TEST(AngleBetween, StaysWithinItsBoundRoundTheHalfTurn) {
  double worst = 0;
  constexpr int kSteps = 2'000'000;
  for (int i = 0; i <= kSteps; ++i) {
    const long double angle = 3.14159265358979323846L * i / kSteps;
    worst = std::max(worst, worst_error(std::abs(static_cast<float>(std::sin(angle))),
                                        static_cast<float>(std::cos(angle))));
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LE(worst, kAngleErrorBound);
  EXPECT_GE(worst, kAngleErrorBound / 3) << "the bound is looser than it need be";
}

TEST(AngleBetween, StaysWithinItsBoundForAnyLengths) {
  double worst = 0;
  for (int e = -60; e <= 60; ++e) {
    for (int i = 1; i < 2000; ++i) {
      const float c = std::ldexp(1.0f + static_cast<float>(i) / 2000, e);
      for (const float d : {1.0f, -1.0f, 0.7f, -3.0f}) worst = std::max(worst, worst_error(c, d));
    }
  }
  EXPECT_LE(worst, kAngleErrorBound);
}

TEST(AngleBetween, IsAccurateInRelationToSmallAngles) {
  for (float c = 1e-30f; c < 0.4f; c *= 1.37f) {
    const auto relative = (static_cast<long double>(angle_between(c, 1)) - exact(c, 1)) / c;
    EXPECT_LE(std::abs(relative), 2.5e-7L) << c;
  }
}

TEST(AngleBetween, KnowsTheEnds) {
  EXPECT_EQ(angle_between(0, 0), 0.0f);
  EXPECT_EQ(angle_between(0, 3), 0.0f);
  EXPECT_EQ(angle_between(0, -3), 3.14159265f);
  EXPECT_EQ(angle_between(2, 0), 1.57079633f);
  EXPECT_NEAR(angle_between(5, 5), 0.785398163f, 1e-7f);
}

// The three angles of a triangle with corners on a lattice, whose products are exact.
struct LatticeTriangle {
  int u[2];  // from the first corner to the second
  int v[2];  // and to the third

  [[nodiscard]] long double cross() const {
    return std::abs(1.0L * u[0] * v[1] - 1.0L * u[1] * v[0]);
  }
  [[nodiscard]] long double dot(int k) const {
    const long double uv = 1.0L * u[0] * v[0] + 1.0L * u[1] * v[1];
    const long double uu = 1.0L * u[0] * u[0] + 1.0L * u[1] * u[1];
    const long double vv = 1.0L * v[0] * v[0] + 1.0L * v[1] * v[1];
    return k == 0 ? uv : k == 1 ? uu - uv : vv - uv;
  }
};

double worst_error(const LatticeTriangle& triangle) {
  const float dots[3] = {static_cast<float>(triangle.dot(0)), static_cast<float>(triangle.dot(1)),
                         static_cast<float>(triangle.dot(2))};
  float angles[3];
  kernels::angles_of(static_cast<float>(triangle.cross()), dots, angles);
  double worst = 0;
  for (int k = 0; k < 3; ++k) {
    const long double expected = std::atan2(triangle.cross(), triangle.dot(k));
    worst = std::max(worst, static_cast<double>(std::abs(angles[k] - expected)));
  }
  return worst;
}

TEST(AnglesOfATriangle, StayWithinTwiceTheBound) {
  std::mt19937 random(11);
  const auto coordinate = [&](int size) {
    return static_cast<int>(random() % static_cast<unsigned>(2 * size + 1)) - size;
  };
  double worst = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const int size = i % 3 == 0 ? 3 : 1000;  // right angles and equal ones are among the small
    const LatticeTriangle triangle{{coordinate(size), coordinate(size)},
                                   {coordinate(1000), coordinate(size)}};
    if (triangle.cross() != 0) worst = std::max(worst, worst_error(triangle));
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LE(worst, 2 * kAngleErrorBound);
  EXPECT_GE(worst, kAngleErrorBound) << "the bound is looser than it need be";
}

struct Angles {
  float of[3];
};
Angles angles_of(float cross_length, float a, float b, float c) {
  const float dots[3] = {a, b, c};
  Angles angles;
  kernels::angles_of(cross_length, dots, angles.of);
  return angles;
}

// Two right angles, as far as floats can tell, at the ends of a short edge.
TEST(AnglesOfATriangle, AreInRangeWhereRoundingLeavesCosinesOutOfIt) {
  for (const float third : {6e-16F, -7e-14F}) {
    const Angles angles = angles_of(1e-15F, 1, -6e-14F, third);
    for (const float angle : angles.of) {
      EXPECT_GE(angle, 0);
      EXPECT_LE(angle, 3.1415930F);
    }
    EXPECT_NEAR(angles.of[0] + angles.of[1] + angles.of[2], 3.14159265F, 1e-6F);
  }
}

// Equal smallest dot products and every order of them.
TEST(AnglesOfATriangle, TakeTheLargestFromTheOthersWhereverItIs) {
  const float dots[] = {3, 1, -1, 1};
  for (const float a : dots) {
    for (const float b : dots) {
      for (const float c : dots) {
        if (a + b <= 0 || a + c <= 0 || b + c <= 0) continue;  // no triangle
        const float length = std::sqrt(a * b + b * c + c * a);
        const Angles angles = angles_of(length, a, b, c);
        EXPECT_NEAR(angles.of[0], angle_between(length, a), 5e-7F);
        EXPECT_NEAR(angles.of[1], angle_between(length, b), 5e-7F);
        EXPECT_NEAR(angles.of[2], angle_between(length, c), 5e-7F);
      }
    }
  }
}

}  // namespace
}  // namespace hedgerow
