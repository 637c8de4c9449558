#include "support/shared_folder.h"

#include <cstdlib>
#include <system_error>

namespace hedgerow::test {

std::optional<std::filesystem::path> shared_folder() {
  const char* named = std::getenv("HEDGEROW_SHARED");
  const std::filesystem::path folder =
      named != nullptr && *named != '\0'
          ? std::filesystem::path(named)
          : std::filesystem::path(HEDGEROW_SOURCE_DIR).parent_path() / "shared";
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) return std::nullopt;
  return folder;
}

}  // namespace hedgerow::test
