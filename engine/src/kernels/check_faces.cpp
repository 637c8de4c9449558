#include "kernels/check_faces.h"

#include <algorithm>
#include <type_traits>

#include "kernels/simd_path.h"

namespace hedgerow::kernels {

namespace {

// One comparison catches negative and too large.
bool in_range(Index v, Index vertex_count) noexcept {
  using Unsigned = std::make_unsigned_t<Index>;
  return static_cast<Unsigned>(v) < static_cast<Unsigned>(vertex_count);
}

bool is_bad_triangle(const Index* c, Index vertex_count) noexcept {
  return !in_range(c[0], vertex_count) || !in_range(c[1], vertex_count) ||
         !in_range(c[2], vertex_count) || c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
}

FaceCheck check_polygon(const Index* c, Index degree, Index vertex_count) noexcept {
  if (degree < 3) return {1, 0};
  for (Index i = 0; i < degree; ++i) {
    if (!in_range(c[i], vertex_count)) return {1, 0};
  }
  if (degree > kPairwiseDegree) return {0, 1};
  for (Index i = 1; i < degree; ++i) {
    if (std::find(c, c + i, c[i]) != c + i) return {1, 0};
  }
  return {};
}

// The most recent block is the likeliest, so the search runs backwards.
void add_block(RunBlocks& run, Index block) noexcept {
  if (run.count > RunBlocks::kCapacity) return;
  for (Index i = run.count; i-- > 0;) {
    if (run.block[i] == block) return;
  }
  if (run.count < RunBlocks::kCapacity) run.block[run.count] = block;
  ++run.count;
}

}  // namespace

FaceCheck check_face(const FaceColumns& faces, Index f) noexcept {
  if (faces.is_triangles()) {
    return {is_bad_triangle(faces.corners + 3 * f, faces.vertex_count), 0};
  }
  return check_polygon(faces.corners + faces.first[f], faces.degree(f), faces.vertex_count);
}

FaceCheck check_faces(IndexRange range, const FaceColumns& faces) noexcept {
  FaceCheck sum;
  for (Index f = range.begin; f < range.end; ++f) sum = sum + check_face(faces, f);
  return sum;
}

void add_blocks(const FaceColumns& faces, IndexRange range, int block_shift,
                RunBlocks& run) noexcept {
  // A strip of triangles along the seam of two blocks goes to and fro between them.
  Index last = kInvalidIndex;
  Index before = kInvalidIndex;
  for (Index h = faces.begin(range.begin); h < faces.begin(range.end); ++h) {
    const Index block = faces.corners[h] >> block_shift;
    if (block == last || block == before) continue;
    before = last;
    last = block;
    add_block(run, block);
  }
}

FaceCheck check_runs_scalar(IndexRange range, const FaceColumns& faces, Index run_length,
                            int block_shift, RunBlocks* runs) noexcept {
  FaceCheck sum;
  for (Index r = range.begin; r < range.end; ++r) {
    const Index begin = r * run_length;
    const IndexRange run = {begin, std::min(faces.face_count, begin + run_length)};
    runs[r].count = 0;
    sum = sum + check_faces(run, faces);
    add_blocks(faces, run, block_shift, runs[r]);
  }
  return sum;
}

FaceCheck check_runs(IndexRange range, const FaceColumns& faces, Index run_length, int block_shift,
                     RunBlocks* runs) noexcept {
  if (faces.is_triangles() && has_avx2()) {
    return check_triangle_runs_avx2(range, faces, run_length, block_shift, runs);
  }
  FaceCheck check;
  if (faces.is_triangles() &&
      check_triangle_runs_sse(range, faces, run_length, block_shift, runs, check)) {
    return check;
  }
  return check_runs_scalar(range, faces, run_length, block_shift, runs);
}

}  // namespace hedgerow::kernels
