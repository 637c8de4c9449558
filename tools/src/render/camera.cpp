#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hedgerow::tool {
namespace {

constexpr float kHalfViewSlope = 0.30F;  // half the field of view of the shorter side: 17 degrees
constexpr float kMargin = 0.07F;         // of the picture, left free on each side
constexpr float kFlat = 0.6F;            // a box lower than this share of its width lies flat

bool is_finite(const Vec3& point) { return std::isfinite(point[0] + point[1] + point[2]); }

}  // namespace

Camera::Camera(std::span<const Vec3> points, int width, int height)
    : width_(width), height_(height) {
  const float shorter = static_cast<float>(std::min(width, height));
  slope_x_ = kHalfViewSlope * static_cast<float>(width) / shorter;
  slope_y_ = kHalfViewSlope * static_cast<float>(height) / shorter;
  look(points);
  fit(points);
}

void Camera::look(std::span<const Vec3> points) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Vec3 low = {kInfinity, kInfinity, kInfinity};
  Vec3 high = low * -1.0F;
  for (const Vec3& point : points) {
    if (!is_finite(point)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  if (!(low[0] <= high[0])) low = high = Vec3{};
  const Vec3 size = high - low;
  centre_ = (low + high) * 0.5F;
  if (const float diagonal = length(size); diagonal > 0 && std::isfinite(diagonal)) {
    diagonal_ = diagonal;
  }
  const bool lies_flat = size[2] < kFlat * std::min(size[0], size[1]);
  world_up_ = lies_flat ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  floor_ = lies_flat ? low[2] : low[1];
  // A height field is seen from further above than a figure.
  const Vec3 front = lies_flat ? Vec3{0, -1, 0} : Vec3{0, 0, 1};
  const Vec3 side = cross(world_up_, front);
  backward_ = unit(front + side * 0.55F + world_up_ * (lies_flat ? 0.85F : 0.38F));
  right_ = unit(cross(world_up_, backward_));
  up_ = cross(backward_, right_);
}

// In the camera's axes a point p is inside the left and right sides of the view if
// |x - eye_x| <= slope (eye_z - z): two bounds on eye_x +- slope eye_z that all points give.
void Camera::fit(std::span<const Vec3> points) {
  const float sx = slope_x_ * (1 - 2 * kMargin);
  const float sy = slope_y_ * (1 - 2 * kMargin);
  std::array<float, 4> most{};
  bool is_first = true;
  for (const Vec3& point : points) {
    if (!is_finite(point)) continue;
    const Vec3 p = point - centre_;
    const float x = dot(p, right_);
    const float y = dot(p, up_);
    const float z = dot(p, backward_);
    const std::array<float, 4> bounds = {x + sx * z, -x + sx * z, y + sy * z, -y + sy * z};
    for (std::size_t i = 0; i < 4; ++i) {
      most[i] = is_first ? bounds[i] : std::max(most[i], bounds[i]);
    }
    is_first = false;
  }
  const float x = (most[0] - most[1]) / 2;
  const float y = (most[2] - most[3]) / 2;
  const float z = std::max((most[0] + most[1]) / (2 * sx), (most[2] + most[3]) / (2 * sy));
  // A single point, or points in a line of sight, leave no distance.
  const float distance = std::max(z, 0.01F * diagonal_);
  eye_ = centre_ + right_ * x + up_ * y + backward_ * distance;
}

Vec3 Camera::direction(float x, float y) const noexcept {
  const float across = (2 * x / static_cast<float>(width_) - 1) * slope_x_;
  const float upward = (1 - 2 * y / static_cast<float>(height_)) * slope_y_;
  return unit(right_ * across + up_ * upward - backward_);
}

Projected Camera::project(const Vec3& point) const noexcept {
  const Vec3 way = point - eye_;
  const float depth = -dot(way, backward_);
  const float across = dot(way, right_) / (depth * slope_x_);
  const float upward = dot(way, up_) / (depth * slope_y_);
  return {(across + 1) * 0.5F * static_cast<float>(width_),
          (1 - upward) * 0.5F * static_cast<float>(height_), depth};
}

}  // namespace hedgerow::tool
