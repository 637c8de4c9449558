#pragma once

#include <cstddef>
#include <cstdint>

#include "failure.h"
#include "text_cursor.h"

namespace hedgerow::io {

/// What the keyword of an OFF file says.
struct OffVariant {
  bool has_texture = false;  ///< ST: two more floats a vertex
  bool has_colour = false;   ///< C: four more
  bool has_normal = false;   ///< N: three more
  bool is_binary = false;

  [[nodiscard]] std::size_t floats_per_vertex() const noexcept {
    return 3 + (has_normal ? 3u : 0u) + (has_colour ? 4u : 0u) + (has_texture ? 2u : 0u);
  }
};

/// Reads "[ST][C][N][4][n]OFF [BINARY]" and leaves the cursor behind it; a file that begins with a
/// number has no keyword, which the format allows. 4OFF and nOFF are refused by name.
[[nodiscard]] Parsed<OffVariant> read_off_keyword(TextCursor& cursor);

}  // namespace hedgerow::io
