#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <ranges>
#include <type_traits>

#include "hedgerow/index.h"
#include "hedgerow/topology.h"

/// Ranges round a vertex, a face and a hole, for range-for and for the algorithms of std::ranges.
///
/// All of them work on both views and in both forms, follow `opposite` and `next` alone, visit
/// every fan of a vertex, and are empty at an isolated one. At a boundary vertex the default form
/// and the closed form give the same neighbours and faces in the same order; the closed form has
/// boundary half-edges to visit besides.
///
/// Pre        The mesh is sound, as `validate` says, and the element is one of its own.
/// Cost       A few registers, nothing allocated; O(1) for each element but where said otherwise,
///            and O(log fans) once at a vertex of a mesh with several fans anywhere. A step round a
///            vertex reads `opposite` and a stored `next`; a neighbour reads `origin` besides.
/// Threads    Any number of ranges over one mesh at a time; no writer beside them.
/// Lifetime   A range refers to the view it was made from: a named one, which must outlive it.
namespace hedgerow {

/// Sense of a rotation, seen from outside of the surface.
enum class Rotation : std::uint8_t {
  clockwise,          ///< next[opposite[h]]: the way `outgoing` is stored for
  counter_clockwise,  ///< opposite[prev[h]]: on the boundary, starts at the far end of the fan
};

/// A forward range over the states of a walk. `State` has value(), is_done(), advance() and ==.
template <class State>
class Circulation : public std::ranges::view_base {
 public:
  class iterator {
   public:
    using value_type = decltype(std::declval<const State&>().value());
    using difference_type = std::ptrdiff_t;
    using iterator_concept = std::forward_iterator_tag;
    using iterator_category = std::input_iterator_tag;
    using reference = value_type;
    using pointer = void;

    constexpr iterator() noexcept = default;
    constexpr explicit iterator(const State& state) noexcept : state_(state) {}

    [[nodiscard]] constexpr value_type operator*() const noexcept { return state_.value(); }
    constexpr iterator& operator++() noexcept {
      state_.advance();
      return *this;
    }
    constexpr iterator operator++(int) noexcept {
      iterator before = *this;
      ++*this;
      return before;
    }
    friend constexpr bool operator==(const iterator& i, std::default_sentinel_t) noexcept {
      return i.state_.is_done();
    }
    friend constexpr bool operator==(const iterator& a, const iterator& b) noexcept {
      return a.state_ == b.state_;
    }

   private:
    State state_;
  };

  constexpr Circulation() noexcept = default;
  constexpr explicit Circulation(const State& state) noexcept : state_(state) {}

  [[nodiscard]] constexpr iterator begin() const noexcept { return iterator(state_); }
  [[nodiscard]] constexpr std::default_sentinel_t end() const noexcept { return {}; }
  [[nodiscard]] constexpr bool empty() const noexcept { return state_.is_done(); }

 private:
  State state_;
};

/// True if `start` is the open end of a fan in the default form: nothing lies counter-clockwise of
/// it, so that the edge it would share there has no half-edge leaving the vertex.
template <FaceTopology Mesh>
[[nodiscard]] inline bool is_open_start(const Mesh& mesh, HalfedgeId start) noexcept {
  return mesh.face(start).valid() && !mesh.opposite[mesh.prev(start)].valid();
}

namespace detail {

template <Topology Mesh, Rotation rotation>
class OutgoingState {
 public:
  OutgoingState() noexcept = default;
  OutgoingState(const Mesh& mesh, VertexId v) noexcept
      : mesh_(&mesh), others_(extra_fans(mesh.fans, v)) {
    enter(mesh.outgoing[v]);
  }

