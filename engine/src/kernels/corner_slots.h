#pragma once

#include <span>

#include "kernels/corner_blocks.h"

/// Bringing the corners of each vertex together, one block of vertices at a time.
namespace hedgerow::kernels {

/// Room for the first corners of one vertex, by column, so that eight of a kind are one vector.
/// Most vertices have no more; what does not fit goes to a list that all vertices share.
struct alignas(32) CornerSlot {
  static constexpr Index kCapacity = 8;
  Index source[kCapacity];
  Index target[kCapacity];
  Index halfedge[kCapacity];
  Index incoming[kCapacity];

  [[nodiscard]] Corner corner(Index i) const noexcept {
    return {halfedge[i], target[i], source[i], incoming[i]};
  }
};
static_assert(sizeof(CornerSlot) == 32 * sizeof(Index));

/// Vertices [begin, begin + size) of one block.
struct VertexBlock {
  Index begin = 0;
  Index size = 0;
};

/// The corners of a block while they are collected. Vertex block.begin + i has count[i] of them,
/// in ascending half-edge order: the first in slot[i], the others in `overflow`.
struct CornerSlots {
  VertexBlock block;
  CornerSlot* slot = nullptr;
  Index* count = nullptr;
  LooseCorner* overflow = nullptr;  ///< in the order in which they came
  Index overflow_count = 0;
};

/// Adds one corner of vertex v. Inlined always, so that sources compiled for wider registers define
/// no function that others could be linked to.
[[gnu::always_inline]] inline void add_corner(Index v, const Corner& corner,
                                              CornerSlots& slots) noexcept {
  const Index local = v - slots.block.begin;
  const Index n = slots.count[local]++;
  if (n >= CornerSlot::kCapacity) {
    slots.overflow[slots.overflow_count++] = {v, corner};
    return;
  }
  CornerSlot& slot = slots.slot[local];
  slot.source[n] = corner.source;
  slot.target[n] = corner.target;
  slot.halfedge[n] = corner.halfedge;
  slot.incoming[n] = corner.incoming;
}

/// Empties the slots: no corners, and sources that equal no vertex.
void clear_slots(CornerSlots& slots) noexcept;

/// Whether faces may have corners outside the block.
enum class Faces { some_outside, all_inside };

/// Adds the corners of the faces in `range` that belong to the block.
/// \pre `overflow` has room for all of them.
void place_corners(IndexRange range, const FaceColumns& faces, Faces where,
                   CornerSlots& slots) noexcept;

/// The plain form for faces of which some are outside, and one for triangles that asks eight of
/// them at once. \pre of the second: `has_avx2()`
void place_corners_scalar(IndexRange range, const FaceColumns& faces, CornerSlots& slots) noexcept;
void place_triangles_avx2(IndexRange range, const FaceColumns& faces, CornerSlots& slots) noexcept;

/// The same for loose corners, which all belong to the block.
void place_loose(std::span<const LooseCorner> loose, CornerSlots& slots) noexcept;
void place_loose(std::span<const LooseTriangleCorner> loose, CornerSlots& slots) noexcept;

/// How many corners the vertices with more than a slot have together.
[[nodiscard]] Index count_large(const CornerSlots& slots) noexcept;

/// Brings the corners of each such vertex i to corners[ends[i] - count[i] .. ends[i]); writes no
/// other element of `ends`.
/// \pre `corners` has room for count_large() of them.
void gather_large(const CornerSlots& slots, Corner* corners, Index* ends) noexcept;

}  // namespace hedgerow::kernels
