#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hedgerow/index.h"

/// Rays, and what they meet: plain data, without Embree.
namespace hedgerow::ray {

using Vec3 = std::array<float, 3>;

/// The points origin + t * direction with near <= t <= far. The direction has any length but 0.
struct Ray {
  Vec3 origin{};
  Vec3 direction{};
  float near = 0;
  float far = std::numeric_limits<float>::infinity();
};

/// Where a ray meets a face: `t` in lengths of the direction, `u` and `v` as Embree has them for
/// the primitive. `PrimitiveMap` turns it into half-edges.
struct Hit {
  float t = std::numeric_limits<float>::infinity();
  float u = 0;
  float v = 0;
  Index primitive = kInvalidIndex;  ///< -1: nothing was met

  [[nodiscard]] bool valid() const noexcept { return primitive != kInvalidIndex; }
};

/// Eight rays at a time, coordinate by coordinate. Lanes outside the first `count` are not traced.
struct alignas(32) RayPacket {
  static constexpr std::size_t kLanes = 8;
  using Lanes = std::array<float, kLanes>;

  std::array<Lanes, 3> origin{};
  std::array<Lanes, 3> direction{};
  Lanes near{};
  Lanes far{};
  int count = kLanes;

  void set(std::size_t lane, const Ray& ray) noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin[axis][lane] = ray.origin[axis];
      direction[axis][lane] = ray.direction[axis];
    }
    near[lane] = ray.near;
    far[lane] = ray.far;
  }
};

using HitPacket = std::array<Hit, RayPacket::kLanes>;
using OccludedPacket = std::array<bool, RayPacket::kLanes>;

/// What the tracer may expect of rays that follow each other; changes its speed, not its answers.
enum class Coherence : std::uint8_t { incoherent, coherent };

/// A point of the surface: three half-edges of one face, leaving the corners of the triangle that
/// the point lies in, counter-clockwise, and how much of each corner there is in it.
///
/// The weights sum up to 1. For a triangle, corners[k] is half-edge k of the face. Of a larger face
/// it is one of the triangles that the face is cut into.
struct SurfacePoint {
  std::array<HalfedgeId, 3> corners{};
  Vec3 weights{};
};

/// From primitives of a scene to half-edges: arithmetic for meshes of triangles only and of quads
/// only; otherwise one entry of a table.
///
/// Threads    Any number of readers.
/// Lifetime   Valid until the scene is destroyed.
class PrimitiveMap {
 public:
  PrimitiveMap() noexcept = default;
  /// Half-edges of primitive p: sides * p .. sides * p + sides - 1.
  explicit PrimitiveMap(Index sides) noexcept : sides_(sides) {}
  /// Half-edges of primitive p: corners[4 p .. 4 p + 3], the last two equal where it is a triangle.
  explicit PrimitiveMap(const Index* corners) noexcept : corners_(corners) {}

  /// The half-edge that leaves corner k of the primitive.
  [[nodiscard]] HalfedgeId corner(Index primitive, Index k) const noexcept {
    if (corners_ == nullptr) return HalfedgeId(sides_ * primitive + k);
    return HalfedgeId(corners_[4 * primitive + k]);
  }
  /// Triangles that the primitive consists of, 1 or 2: corners 0 1 3 and 2 3 1 of a quad.
  [[nodiscard]] int triangle_count(Index primitive) const noexcept {
    if (corners_ == nullptr) return sides_ == 3 ? 1 : 2;
    return corners_[4 * primitive + 2] == corners_[4 * primitive + 3] ? 1 : 2;
  }
  /// \pre 0 <= part < triangle_count(primitive)
  [[nodiscard]] std::array<HalfedgeId, 3> triangle(Index primitive, int part) const noexcept {
    if (corners_ == nullptr && sides_ == 3) {
      return {corner(primitive, 0), corner(primitive, 1), corner(primitive, 2)};
    }
    if (part == 0) return {corner(primitive, 0), corner(primitive, 1), corner(primitive, 3)};
    return {corner(primitive, 2), corner(primitive, 3), corner(primitive, 1)};
  }
  /// \pre hit.valid()
  [[nodiscard]] SurfacePoint point(const Hit& hit) const noexcept {
    const float rest = 1 - hit.u - hit.v;
    if (rest >= 0 || triangle_count(hit.primitive) == 1) {
      return {triangle(hit.primitive, 0), {rest, hit.u, hit.v}};
    }
    return {triangle(hit.primitive, 1), {-rest, 1 - hit.u, 1 - hit.v}};
  }

 private:
  const Index* corners_ = nullptr;
  Index sides_ = 3;
};

/// What a closest point lies on: inside a face, inside an edge, or at a vertex.
enum class Feature : std::uint8_t { face, edge, vertex };

/// The point of the surface that is closest to a given one.
struct ClosestPoint {
  double distance = std::numeric_limits<double>::infinity();
  Vec3 position{};
  SurfacePoint surface{};
  Feature feature = Feature::face;
  /// On an edge: the half-edge of the face found along it. At a vertex: the one of that face that
  /// leaves the vertex. Inside a face: its first corner's.
  HalfedgeId halfedge{};

  [[nodiscard]] bool valid() const noexcept { return halfedge.valid(); }
};

}  // namespace hedgerow::ray
