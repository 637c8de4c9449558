#pragma once

#include <filesystem>

#include "hedgerow/buffer.h"
#include "hedgerow/io/io_error.h"

namespace hedgerow::io {

/// All bytes of a regular file. Anything else is refused without waiting for it: a pipe has no end
/// that could be relied on, and a device perhaps no end at all.
[[nodiscard]] IoResult<Buffer<char>> read_file(const std::filesystem::path& path);

/// The system's text for an error number.
[[nodiscard]] std::string system_text(int error);

}  // namespace hedgerow::io
