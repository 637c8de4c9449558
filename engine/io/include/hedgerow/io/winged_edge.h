#pragma once

#include <filesystem>
#include <span>

#include "hedgerow/io/io_error.h"
#include "hedgerow/io/read.h"
#include "hedgerow/io/write.h"
#include "hedgerow/winged_edge.h"

/// The text format of winged-edge tables, `.wet`:
///
///   wet 1
///   vertices N    then N lines: x y z edge
///   faces N       then N lines: edge
///   edges N       then N lines: start end prev_cw next_cw prev_ccw next_ccw face_cw face_ccw
///
/// Rows count from 1 and 0 is none; `#` begins a comment, and lines without words are skipped.
/// `WingedEdge` says what the columns mean. `read` and `write` know the format too, by its faces:
/// these functions keep every number of the tables.
///
/// Threads    Any number of calls at once.
namespace hedgerow::io {

/// Reads consistent tables, which own what they hold. Of `options`, keep_non_finite and progress
/// are asked.
///
/// Complexity O(bytes); memory in proportion to them.
/// Errors     Those of a text file; inconsistent_table: an entry contradicts the others, and the
///            message names its row, its column, what was found and what would be consistent.
///            Throws std::bad_alloc.
[[nodiscard]] IoResult<WingedEdgeTables> read_winged_edges(const std::filesystem::path& path,
                                                           const ReadOptions& options = {});
/// The same from memory; `path` is quoted in errors.
[[nodiscard]] IoResult<WingedEdgeTables> read_winged_edges_bytes(std::span<const char> bytes,
                                                                 const std::filesystem::path& path,
                                                                 const ReadOptions& options = {});

/// Writes the tables as they are, whole or not at all; floats with the fewest digits that read back
/// to the same bits. Of `options`, durable is asked. Returns the bytes written.
///
/// Pre        None: inconsistent tables, or such without positions, are refused.
/// Complexity O(bytes). Errors bad_mesh, cannot_create, cannot_write. Throws std::bad_alloc.
[[nodiscard]] IoResult<WriteOutput> write_winged_edges(const std::filesystem::path& path,
                                                       const WingedEdgeTables& tables,
                                                       const WriteOptions& options = {});

}  // namespace hedgerow::io
