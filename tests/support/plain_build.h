#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hedgerow/build.h"
#include "hedgerow/positions.h"
#include "hedgerow/soup.h"
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

/// What the engine builds of a soup that it accepts.
[[nodiscard]] inline Connectivity built(const Soup& soup) {
  Result<BuildOutput> output = build(soup.face_list(), {}, Execution::serial());
  EXPECT_TRUE(output);
  return std::move(output->mesh);
}

[[nodiscard]] inline Positions positions_of(const std::vector<float>& xyz) {
  return {xyz.data(), static_cast<std::int64_t>(xyz.size() / 3)};
}

}  // namespace hedgerow::test
