#pragma once

#include <limits>
#include <vector>

#include "hedgerow/connectivity.h"
#include "support/random_faces.h"

/// What the tests of new orders share.
namespace hedgerow::test {

/// Few places, so that some are taken twice; some are none.
[[nodiscard]] inline std::vector<float> random_positions(Index count, Random& random) {
  std::vector<float> xyz;
  for (Index i = 0; i < 3 * count; ++i) {
    xyz.push_back(static_cast<float>(random.below(64)) / 8 - 4);
    if (random.one_in(60)) xyz.back() = std::numeric_limits<float>::quiet_NaN();
    if (random.one_in(60)) xyz.back() = std::numeric_limits<float>::infinity();
  }
  return xyz;
}

/// The vertices of each face, in the order of its corners.
[[nodiscard]] inline std::vector<std::vector<Index>> faces_of(const Connectivity& mesh) {
  return mesh.visit([](const auto& view) {
    std::vector<std::vector<Index>> faces;
    for (Index f = 0; f < view.face_count(); ++f) {
      const Index first = view.first(FaceId(f)).value;
      faces.emplace_back();
      for (Index k = 0; k < view.degree(FaceId(f)); ++k) {
        faces.back().push_back(view.origin[HalfedgeId(first + k)].value);
      }
    }
    return faces;
  });
}

}  // namespace hedgerow::test
