#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hedgerow/io/read.h"

namespace hedgerow::test {

/// Reads text (or bytes) as if it were a file called `name`, from a heap block of exactly its size,
/// so that a sanitizer sees any step beyond it.
[[nodiscard]] io::IoResult<io::ReadOutput> read_exact(std::string_view bytes, io::Format format,
                                                      const io::ReadOptions& options = {});

/// "code@line:column" or "code@byte" of a failed read; "ok V F C" of a good one, with the numbers
/// of vertices, faces and corners.
[[nodiscard]] std::string outcome(std::string_view bytes, io::Format format,
                                  const io::ReadOptions& options = {});

/// What is read, and the outcome that is expected.
struct TextCase {
  std::string_view text;
  std::string_view outcome;
};

/// The faces, one list of corners each.
[[nodiscard]] std::vector<std::vector<Index>> faces_of(const Soup& soup);

/// Appends values in a byte order.
class Bytes {
 public:
  explicit Bytes(bool is_big = false) : is_big_(is_big) {}
  Bytes& text(std::string_view characters) {
    bytes_ += characters;
    return *this;
  }
  template <class T>
  Bytes& value(T number) {
    char raw[sizeof(T)];
    std::char_traits<char>::copy(raw, reinterpret_cast<const char*>(&number), sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes_ += raw[is_big_ ? sizeof(T) - 1 - i : i];
    return *this;
  }
  [[nodiscard]] const std::string& str() const { return bytes_; }

 private:
  bool is_big_;
  std::string bytes_;
};

/// A directory of its own below the temporary one, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] std::filesystem::path operator/(std::string_view name) const {
    return path_ / name;
  }
  /// Names of all entries, sorted.
  [[nodiscard]] std::vector<std::string> entries() const;

 private:
  std::filesystem::path path_;
};

void put_file(const std::filesystem::path& path, std::string_view bytes);
[[nodiscard]] std::string file_contents(const std::filesystem::path& path);

}  // namespace hedgerow::test