  [[nodiscard]] HalfedgeId value() const noexcept { return h_; }
  [[nodiscard]] bool is_done() const noexcept { return !h_.valid(); }
  [[nodiscard]] bool is_fan_start() const noexcept { return h_ == start_; }
  void advance() noexcept {
    h_ = step(h_);
    if (h_.valid() && h_ != start_) return;
    if (others_.empty()) {
      h_ = HalfedgeId();
    } else {
      const HalfedgeId start = others_.front().start;
      others_ = others_.subspan(1);
      enter(start);
    }
  }
  friend bool operator==(const OutgoingState& a, const OutgoingState& b) noexcept {
    return a.h_ == b.h_;
  }

 private:
  [[nodiscard]] HalfedgeId step(HalfedgeId h) const noexcept {
    if constexpr (rotation == Rotation::counter_clockwise) {
      return mesh_->opposite[mesh_->prev(h)];
    } else {
      const HalfedgeId opposite = mesh_->opposite[h];
      return opposite.valid() ? mesh_->next(opposite) : opposite;
    }
  }
  void enter(HalfedgeId start) noexcept {
    if constexpr (rotation == Rotation::counter_clockwise) {
      if (start.valid() && is_open_start(*mesh_, start)) {
        while (mesh_->opposite[start].valid()) start = mesh_->next(mesh_->opposite[start]);
      }
    }
    h_ = start_ = start;
  }

  const Mesh* mesh_ = nullptr;
  HalfedgeId h_;
  HalfedgeId start_;
  FanTable others_;
};

template <Topology Mesh>
class NeighbourState {
 public:
  NeighbourState() noexcept = default;
  NeighbourState(const Mesh& mesh, VertexId v) noexcept : mesh_(&mesh), at_(mesh, v) { enter(); }

  // The opposite half-edge is where the walk goes next, so its origin costs no arithmetic.
  [[nodiscard]] VertexId value() const noexcept {
    if (is_behind_) return mesh_->origin[mesh_->prev(at_.value())];
    const HalfedgeId opposite = mesh_->opposite[at_.value()];
    return opposite.valid() ? mesh_->origin[opposite] : mesh_->target(at_.value());
  }
  [[nodiscard]] bool is_done() const noexcept { return at_.is_done(); }
  void advance() noexcept {
    if (is_behind_) {
      is_behind_ = false;
      return;
    }
    at_.advance();
    enter();
  }
  friend bool operator==(const NeighbourState& a, const NeighbourState& b) noexcept {
    return a.at_ == b.at_ && a.is_behind_ == b.is_behind_;
  }

 private:
  void enter() noexcept {
    is_behind_ = !at_.is_done() && at_.is_fan_start() && is_open_start(*mesh_, at_.value());
  }

  const Mesh* mesh_ = nullptr;
  OutgoingState<Mesh, Rotation::clockwise> at_;
  bool is_behind_ = false;  // at the neighbour behind the open end of the fan
};

template <Topology Mesh>
class IncidentFaceState {
 public:
  IncidentFaceState() noexcept = default;
  IncidentFaceState(const Mesh& mesh, VertexId v) noexcept : mesh_(&mesh), at_(mesh, v) { skip(); }

  [[nodiscard]] FaceId value() const noexcept { return mesh_->face(at_.value()); }
  [[nodiscard]] bool is_done() const noexcept { return at_.is_done(); }
  void advance() noexcept {
    at_.advance();
    skip();
  }
  friend bool operator==(const IncidentFaceState& a, const IncidentFaceState& b) noexcept {
    return a.at_ == b.at_;
  }

 private:
  void skip() noexcept {
    while (!at_.is_done() && !mesh_->face(at_.value()).valid()) at_.advance();
  }

  const Mesh* mesh_ = nullptr;
  OutgoingState<Mesh, Rotation::clockwise> at_;
};

// Round a face by `next`, or round a hole: by `next` in the closed form, and in the default form by
// the rotation that leads from one half-edge without opposite to the next.
template <FaceTopology Mesh, bool is_hole>
class LoopState {
 public:
  LoopState() noexcept = default;
  LoopState(const Mesh& mesh, HalfedgeId start) noexcept : mesh_(&mesh), h_(start), start_(start) {}

