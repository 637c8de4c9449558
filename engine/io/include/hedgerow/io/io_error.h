#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

namespace hedgerow::io {

/// What is wrong with a file. `name` gives the stable word for messages and JSON.
enum class IoErrorCode : std::uint8_t {
  // The file itself; nothing was parsed.
  unknown_extension,   ///< the extension belongs to no format that can be read (or written)
  cannot_open,         ///< missing, no permission, ...: the message has the system's text
  not_a_regular_file,  ///< directory, pipe, device, socket
  cannot_read,         ///< the system reported an error while reading
  file_changed,        ///< the size changed while the file was read
  empty_file,          ///< no bytes, in a format that has no empty form
  compressed_file,     ///< the first bytes are those of gzip, zip, xz, bzip2 or zstd
  // Text.
  utf16_text,           ///< text of 16-bit units; only ASCII and UTF-8 are read
  nul_byte,             ///< a byte 0 in a text file
  unknown_format,       ///< nothing in the file belongs to the format of its extension
  bad_header,           ///< the first lines (or bytes) are not those of the format
  unsupported_variant,  ///< a known variant of the format that is not read, by its name
  unexpected_end,       ///< the file ends inside an element
  missing_value,        ///< the line ends before all values of its element
  unexpected_word,      ///< another word than the one required here
  bad_number,           ///< not a number where one is required
  bad_count,            ///< a count that is negative or no number
  count_too_large,      ///< a declared count that the remaining bytes cannot hold
  too_many_elements,    ///< more than an `Index` can number
  size_mismatch,        ///< declared and actual size of a binary file disagree
  // PLY headers.
  unknown_type,        ///< a property type that does not exist
  duplicate_property,  ///< two properties of one element have the same name
  missing_property,    ///< an element lacks a property that the mesh needs
  missing_element,     ///< no vertex element
  bad_property,        ///< a property has a type that its meaning does not allow
  // The mesh.
  index_out_of_range,  ///< a face refers to a vertex that does not exist
  non_finite,          ///< a coordinate is NaN, infinite or too large for a float
  bad_face_degree,     ///< an STL loop without exactly three vertices, a negative face degree
  inconsistent_table,  ///< an entry of a winged-edge table contradicts the others
  // glTF.
  bad_json,       ///< not JSON; or too deeply nested
  bad_gltf,       ///< JSON, but not a glTF asset
  bad_accessor,   ///< an accessor, buffer view or buffer leaves its bounds or has a wrong type
  forbidden_uri,  ///< a URI with a scheme or a path that leaves the file's directory
  unsupported_feature,  ///< a required extension that is not read
  // Writing.
  cannot_create,  ///< the temporary file beside the target cannot be made
  cannot_write,   ///< a write, flush or rename failed; the old file is as it was
  bad_mesh,       ///< what was given to write is not a mesh: counts disagree, index out of range
};

/// Stable lower-case word-with-dashes, e.g. "index-out-of-range".
[[nodiscard]] const char* name(IoErrorCode code) noexcept;

/// What went wrong with a file, and where.
///
/// Text has `line` and `column` (both from 1; columns count bytes, a byte order mark not included);
/// binary has `byte` (offset from 0). Faces and vertices in messages count from 0 in file order,
/// like the engine's ids; an index is quoted as the file has it.
struct IoError {
  IoErrorCode code{};
  std::string path;
  std::int64_t line = 0;    ///< 0: no line
  std::int64_t column = 0;  ///< 0: no column
  std::int64_t byte = -1;   ///< -1: no offset
  std::string message;
  std::vector<std::string> details;  ///< further lines, if any
};

/// "PATH:LINE:COLUMN: error: CODE: MESSAGE" for text, "PATH@BYTE: error: CODE: MESSAGE" for binary,
/// "PATH: error: CODE: MESSAGE" without a place; then each detail on a line of its own, indented.
/// No newline at the end; control characters of the path are shown as \xNN.
[[nodiscard]] std::string to_string(const IoError& error);

/// A value, or the reason why there is none.
template <class T>
using IoResult = tl::expected<T, IoError>;

}  // namespace hedgerow::io
