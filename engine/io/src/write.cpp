#include "hedgerow/io/write.h"

#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "compose.h"
#include "failure.h"
#include "hedgerow/io/winged_edge.h"
#include "output.h"
#include "wet.h"

namespace hedgerow::io {

namespace {

std::optional<std::string> defect_of(const Positions& points, const char* what) {
  if (points.count < 0) return compose("a negative number of {}", what);
  if (points.count > 0 && points.data == nullptr) return compose("no address of the {}", what);
  if (points.count > 0 && points.stride_bytes < 3 * sizeof(float)) {
    return compose("the {} are {} bytes apart, each has 12", what, points.stride_bytes);
  }
  return std::nullopt;
}

// A file must not refer to vertices that it does not have, so all indices are looked at before the
// first byte is written.
std::optional<std::string> defect_of(const WriteInput& input) {
  if (auto defect = defect_of(input.positions, "positions")) return defect;
  if (auto defect = defect_of(input.normals, "normals")) return defect;
  if (input.normals.count != 0 && input.normals.count != input.positions.count) {
    return compose("{} normals for {} vertices", input.normals.count, input.positions.count);
  }
  if (const Result<void> checked = check(input.faces); !checked) {
    const Error& error = checked.error();
    return compose("the face list is not sound: {} (element {}, value {}, limit {})",
                   name(error.code), error.element, error.value, error.limit);
  }
  for (std::int64_t f = 0; f < input.faces.face_count; ++f) {
    const std::int64_t degree = input.faces.corner_range(f).size();
    for (std::int64_t k = 0; k < degree; ++k) {
      const std::int64_t vertex = vertex_at(input.faces, f, k);
      if (vertex < 0 || vertex >= input.positions.count) {
        return compose("face {} refers to vertex {}, there are {}", f, vertex,
                       input.positions.count);
      }
    }
  }
  return std::nullopt;
}

// The formats' own limits; text has none.
std::optional<std::string> excess_of(const WriteInput& input, Format format) {
  constexpr std::int64_t kLargestInt = std::numeric_limits<std::int32_t>::max();
  constexpr std::int64_t kLargestUnsigned = std::numeric_limits<std::uint32_t>::max();
  if (format == Format::ply && input.positions.count > kLargestInt) {
    return compose("{} vertices; the int indices of PLY reach {}", input.positions.count,
                   kLargestInt);
  }
  // A face of n corners becomes n - 2 triangles.
  const std::int64_t most_triangles =
      input.faces.is_triangles() ? input.faces.face_count : input.faces.corner_count();
  if (format == Format::stl && most_triangles > kLargestUnsigned) {
    return compose("up to {} triangles; STL counts to {}", most_triangles, kLargestUnsigned);
  }
  return std::nullopt;
}

}  // namespace

IoResult<WriteOutput> write(const std::filesystem::path& path, const WriteInput& input,
                            const WriteOptions& options) {
  const std::optional<Format> format = format_of(path);
  if (!format || !can_write(*format)) {
    return refuse(path, IoErrorCode::unknown_extension,
                  "the extension is none of .obj .ply .off .stl .wet");
  }
  if (std::optional<std::string> defect = defect_of(input)) {
    return refuse(path, IoErrorCode::bad_mesh, std::move(*defect));
  }
  if (std::optional<std::string> excess = excess_of(input, *format)) {
    return refuse(path, IoErrorCode::too_many_elements, std::move(*excess));
  }
  if (*format == Format::wet) {
    const Parsed<WingedEdgeTables> tables = tables_of(input);
    if (!tables) return refuse(path, tables.error().code, tables.error().message);
    return write_winged_edges(path, *tables, options);
  }
  IoResult<AtomicFile> file = AtomicFile::create(path, {options.durable});
  if (!file) return tl::unexpected<IoError>(std::move(file.error()));
  Output out(*file);
  WriteContext context{input, options, out, {}};
  switch (*format) {
    case Format::obj:
      write_obj(context);
      break;
    case Format::off:
      write_off(context);
      break;
    case Format::stl:
      write_stl(context);
      break;
    default:
      write_ply(context);
      break;
  }
  if (IoResult<void> finished = out.finish(); !finished) {
    return tl::unexpected<IoError>(std::move(finished.error()));
  }
  context.report.byte_count = file->bytes_written();
  return context.report;
}

}  // namespace hedgerow::io
