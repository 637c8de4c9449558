#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hedgerow/normals.h"

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

}  // namespace
}  // namespace hedgerow
