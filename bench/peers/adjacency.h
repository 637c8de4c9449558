#pragma once

#include <cstdint>
#include <span>

#include "hedgerow/face_list.h"
#include "hedgerow/positions.h"

namespace hedgerow::bench {

/// meshoptimizer's triangle adjacency buffer: six vertices a triangle, of which number 2k + 1 is
/// the vertex across the edge that leaves corner k. The nearest that library has to `opposite`.
/// Present only if CMake found it. \pre native triangles of 32-bit indices, out.size() == 6 *
/// faces.face_count.
void fill_adjacency_buffer(const FaceList& faces, Positions positions,
                           std::span<std::uint32_t> out);

}  // namespace hedgerow::bench
