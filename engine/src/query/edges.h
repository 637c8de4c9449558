#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "hedgerow/execution.h"
#include "hedgerow/query.h"
#include "hedgerow/topology.h"

namespace hedgerow::detail {

/// The vertices of an edge, a < b.
struct EdgeEnds {
  Index a = 0;
  Index b = 0;

  friend auto operator<=>(const EdgeEnds&, const EdgeEnds&) noexcept = default;
};

/// An edge with some half-edge that has no face across: on the boundary, or cut by the builder.
struct LooseEdge {
  EdgeEnds ends;
  std::int64_t up_count = 0;    ///< half-edges from a to b
  std::int64_t down_count = 0;  ///< from b to a

  [[nodiscard]] std::int64_t halfedge_count() const noexcept { return up_count + down_count; }
};

struct EdgeSurvey {
  std::int64_t pair_count = 0;   ///< edges that are one pair of opposite half-edges and no more
  std::vector<LooseEdge> loose;  ///< all other edges, sorted by their ends
};

template <Topology Mesh>
[[nodiscard]] EdgeSurvey survey_edges(const Mesh& mesh, const Execution& execution);

[[nodiscard]] EdgeCounts counts_of(const EdgeSurvey& survey) noexcept;

}  // namespace hedgerow::detail
