#include "hedgerow/io/format.h"

#include <iterator>
#include <string>

namespace hedgerow::io {

namespace {
constexpr const char* kExtensions[] = {"obj", "ply", "off", "stl", "gltf", "glb", "wet"};
static_assert(std::size(kExtensions) == static_cast<std::size_t>(Format::wet) + 1);
}  // namespace

const char* name(Format format) noexcept { return kExtensions[static_cast<std::size_t>(format)]; }

std::optional<Format> format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  // The C library's tolower follows the locale: in Turkish, "STL" would still do but "GLIB" not.
  for (char& letter : extension) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  for (std::size_t i = 0; i < std::size(kExtensions); ++i) {
    if (extension.size() > 1 && extension.compare(1, std::string::npos, kExtensions[i]) == 0) {
      return static_cast<Format>(i);
    }
  }
  return std::nullopt;
}

}  // namespace hedgerow::io
