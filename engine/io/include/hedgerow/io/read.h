#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hedgerow/io/format.h"
#include "hedgerow/io/io_error.h"
#include "hedgerow/soup.h"

namespace hedgerow::io {

struct ReadOptions {
  /// Keep faces that refer to vertices that do not exist. Without it such a file is malformed.
  ///
  /// The corner then holds the index of the file, counted from 0, where that fits an `Index`, else
  /// `kInvalidIndex`. Either way it is below 0 or not below the vertex count, so that `build`
  /// classifies the face as `DefectKind::out_of_range`.
  bool keep_out_of_range = false;
  /// Keep NaN and infinite coordinates. Without it such a file is malformed.
  bool keep_non_finite = false;
  /// Called on the reading thread with bytes done and bytes in all, at most about 200 times.
  std::function<void(std::int64_t done, std::int64_t total)> progress;
};

/// Something odd that does not make the file malformed.
struct ReadWarning {
  std::string code;        ///< stable lower-case word-with-dashes
  std::int64_t line = 0;   ///< of the first occurrence; 0: no line
  std::int64_t count = 1;  ///< how often it occurs
  std::string message;
};

struct ReadOutput {
  /// Faces in the order of the file, each with the corners that it has there. Faces with fewer than
  /// three corners or with a repeated vertex are kept: they are the builder's to classify. Polygons
  /// stay polygons; `offsets` is empty if all faces are triangles.
  Soup soup;
  Format format{};
  std::vector<ReadWarning> warnings;
};

/// Reads a mesh file; the extension decides the format.
///
/// OBJ   Vertices (v) and faces (f, and the older fo), with negative indices and faces that come
///       before their vertices. A backslash at the end of a line continues it. Texture coordinates,
///       normals, colours, weights, groups, lines and curves are skipped.
///
/// PLY   Ascii and both binary byte orders. x, y and z may be of any scalar type, vertex_index or
///       vertex_indices of any integer type, and elements and properties may come in any order.
///       Unknown ones are skipped exactly. In ascii, one element is one line.
///       Where there is no list of faces, triangle strips are read, with -1 as restart; triangles
///       of a strip that repeat a vertex, which only join its parts, are dropped.
///
/// OFF   OFF, COFF, NOFF, STOFF and their combinations, one vertex or face a line. 4OFF and nOFF
///       are refused by name.
///       OFF BINARY has 32-bit values, and files exist in either byte order, with and without a
///       colour count behind each face. The reading whose records end where the file ends is taken;
///       if several do, it is the standard's, big-endian with colour counts.
///
/// STL   Binary if the size is 84 bytes and 50 for each triangle counted (up to 49 bytes more are
///       warned about), or if the file has a byte 0 or does not begin with "solid"; else ascii.
///       Vertices with equal coordinates become one (-0 equals 0), numbered by first occurrence.
///       Normals are skipped.
///
/// glTF  Version 2.0, as .gltf or .glb. The triangles, strips and fans of all meshes, each mesh
///       once and one after the other; points and lines are skipped. Node transforms are not
///       applied, and nothing is welded. Buffers may be embedded, or files in the directory of
///       `path`.
///
/// WET   The faces of winged-edge tables; edges without a face are skipped. See winged_edge.h.
///
/// Pre        None: any file gives a mesh or an error. Only regular files are read. Lines end with
///            LF, CR LF or CR and may be of any length. Numbers do not depend on the locale.
/// Complexity O(bytes). Memory is in proportion to the size of the file, whatever counts it
///            declares.
/// Errors     Every `IoErrorCode` but those of writing, with the place in the file. Throws
///            std::bad_alloc.
/// Threads    Any number of calls at once.
/// Lifetime   The result refers to nothing; the file is closed.
[[nodiscard]] IoResult<ReadOutput> read(const std::filesystem::path& path,
                                        const ReadOptions& options = {});

/// The same from memory. `path` is quoted in errors, and its directory is where the files that a
/// glTF asset names are looked for.
///
/// Lifetime   `bytes` must outlive the call; no byte behind them is read.
[[nodiscard]] IoResult<ReadOutput> read_bytes(std::span<const char> bytes, Format format,
                                              const std::filesystem::path& path,
                                              const ReadOptions& options = {});

}  // namespace hedgerow::io
