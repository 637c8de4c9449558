#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tl/expected.hpp>

#include "hedgerow/change.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/growing_column.h"
#include "hedgerow/index.h"
#include "hedgerow/result.h"
#include "hedgerow/topology.h"

namespace hedgerow {

/// Why an edit is not done. The mesh is as it was, to the last byte.
enum class Refusal : std::uint8_t {
  none,
  no_such_element,  ///< the element does not exist, or no longer
  boundary,         ///< the edge has no face on one side where it needs one, or has one too many
  same_face,        ///< both sides of the edge are of one face
  other_face,       ///< the two half-edges are not of one face
  adjacent,         ///< the two are neighbours already
  same_vertex,      ///< an edge would join a vertex to itself, or a face meet it twice
  duplicate_edge,   ///< there is such an edge already
  duplicate_face,   ///< two faces would have the same vertices
  link_condition,   ///< the two ends have a neighbour in common besides those across the edge
  several_fans,     ///< a vertex of the edit has several fans, or would have
  too_few_corners,  ///< a face would have fewer than three
  not_a_path,       ///< the half-edges do not follow each other, or meet a vertex twice
  too_many,         ///< there are as many elements as an `Index` can number
  other_state,      ///< the record is not of a mesh in this state
};
/// "link-condition"
[[nodiscard]] const char* name(Refusal refusal) noexcept;

/// Whether an edit can be done; if not, why, and at which element.
struct [[nodiscard]] EditCheck {
  Refusal reason = Refusal::none;
  Index element = kInvalidIndex;  ///< what the reason is about: a half-edge, vertex or face

  explicit operator bool() const noexcept { return reason == Refusal::none; }
  friend bool operator==(const EditCheck&, const EditCheck&) noexcept = default;
};

/// What an edit has changed, until the next one; or why it was not done.
using EditResult = tl::expected<const Change*, EditCheck>;

/// What became of the edges of a batch, each list in the order in which they were given.
struct EditBatch {
  const Change* change = nullptr;  ///< of all edits together, until the next one
  std::vector<HalfedgeId> done;
  std::vector<HalfedgeId> rest;     ///< possible, but one before it that was done stands in the way
  std::vector<HalfedgeId> refused;  ///< `can_...` says no
};

/// Old to new numbers of what `compact` kept; invalid for what is gone.
struct CompactMaps {
  std::vector<VertexId> vertices;
  std::vector<HalfedgeId> halfedges;
  std::vector<FaceId> faces;
};
struct Compacted {
  Connectivity mesh;
  CompactMaps maps;
};

/// An `EditMesh` as a `Topology`, in the closed form: ranges and questions work on it as on any
/// mesh. Numbers of removed elements are among those counted: ask `EditMesh::has` first.
/// Lifetime   Valid until the next edit.
struct EditView {
  Column<HalfedgeId, VertexId> origin;
  Column<HalfedgeId, HalfedgeId> opposite;
  Column<VertexId, HalfedgeId> outgoing;
  Column<HalfedgeId, HalfedgeId> next_of;
  Column<HalfedgeId, HalfedgeId> prev_of;
  Column<HalfedgeId, FaceId> face_of;
  Column<FaceId, HalfedgeId> first_of;
  FanTable fans;

