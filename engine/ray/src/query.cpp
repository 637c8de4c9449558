#include <algorithm>
#include <cmath>

#include "closest_triangle.h"
#include "scene_impl.h"

namespace hedgerow::ray {
namespace {

RTCRay embree_ray(const Ray& ray) noexcept {
  RTCRay out{};
  out.org_x = ray.origin[0];
  out.org_y = ray.origin[1];
  out.org_z = ray.origin[2];
  out.tnear = ray.near;
  out.dir_x = ray.direction[0];
  out.dir_y = ray.direction[1];
  out.dir_z = ray.direction[2];
  out.tfar = ray.far;
  out.mask = ~0U;
  return out;
}

bool has_nan(const Ray& ray) noexcept {
  float sum = ray.near + ray.far;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::isnan(ray.origin[axis]) || std::isnan(ray.direction[axis])) return true;
  }
  return std::isnan(sum);
}

bool has_nan(const RayPacket& rays, std::size_t lane) noexcept {
  Ray ray;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ray.origin[axis] = rays.origin[axis][lane];
    ray.direction[axis] = rays.direction[axis][lane];
  }
  ray.near = rays.near[lane];
  ray.far = rays.far[lane];
  return has_nan(ray);
}

void copy_lanes(float* out, const RayPacket::Lanes& lanes) noexcept {
  std::copy(lanes.begin(), lanes.end(), out);
}

/// Fills in the rays, and -1 for the lanes that are to be traced.
void fill_packet(const RayPacket& rays, RTCRay8& out, int* valid) noexcept {
  copy_lanes(out.org_x, rays.origin[0]);
  copy_lanes(out.org_y, rays.origin[1]);
  copy_lanes(out.org_z, rays.origin[2]);
  copy_lanes(out.dir_x, rays.direction[0]);
  copy_lanes(out.dir_y, rays.direction[1]);
  copy_lanes(out.dir_z, rays.direction[2]);
  copy_lanes(out.tnear, rays.near);
  copy_lanes(out.tfar, rays.far);
  for (std::size_t lane = 0; lane < RayPacket::kLanes; ++lane) {
    out.time[lane] = 0;
    out.mask[lane] = ~0U;
    out.id[lane] = static_cast<unsigned>(lane);
    out.flags[lane] = 0;
    valid[lane] = static_cast<int>(lane) < rays.count && !has_nan(rays, lane) ? -1 : 0;
  }
}

/// A closest-point query under way.
struct Search {
  const Scene::Impl& scene;
  PrimitiveMap map;
  Point from;
  double best_squared;
  Index best_primitive = kInvalidIndex;
  int best_part = 0;
  TrianglePoint best_point{};

  [[nodiscard]] std::array<Point, 3> corners(const std::array<HalfedgeId, 3>& at) const noexcept {
    std::array<Point, 3> points;
    for (std::size_t k = 0; k < 3; ++k) {
      const float* xyz = scene.positions[scene.origin[at[k].value]];
      points[k] = {xyz[0], xyz[1], xyz[2]};
    }
    return points;
  }

  /// Of points equally close the one of the smallest primitive wins, so that the order in which
  /// the tree offers them does not show.
  void visit(Index primitive) noexcept {
    for (int part = 0; part < map.triangle_count(primitive); ++part) {
      const std::array<Point, 3> triangle = corners(map.triangle(primitive, part));
      const TrianglePoint point = closest_on_triangle(triangle, from);
      const double squared = detail::squared_distance(triangle, point, from);
      const bool is_first = best_primitive == kInvalidIndex || primitive < best_primitive ||
                            (primitive == best_primitive && part < best_part);
      if (squared < best_squared || (squared == best_squared && is_first)) {
        best_squared = squared;
        best_primitive = primitive;
        best_part = part;
        best_point = point;
      }
    }
  }
};

/// Embree offers each primitive whose box is within the radius, and some that are not.
bool visit_primitive(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<Search*>(arguments->userPtr);
  search.visit(search.scene.primitive_of(arguments->geomID, arguments->primID));
  // A little more than the distance: Embree compares in float, and ties have to be offered, too.
  const auto radius = static_cast<float>(std::sqrt(search.best_squared) * (1 + 1e-5));
  if (search.best_primitive == kInvalidIndex || !(radius < arguments->query->radius)) return false;
  arguments->query->radius = radius;
  return true;
}

