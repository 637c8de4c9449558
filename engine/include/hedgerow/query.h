#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hedgerow/buffer.h"
#include "hedgerow/build.h"
#include "hedgerow/circulate.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"
#include "hedgerow/workspace.h"

/// Questions about one element, on either view and in both forms; then about the whole mesh.
///
/// Pre        The mesh is sound, as `validate` says, and the element is one of its own.
/// Cost       About one element: linear in what is walked, so O(valence) or O(degree) where nothing
///            else is said, and nothing is allocated. About the whole mesh: as said there; these
///            throw std::bad_alloc.
/// Threads    Any number of questions at a time; no writer beside them. What takes an `Execution`
///            runs on its threads, with the same answer for all of them.
namespace hedgerow {

/// Sides of the face of `h`, or of its hole if it has no face. O(1) with a face, else O(sides).
template <FaceTopology Mesh>
[[nodiscard]] Index degree(const Mesh& mesh, HalfedgeId h) noexcept {
  if (mesh.face(h).valid()) return mesh.degree(mesh.face(h));
  Index count = 0;
  for ([[maybe_unused]] const HalfedgeId side : halfedges_from(mesh, h)) ++count;
  return count;
}

/// Faces across the edges of `f`; missing ones are not counted.
template <FaceTopology Mesh>
[[nodiscard]] Index adjacent_face_count(const Mesh& mesh, FaceId f) noexcept {
  Index count = 0;
  for ([[maybe_unused]] const FaceId g : adjacent_faces(mesh, f)) ++count;
  return count;
}

/// Edges at `v`. An edge that the builder left unpaired between several faces counts once for each
/// fan that ends on it; `summarise` counts such edges once.
template <Topology Mesh>
[[nodiscard]] Index valence(const Mesh& mesh, VertexId v) noexcept {
  Index count = 0;
  for ([[maybe_unused]] const VertexId u : neighbours(mesh, v)) ++count;
  return count;
}

/// Whether `h` is a boundary half-edge: without opposite (default form), without face (closed).
template <FaceTopology Mesh>
[[nodiscard]] bool is_boundary(const Mesh& mesh, HalfedgeId h) noexcept {
  return !mesh.opposite[h].valid() || !mesh.face(h).valid();
}

/// Whether the edge of `h` lacks a face on one side or both.
template <FaceTopology Mesh>
[[nodiscard]] bool is_boundary_edge(const Mesh& mesh, HalfedgeId h) noexcept {
  return is_boundary(mesh, h) || is_boundary(mesh, mesh.opposite[h]);
}

/// Whether some fan of `v` is open. An isolated vertex is not on the boundary. O(fans of v).
template <Topology Mesh>
[[nodiscard]] bool is_boundary(const Mesh& mesh, VertexId v) noexcept {
  const auto is_open = [&](HalfedgeId start) {
    return !mesh.face(start).valid() || is_open_start(mesh, start);
  };
  if (!mesh.outgoing[v].valid()) return false;
  if (is_open(mesh.outgoing[v])) return true;
  for (const FanStart& fan : extra_fans(mesh.fans, v)) {
    if (is_open(fan.start)) return true;
  }
  return false;
}

/// Whether some edge of `f` is on the boundary.
template <FaceTopology Mesh>
[[nodiscard]] bool is_boundary(const Mesh& mesh, FaceId f) noexcept {
  for (const HalfedgeId h : halfedges(mesh, f)) {
    if (is_boundary_edge(mesh, h)) return true;
  }
  return false;
}

/// All boundary loops: loop i is halfedges[first[i]] .. halfedges[first[i + 1] - 1].
struct BoundaryLoops {
  Buffer<Index> first;  ///< one behind the last loop, too
  Buffer<Index> halfedges;

