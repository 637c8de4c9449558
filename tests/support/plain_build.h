#pragma once

#include <span>
#include <vector>

#include "hedgerow/build.h"
#include "support/reference_mesh.h"

namespace hedgerow::test {

/// What the engine builds of these faces, as triangles if all of them are. \pre no negative index
inline Result<BuildOutput> build_plain(const PlainFaces& list, const Policies& policies = {}) {
  std::vector<Index> corners;
  std::vector<Index> offsets = {0};
  bool is_triangles = true;
  for (const auto& face : list.faces) {
    for (const std::int64_t v : face) corners.push_back(static_cast<Index>(v));
    offsets.push_back(static_cast<Index>(corners.size()));
    is_triangles &= face.size() == 3;
  }
  const std::span<const Index> all(corners);
  BuildOptions options;
  options.policies = policies;
  return build(is_triangles ? FaceList::triangles<Index>(all, list.vertex_count)
                            : FaceList::polygons<Index>(all, offsets, list.vertex_count),
               options, Execution::serial());
}

}  // namespace hedgerow::test
