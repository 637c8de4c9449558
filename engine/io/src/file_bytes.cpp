#include "file_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "failure.h"

namespace hedgerow::io {

namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) noexcept : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  [[nodiscard]] int get() const noexcept { return number_; }

 private:
  int number_;
};

const char* kind_of(mode_t mode) noexcept {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  if (S_ISSOCK(mode)) return "a socket";
  return "of an unknown kind";
}

// Reads until `size` bytes are there or the file ends; -1 on error.
ssize_t read_up_to(int file, char* to, std::size_t size) noexcept {
  constexpr std::size_t kBlock = std::size_t{1} << 30;  // Linux moves at most 2 GiB a call
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(file, to + done, std::min(kBlock, size - done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return static_cast<ssize_t>(done);
}

}  // namespace

std::string system_text(int error) { return std::system_category().message(error); }

// A copy instead of a mapping: a mapped file that another process cuts short kills the reader with
// SIGBUS, and the copy of 17 MB takes 4 ms.
IoResult<Buffer<char>> read_file(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (file.get() < 0) return refuse(path, IoErrorCode::cannot_open, system_text(errno));
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) {
    return refuse(path, IoErrorCode::cannot_read, system_text(errno));
  }
  if (S_ISDIR(status.st_mode)) {
    return refuse(path, IoErrorCode::not_a_regular_file, system_text(EISDIR));
  }
  if (!S_ISREG(status.st_mode)) {
    return refuse(path, IoErrorCode::not_a_regular_file,
                  std::string("it is ") + kind_of(status.st_mode) + ", not a regular file");
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  Buffer<char> bytes(size);
  const ssize_t got = read_up_to(file.get(), bytes.data(), size);
  char extra = 0;
  const ssize_t beyond = got < 0 ? -1 : read_up_to(file.get(), &extra, 1);
  if (beyond < 0) return refuse(path, IoErrorCode::cannot_read, system_text(errno));
  if (static_cast<std::size_t>(got) != size || beyond != 0) {
    return refuse(path, IoErrorCode::file_changed,
                  "it had " + std::to_string(size) + " bytes when it was opened, and " +
                      (beyond != 0 ? "more" : std::to_string(got)) + " when it was read");
  }
  return bytes;
}

}  // namespace hedgerow::io