  [[nodiscard]] Index count() const noexcept { return static_cast<Index>(first.size()) - 1; }
};

/// Every boundary half-edge in its loop, as `boundary_loop` walks it. Each loop begins at its
/// smallest half-edge, and the loops are in the order of these. O(H), on the calling thread.
[[nodiscard]] BoundaryLoops boundary_loops(const Connectivity& mesh);

/// Components of the graph of vertices and edges.
struct Components {
  Buffer<Index> label;  ///< smallest vertex of v's component; -1 for an isolated vertex
  Index count = 0;      ///< isolated vertices left out
};

/// Writes for each vertex the smallest vertex of its component, or -1 if it is isolated, and
/// returns how many components there are, isolated vertices left out. The same labels for every
/// number of threads.
///
/// Shapes     `labels`: one a vertex.
/// Complexity Where each vertex but the first has a smaller neighbour, as in a grid, one pass over
///            the vertices: `outgoing` is read once and in `origin` a face a vertex; `opposite` is
///            read round vertices without a smaller one in that face. Otherwise O(V + H) joins,
///            each O(log V) at the worst and a few steps in practice: `origin` is read once more,
///            by two threads from 262,144 faces on, and `outgoing` twice.
/// Scratch    Nothing for one run of joins; an index a vertex for each further thread, and a
///            little. It is wanted also where it turns out not to be needed.
/// Errors     count_mismatch: not one label a vertex; scratch_too_small: a fixed workspace is. The
///            labels are as they were.
/// Threads    Writes `labels` and the workspace, reads the mesh.
[[nodiscard]] Result<Index> connected_components(const Connectivity& mesh, std::span<Index> labels,
                                                 const Execution& execution, Workspace& workspace);
/// The same, with memory of its own. Throws std::bad_alloc.
[[nodiscard]] Components connected_components(const Connectivity& mesh,
                                              const Execution& execution = Execution::serial());

/// Edges on faces, by how many half-edges of faces lie on them.
struct EdgeCounts {
  std::int64_t edges = 0;         ///< distinct unordered vertex pairs
  std::int64_t boundary = 0;      ///< on one half-edge
  std::int64_t nonmanifold = 0;   ///< on three or more
  std::int64_t inconsistent = 0;  ///< on two that run the same way

  friend bool operator==(const EdgeCounts&, const EdgeCounts&) noexcept = default;
};

/// O(H), and O(n log n) in the n half-edges on the boundary: half-edges that the builder left
/// unpaired on one edge are brought together again. Pairs are counted on the calling thread.
[[nodiscard]] EdgeCounts count_edges(const Connectivity& mesh, const Execution& execution);

/// Vertices whose faces, joined across the edges they share there, form more than one group.
/// O(n log n) in the corners n of the vertices with several fans.
[[nodiscard]] std::int64_t count_nonmanifold_vertices(const Connectivity& mesh);

/// Edges per vertex, over the vertices that are on a face.
struct Valence {
  std::int64_t min = 0;
  std::int64_t max = 0;
  double mean = 0;
};

/// What a connectivity report says, as far as it follows from connectivity.
struct Summary {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
  std::int64_t triangles = 0;
  std::int64_t quads = 0;
  std::int64_t polygons = 0;  ///< faces with more than four corners
  std::int64_t duplicate_faces = 0;
  std::int64_t halfedges = 0;  ///< of faces: boundary half-edges of the closed form not counted
  EdgeCounts edge_counts;
  std::int64_t isolated_vertices = 0;
  std::int64_t nonmanifold_vertices = 0;
  std::int64_t components = 0;
  std::int64_t euler = 0;
  /// These two are defined where all edges and vertices are manifold and consistent.
  std::optional<std::int64_t> boundary_loops;
  std::optional<std::int64_t> genus;
  std::optional<Valence> valence;  ///< none if no vertex is on a face

  [[nodiscard]] bool is_closed() const noexcept { return edge_counts.boundary == 0; }
  [[nodiscard]] bool is_manifold() const noexcept {
    return edge_counts.nonmanifold == 0 && nonmanifold_vertices == 0;
  }
  [[nodiscard]] bool is_oriented() const noexcept { return edge_counts.inconsistent == 0; }
};

/// Complexity as of the parts above. The same for every execution, and for both forms of a mesh
/// without dangling edges (which count in `components` and `valence` only).
[[nodiscard]] Summary summarise(const Connectivity& mesh, const Execution& execution);

/// (vertices - isolated) - edges + faces.
[[nodiscard]] std::int64_t euler_characteristic(const Connectivity& mesh,
                                                const Execution& execution);

/// (2 components - boundary loops - Euler characteristic) / 2; none where `Summary::genus` is none.
[[nodiscard]] std::optional<std::int64_t> genus(const Connectivity& mesh,
                                                const Execution& execution);

/// Faces that the builder dropped because they have fewer than three corners or repeat a vertex.
[[nodiscard]] std::int64_t count_degenerate_faces(const BuildStats& stats,
                                                  const Policies& policies) noexcept;

/// Faces whose Newell vector, in double from the float coordinates, is exactly zero. O(H).
/// Errors     null_pointer, bad_stride, count_mismatch.
[[nodiscard]] Result<std::int64_t> count_zero_area_faces(const Connectivity& mesh,
                                                         Positions positions,
                                                         const Execution& execution);

}  // namespace hedgerow
