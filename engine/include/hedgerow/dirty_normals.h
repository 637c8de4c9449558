#pragma once

#include <cstdint>
#include <span>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "hedgerow/normals.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"
#include "hedgerow/workspace.h"

/// Normals after some vertices have moved: those that depend on them are computed again, to the
/// same bits as by a full pass, and no others.
namespace hedgerow {

/// Which vertices moved. Owns nothing.
class MovedVertices {
 public:
  /// In any order; some may be named more than once.
  [[nodiscard]] static MovedVertices list(std::span<const Index> ids) noexcept {
    MovedVertices moved;
    moved.ids_ = ids;
    return moved;
  }
  [[nodiscard]] static MovedVertices range(IndexRange range) noexcept {
    MovedVertices moved;
    moved.range_ = range;
    return moved;
  }
  /// Bit v % 64 of word v / 64 stands for vertex v.
  [[nodiscard]] static MovedVertices bitmap(std::span<const std::uint64_t> words) noexcept {
    MovedVertices moved;
    moved.words_ = words;
    return moved;
  }

  [[nodiscard]] std::span<const Index> ids() const noexcept { return ids_; }
  [[nodiscard]] IndexRange range() const noexcept { return range_; }
  [[nodiscard]] std::span<const std::uint64_t> words() const noexcept { return words_; }

 private:
  std::span<const Index> ids_;
  IndexRange range_;
  std::span<const std::uint64_t> words_;
};

/// What depends on moved vertices: their faces, and the vertices of these. Kept from frame to
/// frame, for one mesh; also what a ray tracer has to refit.
///
/// Memory     4 bytes a vertex and a face, and a bit; for polygons 4 bytes a face more. Allocated
///            once, by the constructor.
/// Threads    As of any object: one writer, or any number of readers.
class DirtySet {
 public:
  /// Throws std::bad_alloc.
  explicit DirtySet(const Connectivity& mesh);

  /// Finds the faces at the moved vertices, and their vertices. From an eighth of all vertices on
  /// (a list counts those that it repeats) everything is dirty, as a full pass is cheaper than
  /// finding what could be left out.
  ///
  /// Pre        `mesh` is that of the constructor, unchanged, and sound.
  /// Complexity O(corners at the moved vertices), on the calling thread; for a bitmap O(V / 64)
  ///            besides. Allocates nothing.
  /// Errors     index_out_of_range: element = the first entry of the list, or the vertex of the
  ///            bitmap or range, value = the vertex, limit = the vertex count; `count` of them. The
  ///            set is then as it was.
  [[nodiscard]] Result<void> find(const Connectivity& mesh, const MovedVertices& moved);

  /// True: `faces` and `vertices` are empty, and stand for all.
  [[nodiscard]] bool is_all() const noexcept { return is_all_; }
  /// Ascending, each once.
  [[nodiscard]] std::span<const Index> faces() const noexcept {
    return faces_.span().first(face_count_);
  }
  [[nodiscard]] std::span<const Index> vertices() const noexcept {
    return vertices_.span().first(vertex_count_);
  }
  /// Of polygons: all faces at the dirty vertices. Ascending, each once; empty for triangles.
  [[nodiscard]] std::span<const Index> ring_faces() const noexcept {
    return ring_faces_.span().first(ring_face_count_);
  }

 private:
  template <class Mesh>
  void collect(const Mesh& mesh, const MovedVertices& moved);

  Buffer<std::byte> vertex_bits_;  // all zero between calls
  Buffer<std::byte> face_bits_;
  Buffer<Index> faces_;
  Buffer<Index> vertices_;
  Buffer<Index> ring_faces_;
  std::size_t face_count_ = 0;
  std::size_t vertex_count_ = 0;
  std::size_t ring_face_count_ = 0;
  bool is_all_ = false;
};

/// Computes the normals of the dirty faces again; where everything is dirty, all of them.
///
/// Pre        `dirty` is of `mesh`. `out` holds the normals of the other faces.
/// Complexity O(corners of the dirty faces). The count is of what was computed.
/// Errors, threads   As `face_normals`.
[[nodiscard]] Result<NormalStats> update_face_normals(const Connectivity& mesh, Positions positions,
                                                      NormalsOut out, const NormalOptions& options,
                                                      const DirtySet& dirty,
                                                      const Execution& execution);

/// Computes the normals of the dirty vertices again, by walking; where everything is dirty, all of
/// them. The same bits as `gather_vertex_normals`.
///
/// Pre        `dirty` is of `mesh`. `out` holds the normals of the other vertices.
/// Complexity O(corners at the dirty vertices). The count is of what was computed.
/// Errors, threads, scratch   As `gather_vertex_normals`, which asks for as much of a workspace.
[[nodiscard]] Result<NormalStats> update_vertex_normals(
    const Connectivity& mesh, Positions positions, NormalsOut out, const NormalOptions& options,
    const DirtySet& dirty, const Execution& execution, Workspace& workspace);

}  // namespace hedgerow
