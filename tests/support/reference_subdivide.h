#pragma once

#include <vector>

#include "hedgerow/subdivide.h"
#include "support/reference_mesh.h"

namespace hedgerow::test {

struct ReferenceSubdivision {
  PlainFaces faces;
  std::vector<float> xyz;
  std::vector<float> sharpness;
};

/// One level, from ordered maps and searches over the whole mesh; `level` from 0.
[[nodiscard]] ReferenceSubdivision reference_subdivide(const PlainFaces& list,
                                                       const std::vector<float>& xyz,
                                                       const std::vector<float>& sharpness,
                                                       SubdivisionScheme scheme, int level);

}  // namespace hedgerow::test
