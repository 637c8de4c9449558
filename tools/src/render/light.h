#pragma once

#include <algorithm>
#include <cmath>

#include "render/camera.h"
#include "render/vector.h"

/// The light that a picture is taken in: a warm lamp at the viewer's upper left, a cool one at the
/// right, and a sky. All of it moves with the camera, so every mesh is lit from its best side.
namespace hedgerow::tool {

class Light {
 public:
  explicit Light(const Camera& camera)
      : key_(unit(camera.right() * -0.55F + camera.up() * 0.75F + camera.backward() * 0.65F)),
        fill_(unit(camera.right() * 0.85F + camera.up() * 0.1F + camera.backward() * 0.5F)),
        sky_(camera.world_up()) {}

  /// Light that a surface sends to the eye. `open` is the share of the sky that it sees; `view`
  /// leads to the eye. Both directions have length 1.
  [[nodiscard]] Vec3 shade(const Vec3& colour, const Vec3& normal, const Vec3& view,
                           float open) const noexcept {
    const float key = std::max(0.0F, dot(normal, key_));
    const float fill = std::max(0.0F, dot(normal, fill_));
    const float height = 0.5F + 0.5F * dot(normal, sky_);
    const Vec3 lamps =
        (Vec3{1.06F, 1.0F, 0.92F} * (0.72F * key) + Vec3{0.72F, 0.84F, 1.0F} * (0.16F * fill)) *
        (0.35F + 0.65F * open);
    const Vec3 sky =
        mix(Vec3{0.30F, 0.28F, 0.27F}, Vec3{0.52F, 0.58F, 0.66F}, height) * (0.62F * open);
    const Vec3 half = unit(key_ + view);
    const float gloss = std::pow(std::max(0.0F, dot(normal, half)), 40.0F) * 0.10F * open;
    const float rim = 1 - std::max(0.0F, dot(normal, view));
    const float edge = rim * rim * rim * rim * 0.10F * open;
    return colour * (lamps + sky) + Vec3{1, 0.98F, 0.95F} * gloss + Vec3{0.8F, 0.88F, 1} * edge;
  }

 private:
  Vec3 key_;
  Vec3 fill_;
  Vec3 sky_;
};

}  // namespace hedgerow::tool
