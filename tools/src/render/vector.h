#pragma once

#include <cmath>

#include "hedgerow/ray/ray.h"

/// Three floats: points and directions, and colours as linear red, green and blue.
namespace hedgerow::tool {

using ray::Vec3;

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) noexcept {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
constexpr Vec3 operator*(const Vec3& a, float s) noexcept { return {a[0] * s, a[1] * s, a[2] * s}; }
constexpr Vec3 operator*(const Vec3& a, const Vec3& b) noexcept {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}
constexpr float dot(const Vec3& a, const Vec3& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
constexpr Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline float length(const Vec3& a) noexcept { return std::sqrt(dot(a, a)); }
/// Of length 1, or 0 if it has none.
inline Vec3 unit(const Vec3& a) noexcept {
  const float l = length(a);
  return l > 0 ? a * (1 / l) : Vec3{};
}
constexpr Vec3 mix(const Vec3& a, const Vec3& b, float share_of_b) noexcept {
  return a * (1 - share_of_b) + b * share_of_b;
}
inline Vec3 to_vector(const float* xyz) noexcept { return {xyz[0], xyz[1], xyz[2]}; }

}  // namespace hedgerow::tool
