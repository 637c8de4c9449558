#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "hedgerow/io/io_error.h"
#include "hedgerow/io/read.h"
#include "hedgerow/point2.h"

namespace hedgerow::io {

struct PointsOutput {
  std::vector<Point2> points;  ///< in the order of the file
  std::vector<ReadWarning> warnings;
};

/// True if the extension of `path` is that of a file of points: .xy or .csv, upper or lower case.
[[nodiscard]] bool is_points_file(const std::filesystem::path& path);

/// Reads points in the plane; the extension decides the format. Coordinates are doubles.
///
/// XY    A point a line, x and y apart by blanks; what follows them on the line is skipped, with a
///       warning. A '#' begins a comment.
///
/// CSV   A point a line, fields apart by commas. If the first field of the first line is no number,
///       the line names the columns, and x and y are those of that name, upper or lower case, if
///       both are there; else they are the first two. Other columns are skipped, quoted or not.
///       Lines that begin with '#' are comments.
///
/// Of `options`, `keep_out_of_range` has no meaning. Empty lines are skipped; a file without points
/// is not malformed, one without bytes is.
///
/// Errors     unknown_extension, what reading a file meets, empty_file, compressed_file,
///            utf16_text, nul_byte, bad_number, missing_value, non_finite, too_many_elements.
[[nodiscard]] IoResult<PointsOutput> read_points(const std::filesystem::path& path,
                                                 const ReadOptions& options = {});
/// The same from memory; `path` is for messages and for its extension.
[[nodiscard]] IoResult<PointsOutput> read_points_bytes(std::span<const char> bytes,
                                                       const std::filesystem::path& path,
                                                       const ReadOptions& options = {});

}  // namespace hedgerow::io
