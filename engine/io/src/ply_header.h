#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "failure.h"

namespace hedgerow::io {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

[[nodiscard]] constexpr std::size_t size_bytes(PlyType type) noexcept {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}
[[nodiscard]] constexpr bool is_integer(PlyType type) noexcept {
  return type != PlyType::f32 && type != PlyType::f64;
}

/// What a property is to the mesh.
enum class PlyMeaning : std::uint8_t { skipped, x, y, z, vertex_indices };

struct PlyProperty {
  std::string_view name;
  PlyType type{};  ///< of the value, or of the items of a list
  bool is_list = false;
  PlyType count_type{};  ///< lists only
  PlyMeaning meaning = PlyMeaning::skipped;
};

enum class PlyElementKind : std::uint8_t { skipped, vertices, faces, strips };

struct PlyElement {
  std::string_view name;
  std::int64_t count = 0;
  std::size_t count_offset = 0;  ///< where the header has it
  PlyElementKind kind = PlyElementKind::skipped;
  std::vector<PlyProperty> properties;

  /// Bytes of the smallest record in binary: every list empty.
  [[nodiscard]] std::size_t smallest_record_bytes() const noexcept;
  [[nodiscard]] bool has_lists() const noexcept;
};

enum class PlyFormat : std::uint8_t { ascii, binary_little_endian, binary_big_endian };

struct PlyHeader {
  PlyFormat format{};
  std::vector<PlyElement> elements;
  std::size_t body_offset = 0;
  std::int64_t vertex_count = 0;
};

/// Reads and checks the header. Names view `bytes`.
///
/// Post  There is one vertex element, with x, y and z; a face element that is not empty has one
///       list of integer vertex indices; strips are marked only where there is no such face
///       element.
[[nodiscard]] Parsed<PlyHeader> read_ply_header(std::span<const char> bytes);

}  // namespace hedgerow::io
