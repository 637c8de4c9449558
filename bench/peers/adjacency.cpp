#include "peers/adjacency.h"

#include <meshoptimizer.h>

namespace hedgerow::bench {

void fill_adjacency_buffer(const FaceList& faces, Positions positions,
                           std::span<std::uint32_t> out) {
  meshopt_generateAdjacencyIndexBuffer(out.data(), static_cast<const std::uint32_t*>(faces.corners),
                                       static_cast<std::size_t>(faces.corner_count()),
                                       positions.data, static_cast<std::size_t>(faces.vertex_count),
                                       positions.stride_bytes);
}

}  // namespace hedgerow::bench