  [[nodiscard]] HalfedgeId value() const noexcept { return h_; }
  [[nodiscard]] const Mesh& mesh() const noexcept { return *mesh_; }
  [[nodiscard]] bool is_done() const noexcept { return !h_.valid(); }
  void advance() noexcept {
    const bool is_side_of_face = is_hole && mesh_->face(h_).valid();
    h_ = mesh_->next(h_);
    if (is_side_of_face) {
      while (mesh_->opposite[h_].valid()) h_ = mesh_->next(mesh_->opposite[h_]);
    }
    if (h_ == start_) h_ = HalfedgeId();
  }
  friend bool operator==(const LoopState& a, const LoopState& b) noexcept { return a.h_ == b.h_; }

 private:
  const Mesh* mesh_ = nullptr;
  HalfedgeId h_;
  HalfedgeId start_;
};

template <Topology Mesh>
class FaceVertexState : public LoopState<Mesh, false> {
 public:
  using LoopState<Mesh, false>::LoopState;
  [[nodiscard]] VertexId value() const noexcept {
    return this->mesh().origin[LoopState<Mesh, false>::value()];
  }
};

template <FaceTopology Mesh>
class AdjacentFaceState {
 public:
  AdjacentFaceState() noexcept = default;
  AdjacentFaceState(const Mesh& mesh, HalfedgeId start) noexcept : at_(mesh, start) { skip(); }

  [[nodiscard]] FaceId value() const noexcept {
    const HalfedgeId opposite = at_.mesh().opposite[at_.value()];
    return opposite.valid() ? at_.mesh().face(opposite) : FaceId();
  }
  [[nodiscard]] bool is_done() const noexcept { return at_.is_done(); }
  void advance() noexcept {
    at_.advance();
    skip();
  }
  friend bool operator==(const AdjacentFaceState& a, const AdjacentFaceState& b) noexcept {
    return a.at_ == b.at_;
  }

 private:
  void skip() noexcept {
    while (!at_.is_done() && !value().valid()) at_.advance();
  }

