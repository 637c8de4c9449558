#include "hedgerow/io/io_error.h"

#include <iterator>

namespace hedgerow::io {

namespace {

constexpr const char* kErrorNames[] = {"unknown-extension",
                                       "cannot-open",
                                       "not-a-regular-file",
                                       "cannot-read",
                                       "file-changed",
                                       "empty-file",
                                       "compressed-file",
                                       "utf16-text",
                                       "nul-byte",
                                       "unknown-format",
                                       "bad-header",
                                       "unsupported-variant",
                                       "unexpected-end",
                                       "missing-value",
                                       "unexpected-word",
                                       "bad-number",
                                       "bad-count",
                                       "count-too-large",
                                       "too-many-elements",
                                       "size-mismatch",
                                       "unknown-type",
                                       "duplicate-property",
                                       "missing-property",
                                       "missing-element",
                                       "bad-property",
                                       "index-out-of-range",
                                       "non-finite",
                                       "bad-face-degree",
                                       "inconsistent-table",
                                       "bad-json",
                                       "bad-gltf",
                                       "bad-accessor",
                                       "forbidden-uri",
                                       "unsupported-feature",
                                       "cannot-create",
                                       "cannot-write",
                                       "bad-mesh"};
static_assert(std::size(kErrorNames) == static_cast<std::size_t>(IoErrorCode::bad_mesh) + 1);

// A path may hold a newline or an escape sequence; an error is one line and not for the terminal to
// obey.
void append_visible(std::string& out, const std::string& text) {
  constexpr char kHex[] = "0123456789abcdef";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      out += c;
    } else {
      out += "\\x";
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    }
  }
}

}  // namespace

const char* name(IoErrorCode code) noexcept { return kErrorNames[static_cast<std::size_t>(code)]; }

std::string to_string(const IoError& error) {
  std::string out;
  append_visible(out, error.path);
  if (error.line > 0) {
    out += ':' + std::to_string(error.line);
    if (error.column > 0) out += ':' + std::to_string(error.column);
  } else if (error.byte >= 0) {
    out += '@' + std::to_string(error.byte);
  }
  out += ": error: ";
  out += name(error.code);
  out += ": ";
  append_visible(out, error.message);
  for (const std::string& detail : error.details) {
    out += "\n  ";
    append_visible(out, detail);
  }
  return out;
}

}  // namespace hedgerow::io
