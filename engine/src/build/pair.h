#pragma once

#include <cstdint>
#include <vector>

#include "build/survey.h"
#include "hedgerow/build.h"
#include "kernels/link_vertices.h"

namespace hedgerow::detail {

struct PairOutput {
  Buffer<Index> opposite;
  Buffer<Index> outgoing;
  std::vector<FanStart> fans;   ///< sorted
  std::vector<Defect> defects;  ///< of edges, vertices and (triangles) duplicate faces; sorted
  kernels::LinkStats stats;
  BuildStrategy strategy = BuildStrategy::automatic;
};

/// Pairs all half-edges, block of vertices by block of vertices, and classifies what does not pair.
/// `is_cut`, if not null, marks half-edges that take no part.
/// \pre every face is good: `survey(faces).check.bad_count == 0`.
[[nodiscard]] PairOutput pair_halfedges(const kernels::FaceColumns& faces, const Survey& survey,
                                        const std::uint8_t* is_cut, BuildStrategy strategy,
                                        BuildScratch& scratch, const Execution& execution);

/// By kind, and within a kind by the element that names the defect.
void sort_defects(std::vector<Defect>& defects);

}  // namespace hedgerow::detail