  [[nodiscard]] Index vertex_count() const noexcept { return outgoing.size(); }
  [[nodiscard]] Index halfedge_count() const noexcept { return origin.size(); }
  [[nodiscard]] Index face_count() const noexcept { return first_of.size(); }
  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept { return next_of[h]; }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept { return prev_of[h]; }
  [[nodiscard]] VertexId target(HalfedgeId h) const noexcept { return origin[opposite[h]]; }
  [[nodiscard]] FaceId face(HalfedgeId h) const noexcept { return face_of[h]; }
  [[nodiscard]] HalfedgeId first(FaceId f) const noexcept { return first_of[f]; }
  [[nodiscard]] Index degree(FaceId f) const noexcept {
    Index count = 0;
    HalfedgeId h = first(f);
    do {
      ++count;
      h = next(h);
    } while (h != first(f));
    return count;
  }
};
static_assert(Topology<EditView>);

/// A mesh that can be changed, one local edit at a time. Move-only.
///
/// Form       Within, every edge has two half-edges, as in the closed form, and `prev` is stored.
///            `compact` gives the form back that the mesh came in.
/// Ids        What survives an edit keeps its number until `compact`; numbers of what was removed
///            are not used again before. New elements get the next numbers.
/// Guarantee  `can_...` says without a change whether an edit would be done. An edit that is
///            refused has changed nothing; one that is done leaves a sound mesh, without an edge
///            between two vertices that have one already, or from a vertex to itself.
/// Fans       At a vertex with several fans no edit is done but those far from it (several_fans);
///            the policy `split` of the builder makes such vertices into several.
/// Memory     28 bytes a half-edge and 8 a vertex (32-bit indices), growing; after `reserve` edits
///            allocate nothing as long as there is room.
/// Cost       Each edit is O(valence) and O(degree) of what it touches.
/// Threads    As of any object: one writer, or any number of readers.
///
/// What an edit touches: + born, - dead, ~ changed; no other. (h runs from a to b, o is opposite.)
///
///  flip           ~ h, o and the next of each; a, b; both faces
///  insert_vertex  + 1 vertex, 2 half-edges  ~ h, o and the next of each
///  split_edge     + 1 vertex, 2 to 6 half-edges, 0 to 2 faces  ~ half-edges of both faces
///  split_face     + 1 vertex, 2 n half-edges, n - 1 faces  ~ half-edges of the face
///  connect        + 2 half-edges, 1 face  ~ half-edges of the face
///  join_faces     - h, o, the face of o  ~ half-edges of that face; a, b
///  collapse       - a, h, o; of each triangle at h two more half-edges, and it  ~ what left a;
///                 half-edges of both faces; b, the vertices across
///  split_vertex   + 1 vertex, 2 half-edges  ~ half-edges that go over to the new vertex; a
///  add_vertex     + 1 vertex
///  remove_vertex  - the vertex, its faces, and their edges that have no other  ~ what is round it
///  add_face       + 1 face, 2 half-edges for each new edge  ~ boundary half-edges at its vertices
///  remove_face    - the face, and its edges that have no other  ~ its half-edges and vertices
///  cut            + a vertex for each that is passed or open, 2 half-edges for each edge  ~ half-
///                 edges on the right of the path
///  zip            - the target of the second edge, the boundary half-edges  ~ what left that
class EditMesh {
 public:
  /// A mesh without elements, in the default form.
  EditMesh() = default;
  /// Takes the columns over. O(H), on `execution`.
  /// \pre `mesh` is sound. Errors: too_many_elements. Throws std::bad_alloc.
  [[nodiscard]] static Result<EditMesh> of(const Connectivity& mesh, const Execution& execution);

  // Counted with the removed ones: what arrays beside the mesh have to hold.
  [[nodiscard]] Index vertex_count() const noexcept { return size(outgoing_); }
  [[nodiscard]] Index halfedge_count() const noexcept { return size(origin_); }
  [[nodiscard]] Index face_count() const noexcept { return size(first_); }
  [[nodiscard]] bool has(VertexId v) const noexcept {
    return is_index(v.value, outgoing_) && is_gone_[at(v.value)] == 0;
  }
  [[nodiscard]] bool has(HalfedgeId h) const noexcept {
    return is_index(h.value, next_) && next_[at(h.value)] != kInvalidIndex;
  }
  [[nodiscard]] bool has(FaceId f) const noexcept {
    return is_index(f.value, first_) && first_[at(f.value)] != kInvalidIndex;
  }
  [[nodiscard]] EditView view() const noexcept {
    return {{origin_.data(), halfedge_count()}, {opposite_.data(), halfedge_count()},
            {outgoing_.data(), vertex_count()}, {next_.data(), halfedge_count()},
            {prev_.data(), halfedge_count()},   {face_.data(), halfedge_count()},
            {first_.data(), face_count()},      fans_};
  }
  /// The half-edge from `a` to `b`, invalid if there is none. O(valence of a).
  [[nodiscard]] HalfedgeId find(VertexId a, VertexId b) const noexcept;

  /// Room for so many elements in all, and for records of `writes` changed entries.
  void reserve(Index vertices, Index halfedges, Index faces, Index writes = 256);
  /// Whether edits fill their record; without, they take half of the time, and can neither be
  /// undone nor replayed.
  void set_recording(bool is_recording) noexcept { is_recording_ = is_recording; }
  [[nodiscard]] bool is_recording() const noexcept { return is_recording_; }

  /// Turns the edge of h by one corner in its two faces; in two triangles, to the other diagonal.
  [[nodiscard]] EditCheck can_flip(HalfedgeId h) const;
  EditResult flip(HalfedgeId h);

  // A batch does those edges of `wanted` that do not meet, an earlier one before a later one; the
  // rest is for the next round. What it does is the same, to the last byte, as those edits one
  // after the other in their order, on every execution; with a record it is done like that. O(sum
  // of valences and degrees, and a bit for each vertex, half-edge or face). Throws std::bad_alloc,
  // and has then changed nothing.

  /// Flips meet if they have a face in common, or make an edge between the same two vertices.
  EditBatch flip_batch(std::span<const HalfedgeId> wanted, const Execution& execution);
  /// Collapses meet if an end of one has a face or an edge in common with an end of the other.
  EditBatch collapse_batch(std::span<const HalfedgeId> wanted, const Execution& execution);
  /// Splits of edges meet if they have a triangle in common, or are of one edge.
  EditBatch split_batch(std::span<const HalfedgeId> wanted, const Execution& execution);

