#pragma once

#include <string>

#include <fmt/format.h>

namespace hedgerow::io {

[[nodiscard]] std::string compose_erased(fmt::string_view format, fmt::format_args arguments);

/// fmt::format, whose machinery is then compiled in one file and not in each that words a message:
/// seconds each.
template <class... Arguments>
[[nodiscard]] std::string compose(fmt::format_string<Arguments...> format,
                                  Arguments&&... arguments) {
  return compose_erased(format, fmt::make_format_args(arguments...));
}

}  // namespace hedgerow::io
