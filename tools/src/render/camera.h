#pragma once

#include <array>
#include <span>

#include "hedgerow/positions.h"
#include "render/vector.h"

namespace hedgerow::tool {

/// A place in the picture, in pixels from its upper left corner, and how far away it is.
struct Projected {
  float x = 0;
  float y = 0;
  float depth = 0;
};

/// A perspective camera that looks at a mesh from the front, a little from the right and above, as
/// near as it may without cutting anything off.
class Camera {
 public:
  /// Points that are not finite are left out. `up` is the z axis for meshes that lie flat in x and
  /// y, like height fields, else the y axis.
  Camera(std::span<const Vec3> points, int width, int height);

  [[nodiscard]] const Vec3& eye() const noexcept { return eye_; }
  /// The unit direction through a place of the picture.
  [[nodiscard]] Vec3 direction(float x, float y) const noexcept;
  [[nodiscard]] Projected project(const Vec3& point) const noexcept;

  [[nodiscard]] const Vec3& right() const noexcept { return right_; }
  [[nodiscard]] const Vec3& up() const noexcept { return up_; }
  [[nodiscard]] const Vec3& backward() const noexcept { return backward_; }
  /// The axis that points upward in the scene, and the height of the lowest point along it.
  [[nodiscard]] const Vec3& world_up() const noexcept { return world_up_; }
  [[nodiscard]] float floor() const noexcept { return floor_; }
  [[nodiscard]] const Vec3& centre() const noexcept { return centre_; }
  /// Length of the diagonal of the mesh's box; 1 where there is none.
  [[nodiscard]] float diagonal() const noexcept { return diagonal_; }

 private:
  void look(std::span<const Vec3> points);
  void fit(std::span<const Vec3> points);

  int width_;
  int height_;
  float slope_x_ = 1;  ///< half the width of the picture at distance 1
  float slope_y_ = 1;
  Vec3 right_{1, 0, 0};
  Vec3 up_{0, 1, 0};
  Vec3 backward_{0, 0, 1};
  Vec3 world_up_{0, 1, 0};
  Vec3 eye_{};
  Vec3 centre_{};
  float floor_ = 0;
  float diagonal_ = 1;
};

}  // namespace hedgerow::tool
