#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hedgerow/index.h"
#include "hedgerow/result.h"

namespace hedgerow {

/// How the caller stores vertex indices.
enum class IndexFormat : std::uint8_t { int32, uint32, uint16, int64 };

[[nodiscard]] constexpr std::size_t size_bytes(IndexFormat format) noexcept {
  return format == IndexFormat::uint16 ? 2 : format == IndexFormat::int64 ? 8 : 4;
}
/// The format that `Index` itself has.
inline constexpr IndexFormat kNativeFormat =
    sizeof(Index) == 8 ? IndexFormat::int64 : IndexFormat::int32;

/// Faces as the caller has them: triangles, or polygons of any degree mixed. Owns nothing.
///
/// Layout     Triangles: the three corners of face f are adjacent, and faces lie `stride_bytes`
///            apart (so a record may carry more than its corners). Polygons: the corners of face f
///            are numbers offsets[f] .. offsets[f + 1] - 1, and corners lie `stride_bytes` apart.
///            `offsets` has face_count + 1 entries, starts at 0 and never decreases.
/// Alignment  That of the index type.
/// Lifetime   The arrays must outlive the call that the list is passed to, and the mesh where the
///            build borrows them.
struct FaceList {
  const void* corners = nullptr;
  IndexFormat format = kNativeFormat;
  std::size_t stride_bytes = 0;
  const Index* offsets = nullptr;  ///< null: all faces are triangles
  std::int64_t face_count = 0;
  std::int64_t vertex_count = 0;

  [[nodiscard]] bool is_triangles() const noexcept { return offsets == nullptr; }
  [[nodiscard]] std::int64_t corner_count() const noexcept {
    return is_triangles() ? 3 * face_count : static_cast<std::int64_t>(offsets[face_count]);
  }
  /// The numbers of the corners of face f. \pre 0 <= f < face_count, and `check` found no error.
  [[nodiscard]] IndexRange corner_range(std::int64_t f) const noexcept {
    if (!is_triangles()) return {offsets[f], offsets[f + 1]};
    return {static_cast<Index>(3 * f), static_cast<Index>(3 * f + 3)};
  }
  /// True if `corners` can serve as an `origin` column as it is: packed and as wide as `Index`.
  [[nodiscard]] bool is_native() const noexcept {
    const bool same_width = size_bytes(format) == sizeof(Index);
    return same_width && stride_bytes == (is_triangles() ? 3 : 1) * sizeof(Index);
  }

  /// Packed triangles. \pre corners.size() is a multiple of 3.
  template <class Integer>
  [[nodiscard]] static FaceList triangles(std::span<const Integer> corners,
                                          std::int64_t vertex_count) noexcept {
    return {corners.data(),
            format_of<Integer>(),
            3 * sizeof(Integer),
            nullptr,
            static_cast<std::int64_t>(corners.size() / 3),
            vertex_count};
  }
  /// Packed polygons. \pre offsets is not empty.
  template <class Integer>
  [[nodiscard]] static FaceList polygons(std::span<const Integer> corners,
                                         std::span<const Index> offsets,
                                         std::int64_t vertex_count) noexcept {
    return {corners.data(),
            format_of<Integer>(),
            sizeof(Integer),
            offsets.data(),
            static_cast<std::int64_t>(offsets.size()) - 1,
            vertex_count};
  }

 private:
  template <class Integer>
  static constexpr IndexFormat format_of() noexcept {
    static_assert(std::is_same_v<Integer, std::int32_t> || std::is_same_v<Integer, std::uint32_t> ||
                  std::is_same_v<Integer, std::uint16_t> || std::is_same_v<Integer, std::int64_t>);
    if constexpr (std::is_same_v<Integer, std::uint16_t>) return IndexFormat::uint16;
    if constexpr (std::is_same_v<Integer, std::uint32_t>) return IndexFormat::uint32;
    if constexpr (std::is_same_v<Integer, std::int64_t>) return IndexFormat::int64;
    return IndexFormat::int32;
  }
};

/// Checks addresses, strides, counts and that the offsets never decrease; not the indices.
/// Complexity O(1) for triangles, O(F) for polygons. On the calling thread.
/// Errors     null_pointer, bad_stride, too_many_elements, bad_face_offsets.
[[nodiscard]] Result<void> check(const FaceList& faces);

}  // namespace hedgerow
