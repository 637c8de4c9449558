#pragma once

#include "float3_check.h"
#include "hedgerow/normals.h"
#include "kernels/normals_source.h"

/// What every operation on normals checks at the door.
namespace hedgerow::detail {

[[nodiscard]] inline Result<void> check_arrays(const Positions& positions,
                                               std::int64_t vertex_count, const NormalsOut& out,
                                               std::int64_t out_count) noexcept {
  if (auto ok = check_float3(positions, vertex_count); !ok) return ok;
  return check_float3(out, out_count);
}

/// Packed normals of so many bytes are written past the caches. A plain store first reads the line
/// that it overwrites; a streamed one does not, but who reads the normals next finds them in no
/// cache, so the limit is a size that few caches hold along with what else the caller works on.
inline constexpr std::int64_t kStreamedBytes = std::int64_t{1} << 24U;

[[nodiscard]] inline kernels::NormalWriter normal_writer(const NormalsOut& out, std::int64_t count,
                                                         DegeneratePolicy policy) noexcept {
  constexpr std::int64_t kPacked = sizeof(float[3]);
  return {
      out, policy,
      out.stride_bytes == static_cast<std::size_t>(kPacked) && count * kPacked >= kStreamedBytes};
}

/// The error for faces with an index out of range.
[[nodiscard]] inline Error bad_index(const kernels::FaceSource& faces,
                                     const kernels::BadFaces& bad) noexcept {
  Error error{ErrorCode::index_out_of_range, bad.first, 0, faces.list.vertex_count, bad.count};
  for (Index c = faces.begin(bad.first); c < faces.begin(bad.first + 1); ++c) {
    error.value = faces.raw_corner(c);
    if (error.value < 0 || error.value >= error.limit) break;
  }
  return error;
}

/// The largest number of bad faces is of no interest where there is none, so this is called only
/// once some corner is known to be out of range.
[[nodiscard]] inline Error find_bad_index(const kernels::FaceSource& faces) noexcept {
  return bad_index(faces, kernels::find_bad_faces({0, faces.face_count()}, faces));
}

}  // namespace hedgerow::detail
