#pragma once

#include "kernels/face_columns.h"

namespace hedgerow::kernels {

/// Polygons of a higher degree are not searched for a repeated vertex pair by pair.
inline constexpr Index kPairwiseDegree = 32;

struct FaceCheck {
  Index bad_count = 0;  ///< faces with an index out of range, too few corners or a repeated vertex
  Index large_count = 0;  ///< good so far, but of more than kPairwiseDegree corners

  friend FaceCheck operator+(FaceCheck a, FaceCheck b) noexcept {
    return {a.bad_count + b.bad_count, a.large_count + b.large_count};
  }
};

/// Counts the faces in `range` that connectivity cannot hold. Reads 4 bytes a corner.
[[nodiscard]] FaceCheck check_faces(IndexRange range, const FaceColumns& faces) noexcept;

/// Which blocks of 2^block_shift vertices a run of faces touches.
struct RunBlocks {
  static constexpr Index kCapacity = 15;
  Index count = 0;  ///< kCapacity + 1: more than `block` can hold
  Index block[kCapacity];
};

/// As `check_faces`, and fills `runs[r]` for each run r of `run_length` faces in `range` (of runs).
/// Runs write disjoint elements. A run with a bad face may list blocks that do not exist.
[[nodiscard]] FaceCheck check_runs(IndexRange range, const FaceColumns& faces, Index run_length,
                                   int block_shift, RunBlocks* runs) noexcept;

/// The plain form that the fast one is tested against.
[[nodiscard]] FaceCheck check_runs_scalar(IndexRange range, const FaceColumns& faces,
                                          Index run_length, int block_shift,
                                          RunBlocks* runs) noexcept;

/// Four 32-bit triangles at a time. False: not in this build, nothing was done.
[[nodiscard]] bool check_triangle_runs_sse(IndexRange range, const FaceColumns& faces,
                                           Index run_length, int block_shift, RunBlocks* runs,
                                           FaceCheck& check) noexcept;

/// Eight triangles at a time. \pre `has_avx2()`
[[nodiscard]] FaceCheck check_triangle_runs_avx2(IndexRange range, const FaceColumns& faces,
                                                 Index run_length, int block_shift,
                                                 RunBlocks* runs) noexcept;

// Shared by them.
[[nodiscard]] FaceCheck check_face(const FaceColumns& faces, Index f) noexcept;
void add_blocks(const FaceColumns& faces, IndexRange range, int block_shift,
                RunBlocks& run) noexcept;

}  // namespace hedgerow::kernels
