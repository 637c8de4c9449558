#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "hedgerow/face_list.h"
#include "hedgerow/io/format.h"
#include "hedgerow/io/io_error.h"
#include "hedgerow/positions.h"

namespace hedgerow::io {

/// What is written. Owns nothing; the arrays must outlive the call.
struct WriteInput {
  Positions positions;
  FaceList faces;
  Positions normals;  ///< one a vertex, or none at all (count 0)
};

enum class PlyEncoding : std::uint8_t { binary_little_endian, binary_big_endian, ascii };
enum class StlEncoding : std::uint8_t { binary, ascii };

struct WriteOptions {
  PlyEncoding ply = PlyEncoding::binary_little_endian;
  StlEncoding stl = StlEncoding::binary;
  bool durable = true;  ///< flush to the device, see `AtomicFile`
  std::function<void(std::int64_t done, std::int64_t total)> progress;  ///< elements; may be null
};

struct WriteOutput {
  std::int64_t byte_count = 0;
  std::int64_t split_face_count = 0;    ///< STL: polygons that were cut into triangles
  std::int64_t dropped_face_count = 0;  ///< STL: faces with fewer than three corners
};

/// Writes a mesh file, whole or not at all; the extension decides the format.
///
/// OBJ, OFF  Text; each float with the fewest digits that read back to the same bits. Normals as
///           vn / NOFF.
/// PLY       float x y z [nx ny nz]; faces as `list uchar int vertex_indices`, with an int count
///           where a face has more than 255 corners.
/// STL       Polygons are cut into a fan from their first corner; unreferenced vertices are lost,
///           as the format demands. Facet normals are computed; (0, 0, 0) for a face of no area.
/// WET       Winged-edge tables in the default form, see winged_edge.h; builds connectivity on the
///           way, and refuses (bad_mesh) what two-manifold records cannot hold. Normals are lost.
///
/// Pre        None: a mesh with faces that refer to vertices that do not exist is refused.
/// Complexity O(bytes); one block of 256 KiB is all the memory it takes, but for WET.
/// Errors     unknown_extension, bad_mesh, too_many_elements, cannot_create, cannot_write. On any,
///            what was there is as it was, but for a stream. Throws std::bad_alloc.
/// Threads    Any number of calls at once; of two for one target, the later commit stays.
[[nodiscard]] IoResult<WriteOutput> write(const std::filesystem::path& path,
                                          const WriteInput& input,
                                          const WriteOptions& options = {});

}  // namespace hedgerow::io
