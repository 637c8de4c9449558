#pragma once

#include <array>
#include <string>
#include <vector>

#include "hedgerow/build.h"
#include "hedgerow/ray/scene.h"
#include "hedgerow/soup.h"

/// Meshes and rays for the ray tests, and slow answers to compare with.
namespace hedgerow::test {

struct RayMesh {
  std::string name;
  Soup soup;
  Connectivity mesh;

  RayMesh(std::string called, Soup&& faces);
};

[[nodiscard]] Result<ray::Scene> scene_of(const RayMesh& subject,
                                          const ray::SceneOptions& options = {},
                                          const Execution& execution = Execution::serial());

/// Triangles, quads, and faces of three to eight corners, some of them concave, in one plane.
[[nodiscard]] std::vector<RayMesh> ray_meshes();
/// Rows of triangles, quads, hexagons and L-shaped faces of eight corners, in a tilted plane.
[[nodiscard]] Soup mixed_plane(Index rows);

/// Three vertices, and the face that they are cut from.
struct FaceTriangle {
  FaceId face;
  std::array<Index, 3> vertices;
};
/// Every face as triangles: quads as 0 1 3 and 2 3 1, convex larger ones as fans.
[[nodiscard]] std::vector<FaceTriangle> triangles_of(const Soup& soup);

/// Rays from a sphere round the mesh to points in its box, from a seed; some of them miss.
[[nodiscard]] std::vector<ray::Ray> random_rays(const Soup& soup, int count, unsigned seed);
[[nodiscard]] std::vector<ray::Vec3> random_points(const Soup& soup, int count, unsigned seed);

/// Where a ray meets a triangle, in double.
struct SlowHit {
  double t = 0;
  FaceId face;
  double margin = 0;  ///< smallest weight of a corner: near 0 the ray passes along an edge
};
/// All of them with weights above -1e-4, in the order of t.
[[nodiscard]] std::vector<SlowHit> slow_hits(const Soup& soup,
                                             const std::vector<FaceTriangle>& triangles,
                                             const ray::Ray& ray);

/// The squared distance from a point to a triangle by trying its inside, edges and corners.
[[nodiscard]] double slow_squared_distance(const std::array<std::array<double, 3>, 3>& corners,
                                           const std::array<double, 3>& from);

/// The length of the diagonal of the box of all vertices.
[[nodiscard]] double diagonal_of(const Soup& soup);

}  // namespace hedgerow::test
