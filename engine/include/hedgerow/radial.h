#pragma once

#include <algorithm>
#include <utility>

#include "hedgerow/buffer.h"
#include "hedgerow/circulate.h"
#include "hedgerow/column.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/positions.h"
#include "hedgerow/result.h"

/// Edges with any number of faces: beside `opposite`, which joins two half-edges or none, a cycle
/// through all half-edges of an edge.
namespace hedgerow {

/// The half-edges round each edge, as a cycle. It is the half-edge form of K. Weiler, "The radial
/// edge structure", 1988.
///
/// Layout     One entry a half-edge. Two half-edges that are opposite are a cycle of two, a
///            half-edge alone on its edge a cycle of one: itself. All half-edges without a face
///            across that lie between the same two vertices are one cycle, whichever way they run,
///            together with the opposite ones between these vertices if there are any. A boundary
///            half-edge of the closed form is in no cycle: -1.
/// Order      Without positions ascending half-edge ids, and from the largest to the smallest. With
///            positions the angle of the faces round the edge: counter-clockwise to a viewer who
///            looks along the edge from its smaller vertex id to the larger. Equal angles come in
///            ascending id. Faces without an angle (no area, or an edge without length) come in
///            ascending id before the face of the smallest id that has one.
/// Lifetime   Owns its column; refers to the mesh by number only, and is void when that changes.
/// Threads    Any number of concurrent readers.
class RadialCycles {
 public:
  RadialCycles() noexcept = default;
  explicit RadialCycles(Buffer<Index>&& radial_next) noexcept : next_(std::move(radial_next)) {}

  /// The half-edge that follows round the edge of `h`. \pre `h` has a face
  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept { return column()[h]; }
  [[nodiscard]] Column<HalfedgeId, HalfedgeId> column() const noexcept {
    return {next_.data(), static_cast<Index>(next_.size())};
  }

 private:
  Buffer<Index> next_;
};

/// The cycles of any mesh, in the order of ids.
///
/// Complexity O(H), and for the n half-edges with no face across O(n) for each 11 bits of a vertex
///            id, and O(n log n). Bytes: reads 4 H and writes 4 H (as a copy of `opposite` does);
///            scratch 40 n.
/// Errors     Throws std::bad_alloc.
/// Threads    Those of `execution`; the same bytes for all of them.
[[nodiscard]] RadialCycles build_radial(const Connectivity& mesh, const Execution& execution);

/// The cycles of any mesh, in the order of angles, which are compared without an error whatever the
/// floats are. The side of the edge that a polygon lies on is that of its area: its Newell vector.
///
/// Complexity As above; an edge with k > 2 faces takes O(k log k) comparisons on one thread, each
///            O(1), or the degrees of two faces where rounding leaves it open. Scratch 72 bytes
///            more for each half-edge of such edges.
/// Errors     count_mismatch, bad_stride, null_pointer. Throws std::bad_alloc.
/// Threads    Those of `execution`; the same bytes for all of them.
[[nodiscard]] Result<RadialCycles> build_radial(const Connectivity& mesh, Positions positions,
                                                const Execution& execution);

namespace detail {

class RadialState {
 public:
  RadialState() noexcept = default;
  RadialState(const RadialCycles& cycles, HalfedgeId start) noexcept
      : cycles_(&cycles), start_(start), h_(start) {}
  [[nodiscard]] HalfedgeId value() const noexcept { return h_; }
  [[nodiscard]] bool is_done() const noexcept { return !h_.valid(); }
  void advance() noexcept {
    h_ = cycles_->next(h_);
    if (h_ == start_) h_ = HalfedgeId();
  }
  friend bool operator==(const RadialState& a, const RadialState& b) noexcept {
    return a.h_ == b.h_;
  }

 private:
  const RadialCycles* cycles_ = nullptr;
  HalfedgeId start_;
  HalfedgeId h_;
};

template <Topology Mesh>
class RadialFaceState : public RadialState {
 public:
  RadialFaceState() noexcept = default;
  RadialFaceState(const Mesh& mesh, const RadialCycles& cycles, HalfedgeId start) noexcept
      : RadialState(cycles, start), mesh_(&mesh) {}
  [[nodiscard]] FaceId value() const noexcept { return mesh_->face(RadialState::value()); }

 private:
  const Mesh* mesh_ = nullptr;
};

class FanState {
 public:
  FanState() noexcept = default;
  FanState(HalfedgeId first, FanTable others) noexcept : h_(first), others_(others) {}
  [[nodiscard]] HalfedgeId value() const noexcept { return h_; }
  [[nodiscard]] bool is_done() const noexcept { return !h_.valid(); }
  void advance() noexcept {
    h_ = others_.empty() ? HalfedgeId() : others_.front().start;
    if (!others_.empty()) others_ = others_.subspan(1);
  }
  friend bool operator==(const FanState& a, const FanState& b) noexcept { return a.h_ == b.h_; }

 private:
  HalfedgeId h_;
  FanTable others_;
};

}  // namespace detail

/// The smallest half-edge of the edge of `h`. O(faces round the edge). \pre `h` has a face
[[nodiscard]] inline HalfedgeId smallest_halfedge(const RadialCycles& cycles,
                                                  HalfedgeId h) noexcept {
  HalfedgeId smallest = h;
  for (HalfedgeId g = cycles.next(h); g != h; g = cycles.next(g)) smallest = std::min(smallest, g);
  return smallest;
}

/// The half-edges round the edge of `h` in cyclic order, from the smallest on: the same for each of
/// them. O(1) for each. \pre `h` has a face. Refers to `cycles`.
[[nodiscard]] inline auto halfedges_round_edge(const RadialCycles& cycles, HalfedgeId h) noexcept {
  return Circulation(detail::RadialState(cycles, smallest_halfedge(cycles, h)));
}

/// Their faces. A face that meets the edge twice comes twice. Refers to `mesh` and `cycles`.
template <Topology Mesh>
[[nodiscard]] auto faces_round_edge(const Mesh& mesh, const RadialCycles& cycles,
                                    HalfedgeId h) noexcept {
  return Circulation(detail::RadialFaceState(mesh, cycles, smallest_halfedge(cycles, h)));
}

/// Where the fans of `v` start, in the order of their smallest half-edges: none at an isolated
/// vertex, one at a manifold one. O(1) for each, and O(log fans) once.
template <Topology Mesh>
[[nodiscard]] auto fan_starts(const Mesh& mesh, VertexId v) noexcept {
  return Circulation(detail::FanState(mesh.outgoing[v], extra_fans(mesh.fans, v)));
}

/// Sets of faces as large as can be, joined across edges with exactly two faces.
struct Patches {
  Buffer<Index> label;  ///< the smallest face of the patch of f
  Index count = 0;
};

/// Two faces that run the same way along their edge are joined, too.
///
/// \pre       `cycles` are those of `mesh`.
/// Complexity O(F) joins, each O(log F) at the worst and a few steps in practice; reads 4 bytes a
///            half-edge. Besides the labels it takes F indices for each further thread.
/// Errors     Throws std::bad_alloc.
/// Threads    Those of `execution`; the same labels for all of them.
[[nodiscard]] Patches manifold_patches(const Connectivity& mesh, const RadialCycles& cycles,
                                       const Execution& execution);

}  // namespace hedgerow
