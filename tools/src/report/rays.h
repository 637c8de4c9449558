#pragma once

#include <cstdint>
#include <string>

#include "report/stages.h"

namespace hedgerow::tool {

/// What the ray stages found out besides their times.
struct RayFacts {
  int embree_version = 0;  ///< 31305 is 3.13.5; 0: no ray stage ran
  int width = 0;           ///< of the picture whose pixels the primary rays go through
  int height = 0;
  std::int64_t primary_rays = 0;
  std::int64_t primary_hits = 0;
  std::int64_t occlusion_rays = 0;
  std::int64_t occluded = 0;
  std::int64_t brute_force_rays = 0;  ///< compared with every triangle, each time
  std::int64_t copied_index_bytes = 0;
  std::int64_t tree_bytes = 0;
};

/// "3.13.5"
[[nodiscard]] std::string embree_version_text(const RayFacts& facts);
/// The `rays` object of the report; null if no ray stage ran.
[[nodiscard]] Json rays_json(const RayFacts& facts);
/// One line for people; empty if no ray stage ran.
[[nodiscard]] std::string rays_text(const RayFacts& facts);

/// bvh_build, bvh_refit, rays_primary, rays_occlusion and hit_connectivity. Defined only with
/// HEDGEROW_HAS_RAY.
[[nodiscard]] RayFacts measure_rays(Stages& stages, const Subject& subject);

}  // namespace hedgerow::tool
