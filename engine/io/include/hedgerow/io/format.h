#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace hedgerow::io {

/// The file formats. All are read; all but `gltf` and `glb` are also written.
enum class Format : std::uint8_t { obj, ply, off, stl, gltf, glb, wet };

/// Lower-case name, which is also the extension without its dot: "obj".
[[nodiscard]] const char* name(Format format) noexcept;

/// The format that the extension of `path` stands for, upper or lower case; none if unknown.
[[nodiscard]] std::optional<Format> format_of(const std::filesystem::path& path);

[[nodiscard]] constexpr bool can_write(Format format) noexcept {
  return format != Format::gltf && format != Format::glb;
}

}  // namespace hedgerow::io
