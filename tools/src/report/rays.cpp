#include "report/rays.h"

#include <fmt/format.h>

#include "table.h"

namespace hedgerow::tool {

std::string embree_version_text(const RayFacts& facts) {
  return fmt::format("{}.{}.{}", facts.embree_version / 10000, facts.embree_version / 100 % 100,
                     facts.embree_version % 100);
}

Json rays_json(const RayFacts& facts) {
  if (facts.embree_version == 0) return nullptr;
  Json json;
  json["embree"] = embree_version_text(facts);
  json["width"] = facts.width;
  json["height"] = facts.height;
  json["primary_rays"] = facts.primary_rays;
  json["primary_hits"] = facts.primary_hits;
  json["occlusion_rays"] = facts.occlusion_rays;
  json["occluded"] = facts.occluded;
  json["brute_force_rays"] = facts.brute_force_rays;
  json["copied_index_bytes"] = facts.copied_index_bytes;
  json["tree_bytes"] = facts.tree_bytes;
  return json;
}

std::string rays_text(const RayFacts& facts) {
  if (facts.embree_version == 0) return {};
  return fmt::format(
      "Embree {}: {} x {} rays, {} hits; {} occlusion rays, {} of them stopped. Index bytes copied "
      "for it: {};\nits tree takes {}. Its own speed is shown, not claimed; hit_connectivity and "
      "normals are ours.\n",
      embree_version_text(facts), facts.width, facts.height, grouped(facts.primary_hits),
      grouped(facts.occlusion_rays), grouped(facts.occluded), grouped(facts.copied_index_bytes),
      byte_text(facts.tree_bytes));
}

}  // namespace hedgerow::tool
