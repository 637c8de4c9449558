#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <ranges>
#include <type_traits>

#include "hedgerow/index.h"
#include "hedgerow/topology.h"

/// What the ranges of hedgerow/circulate.h are made of: where a walk is, and how it goes on.
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

// Of triangles in the default form there is nothing to skip, and one division a step tells both the
// face and where in it the walk goes on.
template <>
class IncidentFaceState<TriangleView> {
 public:
  IncidentFaceState() noexcept = default;
  IncidentFaceState(const TriangleView& mesh, VertexId v) noexcept
      : mesh_(&mesh), others_(extra_fans(mesh.fans, v)) {
    enter(mesh.outgoing[v]);
  }

  [[nodiscard]] FaceId value() const noexcept { return face_; }
  [[nodiscard]] bool is_done() const noexcept { return !h_.valid(); }
  void advance() noexcept {
    const HalfedgeId opposite = mesh_->opposite[h_];
    if (opposite.valid()) {
      face_ = mesh_->face(opposite);
      const HalfedgeId first = mesh_->first(face_);
      h_ = HalfedgeId(opposite.value == first.value + 2 ? first.value : opposite.value + 1);
      if (h_ != start_) return;
    }
    if (others_.empty()) {
      h_ = HalfedgeId();
    } else {
      const HalfedgeId start = others_.front().start;
      others_ = others_.subspan(1);
      enter(start);
    }
  }
  friend bool operator==(const IncidentFaceState& a, const IncidentFaceState& b) noexcept {
    return a.h_ == b.h_;
  }

 private:
  void enter(HalfedgeId start) noexcept {
    h_ = start_ = start;
    face_ = mesh_->face(start);
  }

  const TriangleView* mesh_ = nullptr;
  HalfedgeId h_;
  HalfedgeId start_;
  FaceId face_;
  FanTable others_;
};

// The half-edges of a triangle in the default form, or the vertices that they leave.
template <bool is_vertex>
class TriangleState {
 public:
  TriangleState() noexcept = default;
  TriangleState(const TriangleView& mesh, FaceId f) noexcept
      : mesh_(&mesh), h_(mesh.first(f)), end_(h_.value + 3) {}

  [[nodiscard]] auto value() const noexcept {
    if constexpr (is_vertex) {
      return mesh_->origin[h_];
    } else {
      return h_;
    }
  }
  [[nodiscard]] bool is_done() const noexcept { return h_.value == end_; }
  void advance() noexcept { ++h_.value; }
  friend bool operator==(const TriangleState& a, const TriangleState& b) noexcept {
    return a.h_ == b.h_;
  }

 private:
  const TriangleView* mesh_ = nullptr;
  HalfedgeId h_;
  Index end_ = kInvalidIndex;
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

}  // namespace hedgerow
