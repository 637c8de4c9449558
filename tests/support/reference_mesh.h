#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "hedgerow/build.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/defect.h"
#include "hedgerow/result.h"

/// The oracle: a mesh from a face list with ordered maps, as slow and as plain as it can be,
/// written from the contracts and not from the engine.
namespace hedgerow::test {

/// Faces as lists of vertices, as a caller wrote them.
struct PlainFaces {
  std::vector<std::vector<std::int64_t>> faces;
  std::int64_t vertex_count = 0;
};

/// Columns of a mesh in either form; all of them stored.
struct ReferenceMesh {
  std::vector<Index> origin;
  std::vector<Index> opposite;
  std::vector<Index> next;
  std::vector<Index> prev;
  std::vector<Index> face;
  std::vector<Index> first;  ///< one behind the last face, too
  std::vector<Index> outgoing;
  std::vector<FanStart> fans;
  Form form = Form::open;

  [[nodiscard]] Index vertex_count() const { return static_cast<Index>(outgoing.size()); }
  [[nodiscard]] Index halfedge_count() const { return static_cast<Index>(origin.size()); }
  [[nodiscard]] Index face_count() const { return static_cast<Index>(first.size()) - 1; }
  [[nodiscard]] bool is_all_triangles() const;
  /// The vertices of each face, in the order of its corners.
  [[nodiscard]] std::vector<std::vector<Index>> faces() const;
  /// Where the rotations round `v` start: `outgoing`, then the entries of `fans`.
  [[nodiscard]] std::vector<Index> fan_starts(Index v) const;
};

/// Edges by their vertices, smaller first, with their half-edges in ascending order.
using EdgeMap = std::map<std::pair<Index, Index>, std::vector<Index>>;
[[nodiscard]] EdgeMap edges_of(const ReferenceMesh& mesh);

/// How many groups the faces at `v` form when joined across the edges they share there.
/// group_of[f] is the smallest half-edge leaving `v` in the group of face f.
[[nodiscard]] std::map<Index, Index> groups_at(const ReferenceMesh& mesh, const EdgeMap& edges,
                                               Index v);

/// Pairs, fans and columns of good faces; `is_cut` has one entry a face or is empty.
[[nodiscard]] ReferenceMesh reference_mesh(const std::vector<std::vector<Index>>& faces,
                                           Index vertex_count,
                                           const std::vector<bool>& is_cut = {});

/// The same mesh in the closed form, as `close_boundary` numbers it.
[[nodiscard]] ReferenceMesh reference_closed(const ReferenceMesh& mesh);

struct ReferenceBuild {
  ReferenceMesh mesh;
  std::vector<Defect> defects;
  std::vector<Index> faces_new_to_old;     ///< empty: none was dropped
  std::vector<Index> vertices_new_to_old;  ///< empty: the same numbers
  std::int64_t edge_count = 0;
  std::int64_t boundary_edge_count = 0;
};

/// What `build` must return for these faces and policies.
[[nodiscard]] Result<ReferenceBuild> reference_build(const PlainFaces& input,
                                                     const Policies& policies);

/// A `Connectivity` with these columns. An all-triangle mesh in the default form is implicit unless
/// `store_all`.
[[nodiscard]] Connectivity to_connectivity(const ReferenceMesh& mesh, bool store_all = false);

/// The columns behind `to_connectivity`, for tests that spoil them first.
[[nodiscard]] ConnectivityColumns to_columns(const ReferenceMesh& mesh, bool store_all = false);

/// The connectivity report of a mesh, counted from its faces alone.
struct ReferenceSummary {
  std::int64_t edges = 0;
  std::int64_t boundary_edges = 0;
  std::int64_t nonmanifold_edges = 0;
  std::int64_t inconsistent_edges = 0;
  std::int64_t isolated_vertices = 0;
  std::int64_t nonmanifold_vertices = 0;
  std::int64_t duplicate_faces = 0;
  std::int64_t components = 0;
  std::int64_t euler = 0;
  std::optional<std::int64_t> boundary_loops;
  std::optional<std::int64_t> genus;
  std::int64_t valence_min = 0;
  std::int64_t valence_max = 0;
};
[[nodiscard]] ReferenceSummary reference_summary(const ReferenceMesh& open_mesh);

/// labels[v] is the smallest vertex that v hangs together with; -1 for an isolated vertex.
[[nodiscard]] std::vector<Index> reference_components(const ReferenceMesh& mesh);

}  // namespace hedgerow::test
