#include "build/corner_source.h"

#include <algorithm>

#include "parallel/parallel.h"

namespace hedgerow::detail {

namespace {

// A fixed number of chunks, so that the partition does not depend on the thread count; each has a
// row of counters of its own, so that no counter is shared.
constexpr Index kMaxChunks = 64;
constexpr Index kMinFacesPerChunk = 1 << 14;

}  // namespace

template <class Loose>
PartitionSource<Loose>::PartitionSource(const kernels::FaceColumns& faces, const Blocks& blocks,
                                        std::span<Loose> memory, BuildScratch& scratch,
                                        const Execution& execution)
    : first_(grown(scratch.loose_first, blocks.count + 1)), loose_(memory) {
  const Index wanted = faces.face_count / kMinFacesPerChunk;
  const Index chunk_count = std::clamp(wanted, Index{1}, kMaxChunks);
  const Index length = (faces.face_count + chunk_count - 1) / chunk_count;
  const auto row = static_cast<std::size_t>(blocks.count);
  const std::span<Index> ends = grown(scratch.chunk_ends, blocks.count * chunk_count);
  std::fill(ends.begin(), ends.end(), Index{0});
  const auto chunk = [&](Index c) {
    return IndexRange{std::min(faces.face_count, c * length),
                      std::min(faces.face_count, (c + 1) * length)};
  };
  const auto row_of = [&](Index c) { return ends.data() + static_cast<std::size_t>(c) * row; };

  par::for_each_task(execution, chunk_count, [&](Index c, Index) {
    kernels::count_blocks(chunk(c), faces, blocks.shift, row_of(c));
  });
  Index sum = 0;
  for (std::size_t b = 0; b < row; ++b) {
    first_[b] = sum;
    for (Index c = 0; c < chunk_count; ++c) sum += std::exchange(row_of(c)[b], sum);
  }
  first_[row] = sum;
  par::for_each_task(execution, chunk_count, [&](Index c, Index) {
    kernels::partition_corners(chunk(c), faces, blocks.shift, row_of(c), loose_.data());
  });
}

template class PartitionSource<kernels::LooseCorner>;
template class PartitionSource<kernels::LooseTriangleCorner>;

FaceId face_of(const kernels::FaceColumns& faces, HalfedgeId h) noexcept {
  if (faces.is_triangles()) return FaceId(h.value / 3);
  const Index* end = faces.first + faces.face_count + 1;
  const Index* after = std::upper_bound(faces.first, end, h.value);
  return FaceId(static_cast<Index>(after - faces.first) - 1);
}

}  // namespace hedgerow::detail
