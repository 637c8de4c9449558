#include "hedgerow/io/read.h"

#include <optional>
#include <string_view>
#include <utility>

#include "file_bytes.h"
#include "hedgerow/io/points.h"
#include "hedgerow/io/winged_edge.h"
#include "points.h"
#include "read_context.h"
#include "text_cursor.h"
#include "wet.h"

namespace hedgerow::io {

namespace {

struct Magic {
  std::string_view bytes;
  const char* name;
};
constexpr Magic kCompressed[] = {{"\x1f\x8b", "gzip"},
                                 {"PK\x03\x04", "zip"},
                                 {"\xfd"
                                  "7zXZ",
                                  "xz"},
                                 {"BZh", "bzip2"},
                                 {"\x28\xb5\x2f\xfd", "zstd"}};

const char* compression_of(std::span<const char> bytes) noexcept {
  const std::string_view start(bytes.data(), std::min<std::size_t>(bytes.size(), 8));
  for (const Magic& magic : kCompressed) {
    if (start.starts_with(magic.bytes)) return magic.name;
  }
  return nullptr;
}

std::optional<Failure> check_file(Format format, const ReadContext& context) {
  if (context.bytes.empty() && format != Format::obj) {
    const bool is_text = format != Format::stl && format != Format::glb;
    return Failure{IoErrorCode::empty_file, 0, is_text ? Place::text : Place::binary,
                   "the file has no bytes"};
  }
  if (const char* compression = compression_of(context.bytes)) {
    return Failure{IoErrorCode::compressed_file, 0, Place::binary,
                   std::string("the file is compressed with ") + compression +
                       ", which is not supported; decompress it first"};
  }
  return std::nullopt;
}

Parsed<Soup> parse(Format format, ReadContext& context) {
  if (std::optional<Failure> failed = check_file(format, context)) {
    return tl::unexpected<Failure>(std::move(*failed));
  }
  switch (format) {
    case Format::obj:
      return read_obj(context);
    case Format::ply:
      return read_ply(context);
    case Format::off:
      return read_off(context);
    case Format::stl:
      return read_stl(context);
    case Format::gltf:
      return read_gltf(context);
    case Format::glb:
      return read_glb(context);
    case Format::wet:
      return read_wet(context);
  }
  return failure(IoErrorCode::unknown_format, 0, Place::none, "unknown format");
}

IoError located(Failure&& failed, const ReadContext& context) {
  IoError error;
  error.code = failed.code;
  error.path = context.path.string();
  error.message = std::move(failed.message);
  if (failed.place == Place::text) {
    const LineColumn place = line_column(context.bytes, failed.offset);
    error.line = place.line;
    error.column = place.column;
  } else if (failed.place == Place::binary) {
    error.byte = static_cast<std::int64_t>(failed.offset);
  }
  return error;
}

}  // namespace

void ReadContext::warn(const char* code, std::size_t offset, Place place, std::string message) {
  for (ReadWarning& known : warnings) {
    if (known.code == code) {
      ++known.count;
      return;
    }
  }
  ReadWarning warning;
  warning.code = code;
  warning.line = place == Place::text ? line_column(bytes, offset).line : 0;
  warning.message = std::move(message);
  warnings.push_back(std::move(warning));
}

IoResult<ReadOutput> read_bytes(std::span<const char> bytes, Format format,
                                const std::filesystem::path& path, const ReadOptions& options) {
  ReadContext context{bytes, options, path, Progress(options.progress, bytes.size()), {}};
  Parsed<Soup> soup = parse(format, context);
  if (!soup) return tl::unexpected<IoError>(located(std::move(soup.error()), context));
  if (options.progress) {
    const auto size = static_cast<std::int64_t>(bytes.size());
    options.progress(size, size);
  }
  return ReadOutput{std::move(*soup), format, std::move(context.warnings)};
}

IoResult<ReadOutput> read(const std::filesystem::path& path, const ReadOptions& options) {
  const std::optional<Format> format = format_of(path);
  if (!format) {
    IoError error;
    error.code = IoErrorCode::unknown_extension;
    error.path = path.string();
    error.message = "the extension is none of .obj .ply .off .stl .gltf .glb .wet";
    return tl::unexpected<IoError>(std::move(error));
  }
  IoResult<Buffer<char>> bytes = read_file(path);
  if (!bytes) return tl::unexpected<IoError>(std::move(bytes.error()));
  return read_bytes(bytes->span(), *format, path, options);
}

IoResult<WingedEdgeTables> read_winged_edges_bytes(std::span<const char> bytes,
                                                   const std::filesystem::path& path,
                                                   const ReadOptions& options) {
  ReadContext context{bytes, options, path, Progress(options.progress, bytes.size()), {}};
  if (std::optional<Failure> failed = check_file(Format::wet, context)) {
    return tl::unexpected<IoError>(located(std::move(*failed), context));
  }
  Parsed<WingedEdgeTables> tables = parse_wet(context);
  if (!tables) return tl::unexpected<IoError>(located(std::move(tables.error()), context));
  return std::move(*tables);
}

IoResult<WingedEdgeTables> read_winged_edges(const std::filesystem::path& path,
                                             const ReadOptions& options) {
  IoResult<Buffer<char>> bytes = read_file(path);
  if (!bytes) return tl::unexpected<IoError>(std::move(bytes.error()));
  return read_winged_edges_bytes(bytes->span(), path, options);
}

bool is_points_file(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return equals_ignoring_case(extension, ".xy") || equals_ignoring_case(extension, ".csv");
}

IoResult<PointsOutput> read_points_bytes(std::span<const char> bytes,
                                         const std::filesystem::path& path,
                                         const ReadOptions& options) {
  ReadContext context{bytes, options, path, Progress(options.progress, bytes.size()), {}};
  std::optional<Failure> failed = check_file(Format::off, context);
  if (!failed) failed = check_is_text(bytes);
  if (failed) return tl::unexpected<IoError>(located(std::move(*failed), context));
  const bool is_csv = equals_ignoring_case(path.extension().string(), ".csv");
  Parsed<std::vector<Point2>> points = is_csv ? parse_csv(context) : parse_xy(context);
  if (!points) return tl::unexpected<IoError>(located(std::move(points.error()), context));
  return PointsOutput{std::move(*points), std::move(context.warnings)};
}

IoResult<PointsOutput> read_points(const std::filesystem::path& path, const ReadOptions& options) {
  if (!is_points_file(path)) {
    return refuse(path, IoErrorCode::unknown_extension, "the extension is none of .xy .csv");
  }
  IoResult<Buffer<char>> bytes = read_file(path);
  if (!bytes) return tl::unexpected<IoError>(std::move(bytes.error()));
  return read_points_bytes(bytes->span(), path, options);
}

}  // namespace hedgerow::io
