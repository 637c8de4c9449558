#include "hedgerow/io/atomic_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "file_bytes.h"

namespace hedgerow::io {

namespace {

constexpr std::size_t kLargestWrite = std::size_t{1} << 30;  // Linux moves at most 2 GiB a call
constexpr int kMostLinks = 40;
constexpr int kMostLeftovers = 10'000;

// Only the number of a name that is in use must differ, so one counter for the process will do.
std::atomic<unsigned> temporary_count{0};

// The file behind a chain of links, which need not exist. The links are left as they are.
std::filesystem::path behind_links(std::filesystem::path path, std::error_code& error) {
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code unused;
    if (!std::filesystem::is_symlink(std::filesystem::symlink_status(path, unused))) return path;
    const std::filesystem::path link = std::filesystem::read_symlink(path, error);
    if (error) return path;
    path = link.is_absolute() ? link : path.parent_path() / link;
  }
  error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
  return path;
}

std::filesystem::path directory_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

// A long name is cut so that the temporary name, which is longer, still is one.
std::filesystem::path temporary_beside(const std::filesystem::path& target) {
  constexpr std::size_t kLongestStem = 200;
  const std::string stem = target.filename().string().substr(0, kLongestStem);
  return directory_of(target) / ('.' + stem + ".tmp." + std::to_string(::getpid()) + '.' +
                                 std::to_string(temporary_count++));
}

}  // namespace

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      options_(other.options_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      bytes_written_(other.bytes_written_),
      has_failed_(other.has_failed_),
      error_(std::move(other.error_)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  path_ = std::move(other.path_);
  target_ = std::move(other.target_);
  temporary_ = std::exchange(other.temporary_, {});
  options_ = other.options_;
  descriptor_ = std::exchange(other.descriptor_, -1);
  bytes_written_ = other.bytes_written_;
  has_failed_ = other.has_failed_;
  error_ = std::move(other.error_);
  return *this;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
    temporary_.clear();
  }
}

IoResult<void> AtomicFile::fail_with(IoErrorCode code, std::string_view step, int error) {
  has_failed_ = true;
  error_ = IoError();
  error_.code = code;
  error_.path = path_.string();
  error_.message = std::string(step) + ": " + system_text(error);
  if (!temporary_.empty()) error_.details.push_back("the old file, if there was one, is unchanged");
  discard();
  return tl::unexpected<IoError>(error_);
}

IoResult<AtomicFile> AtomicFile::create(const std::filesystem::path& path, Options options) {
  AtomicFile file;
  file.path_ = path;
  file.options_ = options;
  const auto refuse = [&](std::string_view step, int number) {
    return tl::unexpected<IoError>(
        file.fail_with(IoErrorCode::cannot_create, step, number).error());
  };
  std::error_code link_error;
  file.target_ = behind_links(path, link_error);
  if (link_error) return refuse("cannot follow the link", link_error.value());

  struct stat old {};
  const bool exists = ::stat(file.target_.c_str(), &old) == 0;
  if (!exists && errno != ENOENT) return refuse("cannot look at the target", errno);
  if (exists && S_ISDIR(old.st_mode)) return refuse("cannot replace the target", EISDIR);
  if (exists && !S_ISREG(old.st_mode)) {
    file.descriptor_ = ::open(file.target_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (file.descriptor_ < 0) return refuse("cannot open the target", errno);
    return file;
  }
  // A file that may not be written is not replaced either, though the directory would allow it.
  if (exists && ::access(file.target_.c_str(), W_OK) != 0) {
    return refuse("cannot replace the target", errno);
  }
  const mode_t mode = exists ? old.st_mode & 07777 : 0666;
  std::filesystem::path temporary;
  // A process that was killed has left its temporary file, and numbers of processes come again: in
  // a container often the same one.
  for (int i = 0; i < kMostLeftovers; ++i) {
    temporary = temporary_beside(file.target_);
    file.descriptor_ =
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, exists ? 0600 : mode);
    if (file.descriptor_ >= 0 || errno != EEXIST) break;
  }
  if (file.descriptor_ < 0) {
    return refuse("cannot create a file in " + directory_of(file.target_).string(), errno);
  }
  file.temporary_ = temporary;
  if (exists && ::fchmod(file.descriptor_, mode) != 0) {
    return refuse("cannot set the mode of the new file", errno);
  }
  return file;
}

IoResult<void> AtomicFile::write(std::span<const char> bytes) {
  if (has_failed_) return tl::unexpected<IoError>(error_);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got =
        ::write(descriptor_, bytes.data() + done, std::min(kLargestWrite, bytes.size() - done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      const int error = got < 0 ? errno : EIO;
      return fail_with(IoErrorCode::cannot_write,
                       "cannot write at byte " + std::to_string(bytes_written_), error);
    }
    done += static_cast<std::size_t>(got);
    bytes_written_ += got;
  }
  return {};
}

// A failed fsync is not tried again: the kernel may have dropped the pages and would say yes.
IoResult<void> AtomicFile::commit() {
  if (has_failed_) return tl::unexpected<IoError>(error_);
  const bool is_stream = temporary_.empty();
  if (!is_stream) {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) {
      return fail_with(IoErrorCode::cannot_write, "cannot check the new file", errno);
    }
    if (status.st_size != bytes_written_) {
      return fail_with(IoErrorCode::cannot_write, "the new file has another size", EIO);
    }
    if (options_.durable && ::fsync(descriptor_) != 0) {
      return fail_with(IoErrorCode::cannot_write, "cannot flush the new file", errno);
    }
  }
  if (::close(std::exchange(descriptor_, -1)) != 0) {
    return fail_with(IoErrorCode::cannot_write, "cannot close the new file", errno);
  }
  if (is_stream) return {};
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    return fail_with(IoErrorCode::cannot_write, "cannot rename the new file", errno);
  }
  temporary_.clear();
  if (options_.durable) {
    // The file is in its place. Some file systems cannot flush a directory; that is no failure.
    const int directory = ::open(directory_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (directory >= 0) {
      static_cast<void>(::fsync(directory));
      ::close(directory);
    }
  }
  return {};
}

IoResult<void> write_file_atomically(const std::filesystem::path& path, std::span<const char> bytes,
                                     AtomicFile::Options options) {
  IoResult<AtomicFile> file = AtomicFile::create(path, options);
  if (!file) return tl::unexpected<IoError>(std::move(file.error()));
  if (IoResult<void> written = file->write(bytes); !written) return written;
  return file->commit();
}

}  // namespace hedgerow::io
