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
  /// Keep faces that refer to vertices that do not exist, with an index that `build` classifies as
  /// `DefectKind::out_of_range`: below 0 or not below the vertex count. It is the index of the file
  /// (counted from 0) where that fits an `Index`, else `kInvalidIndex`. Without it such a file is
  /// malformed.
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
  /// Faces in file order, each with the corners of the file: also those with fewer than three
  /// corners or a repeated vertex, which are the builder's to classify. Polygons stay polygons;
  /// `offsets` is empty if all faces are triangles.
  Soup soup;
  Format format{};
  std::vector<ReadWarning> warnings;
};

/// Reads a mesh file; the extension decides the format.
///
/// OBJ   v, f (and fo); negative and forward references; \ at the end of a line continues it.
///       Texture coordinates, normals, colours, w, groups, lines and curves are skipped.
/// PLY   ascii and both binary orders; x, y, z of any scalar type, vertex_index or vertex_indices
///       of any integer type, elements and properties in any order; tristrips with -1 as restart
///       where there is no list of faces (triangles of a strip that repeat a vertex are dropped).
///       In ascii one element is one line.
/// OFF   OFF, COFF, NOFF, STOFF and their mixtures; one vertex or face a line. OFF BINARY with
///       32-bit values in the byte order, and with or without a colour count a face, whichever
///       makes the records end with the file; big-endian with colour counts (the standard) if
///       several do. 4OFF and nOFF are refused by name.
/// STL   Binary if the size is 84 + 50 times the count (up to 49 bytes behind are warned about),
///       or else if there is a byte 0 or no "solid" at the start; otherwise ascii. Vertices with
///       equal coordinates are welded (-0 equals 0), numbered by first occurrence; normals are
///       skipped.
/// glTF  2.0, .gltf and .glb: all triangle, strip and fan primitives of all meshes, once each and
///       one after the other; node transforms are not applied, nothing is welded. Points and lines
///       are skipped. Buffers may be embedded or files in the directory of `path`.
///
/// Only regular files are read. Line ends may be LF, CR LF or CR; there is no limit on line length.
/// Numbers do not depend on the locale. Memory is in proportion to the size of the file, whatever
/// counts it declares.
/// Complexity O(bytes). Threads: any number of calls at once.
[[nodiscard]] IoResult<ReadOutput> read(const std::filesystem::path& path,
                                        const ReadOptions& options = {});

/// The same from memory. `path` is quoted in errors, and its directory is where files named by a
/// glTF asset are looked for. No byte behind `bytes` is read.
[[nodiscard]] IoResult<ReadOutput> read_bytes(std::span<const char> bytes, Format format,
                                              const std::filesystem::path& path,
                                              const ReadOptions& options = {});

}  // namespace hedgerow::io
