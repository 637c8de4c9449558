#include "compose.h"

namespace hedgerow::io {

std::string compose_erased(fmt::string_view format, fmt::format_args arguments) {
  return fmt::vformat(format, arguments);
}

}  // namespace hedgerow::io
