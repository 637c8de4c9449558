#include <cstring>
#include <filesystem>
#include <optional>

#include "hedgerow/io/format.h"
#include "hedgerow/io/read.h"
#include "hedgerow/io/write.h"
#include "report/stages.h"

namespace hedgerow::tool {
namespace {

template <class T>
bool same_bits(const Buffer<T>& a, const Buffer<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

bool same_soup(const Soup& a, const Soup& b) {
  return same_bits(a.xyz, b.xyz) && same_bits(a.corners, b.corners) &&
         same_bits(a.offsets, b.offsets);
}

/// A file that is removed again.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path path) : path_(std::move(path)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes the mesh in the format that is timed and reads it back: true if every bit returns.
/// Nothing where it cannot be written, such as faces with vertices that do not exist.
std::optional<bool> reads_back(const Soup& soup, io::Format format, const std::string& folder,
                               const io::ReadOptions& options) {
  if (!io::can_write(format) || options.keep_non_finite) return std::nullopt;
  const TemporaryFile file(std::filesystem::path(folder) /
                           (std::string("read-check.") + io::name(format)));
  io::WriteInput input;
  input.positions = soup.positions();
  input.faces = soup.face_list();
  io::WriteOptions write_options;
  write_options.durable = false;
  if (!io::write(file.path(), input, write_options)) return std::nullopt;
  const io::IoResult<io::ReadOutput> again = io::read(file.path(), options);
  return again && same_soup(again->soup, soup);
}

}  // namespace

void measure_read(Stages& stages, const MeshFile& file, const std::string& folder) {
  const std::optional<io::Format> format = io::format_of(file.path);
  if (!format) return;
  io::ReadOptions options;
  options.keep_out_of_range =
      stages.run().options().policies[DefectKind::out_of_range] == Action::skip;
  options.keep_non_finite = stages.run().options().keep_non_finite;

  std::error_code ignored;
  Stage stage{.name = "read", .variant = io::name(*format)};
  stage.elements = file.soup.face_count();
  stage.unit = "face";
  stage.bytes = static_cast<std::int64_t>(
      std::filesystem::file_size(file.path, ignored) + file.soup.xyz.size_bytes() +
      file.soup.corners.size_bytes() + file.soup.offsets.size_bytes());
  stage.mix = Mix::copy;
  const auto work = [&](const Execution&) {
    const io::IoResult<io::ReadOutput> output = io::read(file.path, options);
    return output.has_value();
  };
  const std::optional<bool> is_right = reads_back(file.soup, *format, folder, options);
  if (is_right) {
    stages.measure_serial(
        std::move(stage), [&](const Execution&) { return *is_right; }, work);
  } else {
    stages.measure_unchecked(std::move(stage), work);
  }
}

}  // namespace hedgerow::tool