/// Whether edge k of a triangle is an edge of its face, and no diagonal.
bool is_edge_of_face(const Search& search, const std::array<HalfedgeId, 3>& corners,
                     int edge) noexcept {
  const Primitives& primitives = search.scene.primitives;
  if (primitives.sides == 3) return true;
  // The two triangles of a quad, 0 1 3 and 2 3 1, have the diagonal in the same place.
  if (search.map.triangle_count(search.best_primitive) == 2) return edge != 1;
  const HalfedgeId start = corners[static_cast<std::size_t>(edge)];
  const HalfedgeId end = corners[static_cast<std::size_t>((edge + 1) % 3)];
  return primitives.next_of[start.value] == end.value;
}

ClosestPoint found(const Search& search) noexcept {
  ClosestPoint closest;
  if (search.best_primitive == kInvalidIndex) return closest;
  closest.distance = std::sqrt(search.best_squared);
  closest.surface.corners = search.map.triangle(search.best_primitive, search.best_part);
  const TrianglePoint& point = search.best_point;
  const std::array<Point, 3> triangle = search.corners(closest.surface.corners);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    closest.surface.weights[axis] = static_cast<float>(point.weights[axis]);
    closest.position[axis] = static_cast<float>(triangle[0][axis] * point.weights[0] +
                                                triangle[1][axis] * point.weights[1] +
                                                triangle[2][axis] * point.weights[2]);
  }
  closest.halfedge = closest.surface.corners[0];
  if (point.corner >= 0) {
    closest.feature = Feature::vertex;
    closest.halfedge = closest.surface.corners[static_cast<std::size_t>(point.corner)];
  } else if (point.edge >= 0 && is_edge_of_face(search, closest.surface.corners, point.edge)) {
    closest.feature = Feature::edge;
    closest.halfedge = closest.surface.corners[static_cast<std::size_t>(point.edge)];
  }
  return closest;
}

}  // namespace

Hit Scene::intersect(const Ray& ray, Coherence coherence) const noexcept {
  if (has_nan(ray)) return {};
  RTCRayHit query;
  query.ray = embree_ray(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  embree::Query(coherence).intersect(impl_->scene, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {query.ray.tfar, query.hit.u, query.hit.v,
          impl_->primitive_of(query.hit.geomID, query.hit.primID)};
}

bool Scene::is_occluded(const Ray& ray, Coherence coherence) const noexcept {
  if (has_nan(ray)) return false;
  RTCRay query = embree_ray(ray);
  embree::Query(coherence).occluded(impl_->scene, query);
  return query.tfar < 0;  // minus infinity says yes
}

HitPacket Scene::intersect(const RayPacket& rays, Coherence coherence) const noexcept {
  RTCRayHit8 query;
  alignas(32) std::array<int, RayPacket::kLanes> valid;
  fill_packet(rays, query.ray, valid.data());
  std::fill_n(query.hit.geomID, RayPacket::kLanes, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(query.hit.instID[0], RayPacket::kLanes, RTC_INVALID_GEOMETRY_ID);
  embree::Query(coherence).intersect(valid.data(), impl_->scene, query);
  HitPacket hits;
  for (std::size_t lane = 0; lane < RayPacket::kLanes; ++lane) {
    if (valid[lane] == 0 || query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
    hits[lane] = {query.ray.tfar[lane], query.hit.u[lane], query.hit.v[lane],
                  impl_->primitive_of(query.hit.geomID[lane], query.hit.primID[lane])};
  }
  return hits;
}

OccludedPacket Scene::is_occluded(const RayPacket& rays, Coherence coherence) const noexcept {
  RTCRay8 query;
  alignas(32) std::array<int, RayPacket::kLanes> valid;
  fill_packet(rays, query, valid.data());
  embree::Query(coherence).occluded(valid.data(), impl_->scene, query);
  OccludedPacket occluded{};
  for (std::size_t lane = 0; lane < RayPacket::kLanes; ++lane) {
    occluded[lane] = valid[lane] != 0 && query.tfar[lane] < 0;
  }
  return occluded;
}

ClosestPoint Scene::closest_point(const Vec3& from, float radius) const noexcept {
  for (const float coordinate : from) {
    if (!std::isfinite(coordinate)) return {};
  }
  if (!(radius >= 0)) return {};
  const double limit = radius;
  Search search{*impl_, impl_->primitives.map(), {from[0], from[1], from[2]}, limit * limit};
  RTCPointQuery query{};
  query.x = from[0];
  query.y = from[1];
  query.z = from[2];
  query.radius = radius * (1 + 1e-5F);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(impl_->scene, &query, &context, visit_primitive, &search);
  return found(search);
}

}  // namespace hedgerow::ray
