#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "hedgerow/io/io_error.h"

namespace hedgerow::io {

/// A file that appears whole or not at all: bytes go to a temporary file in the target's directory
/// (named `.NAME.tmp.PID.NUMBER`), and `commit` puts it in the place of the target.
///
/// Links      A symbolic link is kept; the file that it leads to is replaced.
/// Mode       That of the old file, else 0666 less the umask.
/// Streams    A target that exists and is no regular file (a pipe, /dev/stdout) is written to
///            directly, without this promise.
/// Failure    After a failed call the object only remembers the error: later calls return it again.
///            Without a successful commit the destructor removes the temporary file. A process that
///            is killed may leave a temporary file behind, never a damaged target, and the next
///            save is not hindered by it.
/// Threads    One at a time for one object; any number of objects, of the same target too.
class AtomicFile {
 public:
  struct Options {
    /// Flush to the device (file before the rename, directory after it).
    bool durable = true;
  };

  /// Errors     cannot_create: the directory or the target may not be written, or `path` names a
  ///            directory; nothing was made.
  [[nodiscard]] static IoResult<AtomicFile> create(const std::filesystem::path& path,
                                                   Options options);
  [[nodiscard]] static IoResult<AtomicFile> create(const std::filesystem::path& path) {
    return create(path, Options());
  }
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// Appends; nothing is kept back in memory. Errors: cannot_write.
  [[nodiscard]] IoResult<void> write(std::span<const char> bytes);
  /// Everything is checked: the size on disk, the flush, the close, the rename. Call once. Errors:
  /// cannot_write, and the target is as it was.
  [[nodiscard]] IoResult<void> commit();

  [[nodiscard]] std::int64_t bytes_written() const noexcept { return bytes_written_; }

 private:
  AtomicFile() = default;
  [[nodiscard]] IoResult<void> fail_with(IoErrorCode code, std::string_view step, int error);
  void discard() noexcept;

  std::filesystem::path path_;       ///< as the caller named it; for messages
  std::filesystem::path target_;     ///< behind any links
  std::filesystem::path temporary_;  ///< empty: a stream
  Options options_;
  int descriptor_ = -1;
  std::int64_t bytes_written_ = 0;
  bool has_failed_ = false;
  IoError error_;
};

/// Replaces the file's contents by `bytes`, wholly or not at all.
[[nodiscard]] IoResult<void> write_file_atomically(const std::filesystem::path& path,
                                                   std::span<const char> bytes,
                                                   AtomicFile::Options options = {});

}  // namespace hedgerow::io
