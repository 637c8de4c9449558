#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hedgerow/face_list.h"
#include "hedgerow/positions.h"
#include "kernels/normals_math.h"
#include "kernels/simd_path.h"

/// What the kernels of the normals read and write, in the caller's formats.
namespace hedgerow::kernels {

/// The caller's positions. \pre those that are asked for exist.
struct Points {
  Positions positions;

  [[nodiscard]] Float3 operator[](Index v) const noexcept {
    const float* p = positions[v];
    return {p[0], p[1], p[2]};
  }
};

/// Whether the AVX2 forms may run: the processor has it, and neither the bytes of the positions nor
/// 16 bytes a vertex take more than 32 bits to count.
[[nodiscard]] inline bool suits_avx2(const Points& points) noexcept {
  const Positions& p = points.positions;
  const auto bytes =
      static_cast<std::uint64_t>(p.count) * std::max<std::size_t>(p.stride_bytes, 16);
  return has_avx2() && bytes < (std::uint64_t{1} << 32);
}
[[nodiscard]] inline bool suits_avx512(const Points& points) noexcept {
  return has_avx512() && suits_avx2(points);
}

/// The caller's faces. A corner is a number in [0, corner count), also for triangles.
struct FaceSource {
  FaceList list;
  const Index* native = nullptr;  ///< all corners as packed `Index`; null: another format

  explicit FaceSource(const FaceList& faces) noexcept
      : list(faces),
        native(faces.is_native() ? static_cast<const Index*>(faces.corners) : nullptr) {}

  [[nodiscard]] bool is_triangles() const noexcept { return list.is_triangles(); }
  [[nodiscard]] Index face_count() const noexcept { return static_cast<Index>(list.face_count); }
  [[nodiscard]] Index vertex_count() const noexcept {
    return static_cast<Index>(list.vertex_count);
  }
  [[nodiscard]] Index begin(Index f) const noexcept {
    return list.is_triangles() ? 3 * f : list.offsets[f];
  }
  /// The index as it stands there, in range or not.
  [[nodiscard]] std::int64_t raw_corner(Index c) const noexcept {
    const auto* bytes = static_cast<const std::byte*>(list.corners);
    const auto i = static_cast<std::size_t>(c);
    const std::size_t width = size_bytes(list.format);
    bytes +=
        list.is_triangles() ? i / 3 * list.stride_bytes + i % 3 * width : i * list.stride_bytes;
    switch (list.format) {
      case IndexFormat::int32:
        return *reinterpret_cast<const std::int32_t*>(bytes);
      case IndexFormat::uint32:
        return *reinterpret_cast<const std::uint32_t*>(bytes);
      case IndexFormat::uint16:
        return *reinterpret_cast<const std::uint16_t*>(bytes);
      default:
        return *reinterpret_cast<const std::int64_t*>(bytes);
    }
  }
  /// \pre the index is in range.
  [[nodiscard]] Index corner(Index c) const noexcept {
    return native != nullptr ? native[c] : static_cast<Index>(raw_corner(c));
  }
};

/// Faces converted at a time where the list is not native; small enough for the stack.
inline constexpr Index kPackedFaces = 256;

/// Calls visit(faces, corners) for pieces of `range`, where `corners` are those of the triangles
/// `faces`, packed.
template <class Visit>
void for_each_packed(IndexRange range, const FaceSource& faces, const Visit& visit) noexcept {
  if (faces.native != nullptr) {
    visit(range, faces.native + 3 * static_cast<std::ptrdiff_t>(range.begin));
    return;
  }
  Index packed[3 * kPackedFaces];
  for (Index begin = range.begin; begin < range.end; begin += kPackedFaces) {
    const Index end = range.end - begin < kPackedFaces ? range.end : begin + kPackedFaces;
    for (Index c = 3 * begin; c < 3 * end; ++c) packed[c - 3 * begin] = faces.corner(c);
    visit(IndexRange{begin, end}, packed);
  }
}

/// Sums of counts and the smallest index: exactly associative.
[[nodiscard]] inline NormalStats merge(const NormalStats& a, const NormalStats& b) noexcept {
  const bool a_first =
      b.first_degenerate == kInvalidIndex ||
      (a.first_degenerate != kInvalidIndex && a.first_degenerate < b.first_degenerate);
  return {a.degenerate_count + b.degenerate_count,
          a_first ? a.first_degenerate : b.first_degenerate};
}

/// Writes unit normals, and what the policy says where there is none.
struct NormalWriter {
  NormalsOut out;
  DegeneratePolicy policy = DegeneratePolicy::zero;
  /// Past the caches, where a kernel can: for packed output that they would not hold anyway. Such a
  /// kernel has all its writes done before it returns.
  bool is_streamed = false;

  void write(Index i, Float3 unit) const noexcept {
    float* p = out[i];
    p[0] = unit.x;
    p[1] = unit.y;
    p[2] = unit.z;
  }
  void write_degenerate(Index i, NormalStats& stats) const noexcept {
    stats = merge(stats, {1, i});
    if (policy == DegeneratePolicy::keep) return;
    write(i, {0, 0, policy == DegeneratePolicy::axis ? 1.0f : 0.0f});
  }
};

/// The area vector of any face (twice the area long; wedge_mean: the mean of the cross products);
/// where `unit`, divided by its length.
[[nodiscard]] Wide polygon_vector(const FaceSource& faces, Index f, const Points& points,
                                  PolygonMethod method, bool unit) noexcept;

/// Faces with an index out of range.
struct BadFaces {
  Index first = kInvalidIndex;
  std::int64_t count = 0;
};
[[nodiscard]] BadFaces find_bad_faces(IndexRange faces_range, const FaceSource& faces) noexcept;

/// Smallest and largest index of the corners [begin, end). \pre begin < end
struct CornerBounds {
  std::int64_t smallest;
  std::int64_t largest;
};
[[nodiscard]] CornerBounds corner_bounds(IndexRange corners, const FaceSource& faces) noexcept;
/// The same for `count` packed corners: the plain form, and one for processors with AVX2.
[[nodiscard]] CornerBounds native_bounds_scalar(const Index* corners, Index count) noexcept;
[[nodiscard]] CornerBounds native_bounds_avx2(const Index* corners, Index count) noexcept;

}  // namespace hedgerow::kernels
