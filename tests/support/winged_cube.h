#pragma once

#include <cstddef>

#include "hedgerow/winged_edge.h"

namespace hedgerow::test {

/// The worked table of a cube; numbers from 1 as printed: start, end, prev and next cw, prev and
/// next ccw, face cw and ccw.
inline constexpr int kWingedCube[12][8] = {
    {1, 2, 4, 2, 10, 9, 1, 4},  {2, 3, 1, 3, 11, 10, 1, 6}, {3, 4, 2, 4, 12, 11, 1, 3},
    {4, 1, 3, 1, 9, 12, 1, 5},  {5, 6, 8, 6, 9, 10, 2, 4},  {6, 7, 5, 7, 12, 9, 2, 5},
    {7, 8, 6, 8, 11, 12, 2, 3}, {8, 5, 7, 5, 10, 11, 2, 6}, {1, 6, 1, 5, 6, 4, 4, 5},
    {5, 2, 5, 1, 2, 8, 4, 6},   {3, 8, 3, 7, 8, 2, 3, 6},   {7, 4, 7, 3, 4, 6, 3, 5}};
inline constexpr int kWingedCubeFaces[6] = {1, 5, 11, 9, 4, 8};  ///< vertex i is at edge i
/// V1 V2 V3 V4 counter-clockwise from outside at z = 0, and the four others below or above them.
inline constexpr float kWingedCubeXyz[24] = {0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1,
                                             1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0};

inline WingedEdgeTables winged_cube() {
  WingedEdgeTables cube{Buffer<float>::copy_of(kWingedCubeXyz), Buffer<EdgeId>(8),
                        Buffer<EdgeId>(6), Buffer<WingedEdge>(12)};
  for (std::size_t v = 0; v < 8; ++v) cube.vertex_edge[v] = EdgeId(static_cast<Index>(v));
  for (std::size_t f = 0; f < 6; ++f) cube.face_edge[f] = EdgeId(kWingedCubeFaces[f] - 1);
  for (std::size_t e = 0; e < 12; ++e) {
    const auto& row = kWingedCube[e];
    cube.edges[e] = {VertexId(row[0] - 1), VertexId(row[1] - 1), EdgeId(row[2] - 1),
                     EdgeId(row[3] - 1),   EdgeId(row[4] - 1),   EdgeId(row[5] - 1),
                     FaceId(row[6] - 1),   FaceId(row[7] - 1)};
  }
  return cube;
}

}  // namespace hedgerow::test
