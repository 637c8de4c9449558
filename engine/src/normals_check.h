#pragma once

#include "hedgerow/normals.h"
#include "kernels/normals_source.h"

/// What every operation on normals checks at the door.
namespace hedgerow::detail {

/// Addresses, strides and counts of one array of float3 with at least `needed` elements.
template <class Array>
[[nodiscard]] Result<void> check_float3(const Array& array, std::int64_t needed) noexcept {
  constexpr auto kLeast = static_cast<std::int64_t>(3 * sizeof(float));
  if (array.count < needed) {
    return fail({ErrorCode::count_mismatch, kInvalidIndex, array.count, needed});
  }
  if (array.stride_bytes < 3 * sizeof(float) || array.stride_bytes % sizeof(float) != 0) {
    return fail({ErrorCode::bad_stride, kInvalidIndex,
                 static_cast<std::int64_t>(array.stride_bytes), kLeast});
  }
  if (needed > 0 && array.data == nullptr) return fail({ErrorCode::null_pointer});
  return {};
}

[[nodiscard]] inline Result<void> check_arrays(const Positions& positions,
                                               std::int64_t vertex_count, const NormalsOut& out,
                                               std::int64_t out_count) noexcept {
  if (auto ok = check_float3(positions, vertex_count); !ok) return ok;
  return check_float3(out, out_count);
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