  LoopState<Mesh, false> at_;
};

}  // namespace detail

/// The half-edges that leave `v`, fan by fan. In counter-clockwise rotation an open fan is walked
/// once more to find where it begins, and each boundary half-edge of the closed form costs a
/// rotation where `PolygonView::prev` has to look for its predecessor.
template <Rotation rotation = Rotation::clockwise, Topology Mesh>
[[nodiscard]] inline auto outgoing_halfedges(const Mesh& mesh, VertexId v) noexcept {
  return Circulation(detail::OutgoingState<Mesh, rotation>(mesh, v));
}

/// The vertices that share an edge with `v`, clockwise in each fan, from the one behind the open
/// end of the fan where there is one. A neighbour across an edge that is cut comes once for each
/// side.
template <Topology Mesh>
[[nodiscard]] inline auto neighbours(const Mesh& mesh, VertexId v) noexcept {
  return Circulation(detail::NeighbourState<Mesh>(mesh, v));
}

/// The faces at `v`, clockwise in each fan, each once.
template <Topology Mesh>
[[nodiscard]] inline auto incident_faces(const Mesh& mesh, VertexId v) noexcept {
  return Circulation(detail::IncidentFaceState<Mesh>(mesh, v));
}

/// The half-edges of the face of `h`, counter-clockwise from `h`; for a half-edge without a face,
/// those of its hole.
template <FaceTopology Mesh>
[[nodiscard]] inline auto halfedges_from(const Mesh& mesh, HalfedgeId h) noexcept {
  return Circulation(detail::LoopState<Mesh, false>(mesh, h));
}

/// The half-edges of `f`, counter-clockwise from `first(f)`.
template <FaceTopology Mesh>
[[nodiscard]] inline auto halfedges(const Mesh& mesh, FaceId f) noexcept {
  return halfedges_from(mesh, mesh.first(f));
}

/// The vertices of `f`, counter-clockwise from the origin of `first(f)`.
template <Topology Mesh>
[[nodiscard]] inline auto vertices(const Mesh& mesh, FaceId f) noexcept {
  return Circulation(detail::FaceVertexState<Mesh>(mesh, mesh.first(f)));
}

/// The faces across the edges of `f`, where there is one: a face once for each edge shared with it.
template <FaceTopology Mesh>
[[nodiscard]] inline auto adjacent_faces(const Mesh& mesh, FaceId f) noexcept {
  return Circulation(detail::AdjacentFaceState<Mesh>(mesh, mesh.first(f)));
}

/// The boundary loop through the boundary half-edge `h`. In the default form these are half-edges
/// of faces and run their way; in the closed form those of the hole, the other way round, passing
/// along both sides of a dangling edge. Linear over a whole loop.
///
/// \pre opposite[h] is invalid (default form), or face(h) is (closed form).
template <FaceTopology Mesh>
[[nodiscard]] inline auto boundary_loop(const Mesh& mesh, HalfedgeId h) noexcept {
  return Circulation(detail::LoopState<Mesh, true>(mesh, h));
}

/// Calls `visit(v, u)` for the vertices v of a mesh and the neighbours u of each, as often as
/// `neighbours` names them, by one pass over `halfedges`: those of v in ascending half-edge id, not
/// in rotation. Where all rings are wanted and their order is not, this reads memory from end to
/// end instead of hopping through it.
///
/// Complexity O(halfedges); reads `origin` and `opposite`, and a stored `next`.
/// Threads    Ranges that partition the half-edges meet the same vertices: give each thread an
///            array of its own to add to, and add these up afterwards.
template <Topology Mesh, class Visit>
void for_each_neighbour(const Mesh& mesh, IndexRange halfedges, Visit&& visit) {
  const auto visit_edge = [&](HalfedgeId h, VertexId from, VertexId to) {
    visit(from, to);
    if (!mesh.opposite[h].valid()) visit(to, from);
  };
  Index i = halfedges.begin;
  if constexpr (std::is_same_v<Mesh, TriangleView>) {
    // Face by face there is no remainder to find.
    for (; i < halfedges.end && i % 3 != 0; ++i) {
      visit_edge(HalfedgeId(i), mesh.origin[HalfedgeId(i)], mesh.target(HalfedgeId(i)));
    }
    for (; i + 3 <= halfedges.end; i += 3) {
      const VertexId a = mesh.origin[HalfedgeId(i)];
      const VertexId b = mesh.origin[HalfedgeId(i + 1)];
      const VertexId c = mesh.origin[HalfedgeId(i + 2)];
      visit_edge(HalfedgeId(i), a, b);
      visit_edge(HalfedgeId(i + 1), b, c);
      visit_edge(HalfedgeId(i + 2), c, a);
    }
  }
  for (; i < halfedges.end; ++i) {
    visit_edge(HalfedgeId(i), mesh.origin[HalfedgeId(i)], mesh.target(HalfedgeId(i)));
  }
}

// A view that is not named would be gone before the range is used.
template <Rotation rotation = Rotation::clockwise, Topology Mesh>
void outgoing_halfedges(const Mesh&& mesh, VertexId v) = delete;
template <Topology Mesh>
void neighbours(const Mesh&& mesh, VertexId v) = delete;
template <Topology Mesh>
void incident_faces(const Mesh&& mesh, VertexId v) = delete;
template <FaceTopology Mesh>
void halfedges_from(const Mesh&& mesh, HalfedgeId h) = delete;
template <FaceTopology Mesh>
void halfedges(const Mesh&& mesh, FaceId f) = delete;
template <Topology Mesh>
void vertices(const Mesh&& mesh, FaceId f) = delete;
template <FaceTopology Mesh>
void adjacent_faces(const Mesh&& mesh, FaceId f) = delete;
template <FaceTopology Mesh>
void boundary_loop(const Mesh&& mesh, HalfedgeId h) = delete;

}  // namespace hedgerow