  /// A vertex in the middle of the edge of h: both faces have one corner more. h ends there.
  [[nodiscard]] EditCheck can_insert_vertex(HalfedgeId h) const;
  EditResult insert_vertex(HalfedgeId h);
  /// The same, and joined to the vertex across in each triangle.
  [[nodiscard]] EditCheck can_split_edge(HalfedgeId h) const;
  EditResult split_edge(HalfedgeId h);
  /// A vertex within f, joined to all its corners. The triangle of `first(f)` stays f.
  [[nodiscard]] EditCheck can_split_face(FaceId f) const;
  EditResult split_face(FaceId f);

  /// Cuts the face of h and g in two by an edge between their origins. What follows h stays.
  [[nodiscard]] EditCheck can_connect(HalfedgeId h, HalfedgeId g) const;
  EditResult connect(HalfedgeId h, HalfedgeId g);
  /// Removes the edge of h: its two faces become one, that of h.
  [[nodiscard]] EditCheck can_join_faces(HalfedgeId h) const;
  EditResult join_faces(HalfedgeId h);

  /// Moves the origin of h into its target: the edge is gone, and so are triangles on it. The test
  /// is the link condition of T. Dey et al., "Topology preserving edge contraction", 1999, for
  /// faces of any degree.
  [[nodiscard]] EditCheck can_collapse(HalfedgeId h) const;
  EditResult collapse(HalfedgeId h);
  /// Its inverse: a new vertex takes the half-edges from h on, clockwise, up to the one before g,
  /// and an edge from it to the old vertex. The faces right of h and of g have one corner more.
  [[nodiscard]] EditCheck can_split_vertex(HalfedgeId h, HalfedgeId g) const;
  EditResult split_vertex(HalfedgeId h, HalfedgeId g);

  /// A vertex without edges.
  [[nodiscard]] EditCheck can_add_vertex() const;
  EditResult add_vertex();
  /// Removes v with all faces at it.
  [[nodiscard]] EditCheck can_remove_vertex(VertexId v) const;
  EditResult remove_vertex(VertexId v);

  /// A face with these corners, counter-clockwise, along edges that have no face on that side, or
  /// none at all yet.
  [[nodiscard]] EditCheck can_add_face(std::span<const VertexId> corners) const;
  EditResult add_face(std::span<const VertexId> corners);
  /// Edges that no other face has go with it; vertices stay.
  [[nodiscard]] EditCheck can_remove_face(FaceId f) const;
  EditResult remove_face(FaceId f);

  /// Cuts the mesh open along half-edges that follow each other. Vertices that are passed, and ends
  /// on the boundary, are doubled: the old ones stay on the left.
  [[nodiscard]] EditCheck can_cut(std::span<const HalfedgeId> path) const;
  EditResult cut(std::span<const HalfedgeId> path);
  /// Its inverse, edge by edge: sews the boundary half-edge h to the one after it. The target of
  /// that becomes the origin of h. The other two of a hole of four are sewn as well; of two edges
  /// without any face one is left.
  [[nodiscard]] EditCheck can_zip(HalfedgeId h) const;
  EditResult zip(HalfedgeId h);

  /// Takes back the last edit that is not taken back, which was this. \pre is complete: recorded
  [[nodiscard]] EditCheck undo(const Change& change);
  /// Does again what another mesh in the same state did.
  [[nodiscard]] EditCheck replay(const Change& change);

  /// The mesh with new numbers: vertices and faces in their order, half-edges canonical, in the
  /// form that the mesh came in. O(H). Errors: not_canonical where dangling edges have no place in
  /// that form. The edits may go on here, on the old numbers.
  [[nodiscard]] Result<Compacted> compact() const;

 private:
  friend class Edit;

  static std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }
  static Index size(const GrowingColumn& column) noexcept {
    return static_cast<Index>(column.size());
  }
  static bool is_index(Index i, const GrowingColumn& column) noexcept {
    return i >= 0 && i < size(column);
  }
  [[nodiscard]] GrowingColumn& column(EditColumn which) noexcept;

  GrowingColumn origin_;
  GrowingColumn opposite_;
  GrowingColumn next_;  // -1: removed
  GrowingColumn prev_;
  GrowingColumn face_;
  GrowingColumn outgoing_;
  GrowingColumn is_gone_;  // of a vertex; one without edges has no other mark
  GrowingColumn first_;    // -1: removed
  std::vector<FanStart> fans_;
  Form form_ = Form::open;  // to go back to
  bool is_recording_ = true;
  Change change_;
  std::vector<HalfedgeId> sides_;  // of a face that is being added
};

}  // namespace hedgerow
