#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "failure.h"

namespace hedgerow::io {

/// Objects and arrays inside each other; more than any glTF asset needs, and few enough for code
/// that recurses over them.
inline constexpr int kDeepestJson = 200;

/// Checks that `text` is one JSON value of bounded depth. Offsets count from `text`.
[[nodiscard]] std::optional<Failure> check_json(std::string_view text);

/// Offset of the value that a JSON pointer such as "/accessors/3/count" leads to; as far as the
/// pointer can be followed. \pre check_json(text) found nothing.
[[nodiscard]] std::size_t locate_json(std::string_view text, std::string_view pointer) noexcept;

}  // namespace hedgerow::io
