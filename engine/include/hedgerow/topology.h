#pragma once

#include <algorithm>
#include <concepts>
#include <span>
#include <type_traits>

#include "hedgerow/column.h"
#include "hedgerow/index.h"

namespace hedgerow {

/// One more fan of a vertex that has several: `outgoing[vertex]` starts the fan with the smallest
/// half-edge, and each other fan has one of these.
struct FanStart {
  VertexId vertex;
  HalfedgeId start;

  friend constexpr bool operator==(FanStart, FanStart) noexcept = default;
};

/// The extra fans, sorted by vertex and then by the smallest half-edge of the fan. Empty on a
/// manifold mesh.
using FanTable = std::span<const FanStart>;

/// The entries of `fans` that belong to `v`. O(log fans).
[[nodiscard]] inline FanTable extra_fans(FanTable fans, VertexId v) noexcept {
  if (fans.empty()) return {};
  struct ByVertex {
    bool operator()(FanStart fan, VertexId vertex) const noexcept { return fan.vertex < vertex; }
    bool operator()(VertexId vertex, FanStart fan) const noexcept { return vertex < fan.vertex; }
  };
  // Not std::ranges: clang 14 cannot compile a subrange of the gcc 12 library.
  const auto [first, last] = std::equal_range(fans.begin(), fans.end(), v, ByVertex{});
  return {first, last};
}

/// What can be asked of half-edges and faces, without a word about vertices.
///
/// `next(h)` is the successor round the face, counter-clockwise; `prev(h)` its inverse;
/// `opposite[h]` is invalid on the boundary of the default form; `face(h)` is invalid on a boundary
/// half-edge of the closed form.
template <class T>
concept FaceTopology = requires(const T& mesh, HalfedgeId h, FaceId f) {
  { mesh.halfedge_count() } -> std::same_as<Index>;
  { mesh.face_count() } -> std::same_as<Index>;
  { mesh.opposite[h] } -> std::same_as<HalfedgeId>;
  { mesh.next(h) } -> std::same_as<HalfedgeId>;
  { mesh.prev(h) } -> std::same_as<HalfedgeId>;
  { mesh.face(h) } -> std::same_as<FaceId>;
  { mesh.first(f) } -> std::same_as<HalfedgeId>;
  { mesh.degree(f) } -> std::same_as<Index>;
};

/// What a kernel may ask of a mesh. Both views below satisfy it, so each kernel is written once.
///
/// `target(h)` is `origin[next(h)]`; `outgoing[v]` is invalid if v is isolated.
template <class T>
concept Topology = FaceTopology<T> && requires(const T& mesh, HalfedgeId h, VertexId v) {
  { mesh.vertex_count() } -> std::same_as<Index>;
  { mesh.origin[h] } -> std::same_as<VertexId>;
  { mesh.outgoing[v] } -> std::same_as<HalfedgeId>;
  { mesh.target(h) } -> std::same_as<VertexId>;
  { mesh.fans } -> std::convertible_to<FanTable>;
};

/// A triangle mesh in the default form: half-edge 3f + k leaves corner k of face f, so `next` and
/// `face` are arithmetic and cost no memory traffic. 26 bytes a triangle on a closed mesh.
///
/// Lifetime   Valid until the `Connectivity` it views is changed or destroyed.
/// Threads    Any number of concurrent readers; no writer beside them.
struct TriangleView {
  Column<HalfedgeId, VertexId> origin;
  Column<HalfedgeId, HalfedgeId> opposite;
  Column<VertexId, HalfedgeId> outgoing;
  FanTable fans;

  [[nodiscard]] Index vertex_count() const noexcept { return outgoing.size(); }
  [[nodiscard]] Index halfedge_count() const noexcept { return origin.size(); }
  [[nodiscard]] Index face_count() const noexcept { return origin.size() / 3; }

  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept {
    return HalfedgeId(is_corner(h, 2) ? h.value - 2 : h.value + 1);
  }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept {
    return HalfedgeId(is_corner(h, 0) ? h.value + 2 : h.value - 1);
  }
  [[nodiscard]] VertexId target(HalfedgeId h) const noexcept { return origin[next(h)]; }
  [[nodiscard]] FaceId face(HalfedgeId h) const noexcept {
    // Without a sign, a quotient is one multiplication.
    return FaceId(static_cast<Index>(static_cast<std::make_unsigned_t<Index>>(h.value) / 3));
  }
  [[nodiscard]] HalfedgeId first(FaceId f) const noexcept { return HalfedgeId(3 * f.value); }
  [[nodiscard]] Index degree(FaceId) const noexcept { return 3; }

 private:
  // Without a sign, a remainder is compared by one multiplication.
  [[nodiscard]] static bool is_corner(HalfedgeId h, unsigned k) noexcept {
    return static_cast<std::make_unsigned_t<Index>>(h.value) % 3 == k;
  }
};

/// Any mesh, in either form, with every column stored. 54 bytes a triangle on a closed mesh.
///
/// Layout     `first_of` has one entry per face and one behind them, so that in the canonical form
///            the half-edges of face f are first_of[f] .. first_of[f + 1] - 1; in the closed form
///            the boundary half-edges follow those of the faces. `degree(f)` and `prev` of a
///            half-edge with a face are O(1); `prev` of a boundary half-edge rotates round its
///            origin, O(valence).
/// Lifetime   Valid until the `Connectivity` it views is changed or destroyed.
/// Threads    Any number of concurrent readers; no writer beside them.
struct PolygonView {
  Column<HalfedgeId, VertexId> origin;
  Column<HalfedgeId, HalfedgeId> opposite;
  Column<VertexId, HalfedgeId> outgoing;
  Column<HalfedgeId, HalfedgeId> next_of;
  Column<HalfedgeId, FaceId> face_of;
  Column<FaceId, HalfedgeId> first_of;
  FanTable fans;

  [[nodiscard]] Index vertex_count() const noexcept { return outgoing.size(); }
  [[nodiscard]] Index halfedge_count() const noexcept { return origin.size(); }
  [[nodiscard]] Index face_count() const noexcept { return first_of.size() - 1; }

  [[nodiscard]] HalfedgeId next(HalfedgeId h) const noexcept { return next_of[h]; }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const noexcept {
    const FaceId f = face_of[h];
    if (f.valid()) {
      return HalfedgeId(h == first_of[f] ? first_of[FaceId(f.value + 1)].value - 1 : h.value - 1);
    }
    // Loops are numbered in a row but for their ends.
    const HalfedgeId before(h.value - 1);
    if (before.valid() && next_of[before] == h) return before;
    HalfedgeId incoming = opposite[h];
    while (next_of[incoming] != h) incoming = opposite[next_of[incoming]];
    return incoming;
  }
  [[nodiscard]] VertexId target(HalfedgeId h) const noexcept { return origin[next_of[h]]; }
  [[nodiscard]] FaceId face(HalfedgeId h) const noexcept { return face_of[h]; }
  [[nodiscard]] HalfedgeId first(FaceId f) const noexcept { return first_of[f]; }
  [[nodiscard]] Index degree(FaceId f) const noexcept {
    return first_of[FaceId(f.value + 1)].value - first_of[f].value;
  }
};

static_assert(Topology<TriangleView> && Topology<PolygonView>);

}  // namespace hedgerow
