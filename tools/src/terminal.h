#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace hedgerow::tool {

[[nodiscard]] bool is_terminal(std::FILE* stream);

/// True if `stream` is a terminal that takes colour and NO_COLOR is not set.
[[nodiscard]] bool wants_colour(std::FILE* stream);

enum class Style : std::uint8_t { heading, good, warning, error };

/// `words` between the escape codes of `style` if `colour`, else as they are.
[[nodiscard]] std::string styled(std::string_view words, Style style, bool colour);

}  // namespace hedgerow::tool
