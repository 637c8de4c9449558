#pragma once

#include <utility>

#include <gtest/gtest.h>

#include "hedgerow/decimate.h"

namespace hedgerow::test {

/// What is left of a mesh that can be decimated.
[[nodiscard]] inline DecimateOutput decimated(const Connectivity& mesh, const Positions& positions,
                                              const DecimateOptions& options) {
  auto output = decimate(mesh, positions, options, Execution::serial());
  EXPECT_TRUE(output);
  return std::move(*output);
}

[[nodiscard]] inline Positions positions_of(const DecimateOutput& output) {
  return {output.positions.data(), output.mesh.vertex_count()};
}

}  // namespace hedgerow::test
