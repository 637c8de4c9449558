#include "hedgerow/face_list.h"

namespace hedgerow {

namespace {

Result<void> check_offsets(const FaceList& faces) {
  if (faces.offsets[0] != 0) return fail({ErrorCode::bad_face_offsets, 0, faces.offsets[0], 0});
  for (std::int64_t f = 0; f < faces.face_count; ++f) {
    if (faces.offsets[f + 1] < faces.offsets[f]) {
      return fail({ErrorCode::bad_face_offsets, static_cast<Index>(f), faces.offsets[f + 1],
                   faces.offsets[f]});
    }
  }
  return {};
}

}  // namespace

Result<void> check(const FaceList& faces) {
  const auto limit = static_cast<std::int64_t>(kMaxCount);
  if (faces.face_count < 0 || faces.face_count > limit) {
    return fail({ErrorCode::too_many_elements, kInvalidIndex, faces.face_count, limit});
  }
  if (faces.vertex_count < 0 || faces.vertex_count > limit) {
    return fail({ErrorCode::too_many_elements, kInvalidIndex, faces.vertex_count, limit});
  }
  if (faces.is_triangles() && faces.face_count > limit / 3) {
    return fail({ErrorCode::too_many_elements, kInvalidIndex, faces.face_count, limit / 3});
  }
  if (!faces.is_triangles()) {
    if (const auto offsets = check_offsets(faces); !offsets) return offsets;
  }
  if (faces.corner_count() == 0) return {};
  if (faces.corners == nullptr) return fail({ErrorCode::null_pointer});
  const std::size_t index_bytes = size_bytes(faces.format);
  const std::size_t least = (faces.is_triangles() ? 3 : 1) * index_bytes;
  if (faces.stride_bytes < least || faces.stride_bytes % index_bytes != 0) {
    return fail({ErrorCode::bad_stride, kInvalidIndex,
                 static_cast<std::int64_t>(faces.stride_bytes), static_cast<std::int64_t>(least)});
  }
  return {};
}

}  // namespace hedgerow
