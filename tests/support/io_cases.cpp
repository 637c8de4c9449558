#include "support/io_cases.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <unistd.h>

namespace hedgerow::test {

io::IoResult<io::ReadOutput> read_exact(std::string_view bytes, io::Format format,
                                        const io::ReadOptions& options) {
  const std::unique_ptr<char[]> copy(new char[bytes.size()]);
  std::copy(bytes.begin(), bytes.end(), copy.get());
  return io::read_bytes({copy.get(), bytes.size()}, format, std::string("case.") + io::name(format),
                        options);
}

std::string outcome(std::string_view bytes, io::Format format, const io::ReadOptions& options) {
  const io::IoResult<io::ReadOutput> result = read_exact(bytes, format, options);
  if (result) {
    return "ok " + std::to_string(result->soup.vertex_count()) + ' ' +
           std::to_string(result->soup.face_count()) + ' ' +
           std::to_string(result->soup.corners.size());
  }
  const io::IoError& error = result.error();
  std::string text = std::string(io::name(error.code)) + '@';
  if (error.line > 0) return text + std::to_string(error.line) + ':' + std::to_string(error.column);
  return error.byte >= 0 ? text + std::to_string(error.byte) : text;
}

std::vector<std::vector<Index>> faces_of(const Soup& soup) {
  std::vector<std::vector<Index>> faces;
  for (Index f = 0; f < soup.face_count(); ++f) {
    const auto at = static_cast<std::size_t>(f);
    const std::size_t first =
        soup.offsets.empty() ? 3 * at : static_cast<std::size_t>(soup.offsets[at]);
    const std::size_t last =
        soup.offsets.empty() ? first + 3 : static_cast<std::size_t>(soup.offsets[at + 1]);
    faces.emplace_back(soup.corners.data() + first, soup.corners.data() + last);
  }
  return faces;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "hedgerow-test-XXXXXX").string();
  if (::mkdtemp(name.data()) != nullptr) path_ = name;
}
TemporaryFolder::~TemporaryFolder() {
  std::error_code unused;
  if (!path_.empty()) std::filesystem::remove_all(path_, unused);
}
std::vector<std::string> TemporaryFolder::entries() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

void put_file(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}
std::string file_contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace hedgerow::test
