#pragma once

#include <cstdint>

#include "hedgerow/ray/scene.h"
#include "render/vector.h"

namespace hedgerow::tool {

/// The share of the sky that points of a surface see, by rays that are spread like the light of an
/// even sky (by the cosine) and end at `reach`. Rays depend on `seed` alone.
class Occlusion {
 public:
  Occlusion(const ray::Scene& scene, float reach, int rays)
      : scene_(&scene), reach_(reach), rays_(rays) {}

  /// `normal` has length 1. 1: nothing is in the way, 0: everything is.
  [[nodiscard]] float open_share(const Vec3& point, const Vec3& normal, std::uint32_t seed) const;

 private:
  const ray::Scene* scene_;
  float reach_;
  int rays_;
};

}  // namespace hedgerow::tool
