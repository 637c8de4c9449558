#include "terminal.h"

#include <cstdlib>
#include <unistd.h>

#include <fmt/format.h>

namespace hedgerow::tool {

bool is_terminal(std::FILE* stream) { return isatty(fileno(stream)) == 1; }

bool wants_colour(std::FILE* stream) {
  const char* no_colour = std::getenv("NO_COLOR");
  if (no_colour != nullptr && *no_colour != '\0') return false;
  const char* terminal = std::getenv("TERM");
  if (terminal == nullptr || std::string_view(terminal) == "dumb") return false;
  return is_terminal(stream);
}

std::string styled(std::string_view words, Style style, bool colour) {
  if (!colour) return std::string(words);
  const char* code = "1";
  switch (style) {
    case Style::heading:
      code = "1";
      break;
    case Style::good:
      code = "32";
      break;
    case Style::warning:
      code = "33";
      break;
    case Style::error:
      code = "1;31";
      break;
  }
  return fmt::format("\x1b[{}m{}\x1b[0m", code, words);
}

}  // namespace hedgerow::tool
