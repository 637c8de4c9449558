#pragma once

#include <vector>

#include "hedgerow/ray/scene.h"
#include "hedgerow/soup.h"

namespace hedgerow::tool {

/// The obvious answer to a ray: every triangle is tried, in double. Quads are the triangles 0 1 3
/// and 2 3 1; larger faces are not known, so meshes with them cannot be checked.
class ReferenceRays {
 public:
  ReferenceRays(const Soup& soup, const Buffer<float>& xyz);

  [[nodiscard]] bool knows_all_faces() const noexcept { return knows_all_faces_; }
  /// How many rays may be tried in about a second.
  [[nodiscard]] std::int64_t affordable_rays() const noexcept;
  /// True if `hit` is the first face on the ray, as far as float can tell: the first one of the
  /// reference, one as near, or any answer where the ray passes along an edge.
  [[nodiscard]] bool accepts(const ray::Ray& ray, const ray::Hit& hit) const;
  /// The same for a question after any face.
  [[nodiscard]] bool accepts(const ray::Ray& ray, bool is_occluded) const;

 private:
  struct Answer {
    double first = 0;          // t of the nearest face that is met clearly; infinite: none
    double first_perhaps = 0;  // the same with those that are met at an edge
  };
  [[nodiscard]] Answer nearest(const ray::Ray& ray) const;

  std::vector<double> corners_;  // nine a triangle
  bool knows_all_faces_ = true;
};

}  // namespace hedgerow::tool
