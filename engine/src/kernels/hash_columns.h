#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "hedgerow/index.h"
#include "hedgerow/topology.h"

/// Hashes of parts of a mesh. They write nothing, so any ranges may run side by side.
namespace hedgerow::kernels {

/// Takes `value` into `state`. For a fixed state no two values give the same result, and for a
/// fixed value no two states do: two inputs that differ in one place never collide.
[[nodiscard]] constexpr std::uint64_t hash_step(std::uint64_t state, std::uint64_t value) noexcept {
  const std::uint64_t product = (state ^ value) * 0x9fb21c651e98df25U;
  return product ^ (product >> 32U);
}

/// Indices are hashed as 64 bits, whatever their width in memory.
[[nodiscard]] constexpr std::uint64_t hash_step(std::uint64_t state, Index value) noexcept {
  return hash_step(state, static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
}

inline constexpr std::array<std::uint64_t, 4> kHashSeeds = {
    0x243f6a8885a308d3U, 0x13198a2e03707344U, 0xa4093822299f31d0U, 0x082efa98ec4e6c89U};

/// Hash of origin, next, opposite and face of the half-edges in `range`. One chain for each column:
/// four multiplications run at the same time, where a single chain would wait for each.
template <Topology Mesh>
[[nodiscard]] std::uint64_t hash_halfedges(IndexRange range, const Mesh& mesh) noexcept {
  std::array<std::uint64_t, 4> state = kHashSeeds;
  for (Index i = range.begin; i < range.end; ++i) {
    const HalfedgeId h(i);
    state[0] = hash_step(state[0], mesh.origin[h].value);
    state[1] = hash_step(state[1], mesh.next(h).value);
    state[2] = hash_step(state[2], mesh.opposite[h].value);
    state[3] = hash_step(state[3], mesh.face(h).value);
  }
  std::uint64_t all = state[0];
  for (std::size_t k = 1; k < state.size(); ++k) all = hash_step(std::rotl(all, 17), state[k]);
  return all;
}

/// Hash of outgoing of the vertices in `range`.
template <Topology Mesh>
[[nodiscard]] std::uint64_t hash_vertices(IndexRange range, const Mesh& mesh) noexcept {
  std::uint64_t state = kHashSeeds[1];
  for (Index v = range.begin; v < range.end; ++v) {
    state = hash_step(state, mesh.outgoing[VertexId(v)].value);
  }
  return state;
}

/// Hash of first of the faces in `range`.
template <Topology Mesh>
[[nodiscard]] std::uint64_t hash_faces(IndexRange range, const Mesh& mesh) noexcept {
  std::uint64_t state = kHashSeeds[2];
  for (Index f = range.begin; f < range.end; ++f) {
    state = hash_step(state, mesh.first(FaceId(f)).value);
  }
  return state;
}

}  // namespace hedgerow::kernels
