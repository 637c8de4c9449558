#include <array>
#include <cstdio>
#include <span>

#include "hedgerow/build.h"
#include "hedgerow/ray/scene.h"
#include "hedgerow/ray/surface.h"

// Sends a ray at a triangle: done when it comes back as the half-edge nearest to where it met.
int main() {
  const std::array<hedgerow::Index, 3> corners = {0, 1, 2};
  const std::array<float, 10> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0};  // one more float: padding
  const auto threads = hedgerow::Execution::current_arena();
  const auto built = hedgerow::build(
      hedgerow::FaceList::triangles(std::span<const hedgerow::Index>(corners), 3), {}, threads);
  const auto device = hedgerow::ray::Device::create();
  if (!built || !device) return 1;
  const auto scene =
      hedgerow::ray::Scene::build(*device, built->mesh, {{xyz.data(), 3}, sizeof xyz}, {}, threads);
  if (!scene) {
    std::puts(hedgerow::name(scene.error().code));
    return 1;
  }
  const auto hit =
      scene->intersect(hedgerow::ray::Ray{.origin = {0.5F, 0.1F, 1}, .direction = {0, 0, -1}});
  if (!hit.valid()) return 1;
  const auto point = scene->primitives().point(hit);
  const hedgerow::HalfedgeId h = hedgerow::ray::nearest_halfedge(built->mesh.triangles(), point);
  return h.value == 0 ? 0 : 1;
}
