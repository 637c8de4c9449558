#include "kernels/corner_slots.h"

#include <type_traits>

#include "kernels/simd_path.h"

namespace hedgerow::kernels {

void clear_slots(CornerSlots& slots) noexcept {
  for (Index i = 0; i < slots.block.size; ++i) {
    slots.count[i] = 0;
    for (Index& source : slots.slot[i].source) source = kInvalidIndex;
  }
  slots.overflow_count = 0;
}

void place_corners(IndexRange range, const FaceColumns& faces, Faces where,
                   CornerSlots& slots) noexcept {
  if (where == Faces::some_outside) {
    const bool is_fast = faces.is_triangles() && has_avx2();
    is_fast ? place_triangles_avx2(range, faces, slots) : place_corners_scalar(range, faces, slots);
    return;
  }
  // A copy, so that the compiler need not think that a corner overwrites it.
  CornerSlots to = slots;
  for_each_corner(range, faces, [&](Index v, const Corner& corner) { add_corner(v, corner, to); });
  slots.overflow_count = to.overflow_count;
}

void place_corners_scalar(IndexRange range, const FaceColumns& faces, CornerSlots& slots) noexcept {
  CornerSlots to = slots;
  const auto size = static_cast<std::make_unsigned_t<Index>>(to.block.size);
  for_each_corner(range, faces, [&](Index v, const Corner& corner) {
    const auto local = static_cast<std::make_unsigned_t<Index>>(v - to.block.begin);
    if (local < size) add_corner(v, corner, to);
  });
  slots.overflow_count = to.overflow_count;
}

void place_loose(std::span<const LooseCorner> loose, CornerSlots& slots) noexcept {
  CornerSlots to = slots;
  for (const LooseCorner& l : loose) add_corner(l.vertex, l.corner, to);
  slots.overflow_count = to.overflow_count;
}

void place_loose(std::span<const LooseTriangleCorner> loose, CornerSlots& slots) noexcept {
  CornerSlots to = slots;
  for (const LooseTriangleCorner& l : loose) {
    const Index incoming = l.halfedge % 3 == 0 ? l.halfedge + 2 : l.halfedge - 1;
    add_corner(l.vertex, {l.halfedge, l.target, l.source, incoming}, to);
  }
  slots.overflow_count = to.overflow_count;
}

Index count_large(const CornerSlots& slots) noexcept {
  Index sum = 0;
  for (Index i = 0; i < slots.block.size; ++i) {
    if (slots.count[i] > CornerSlot::kCapacity) sum += slots.count[i];
  }
  return sum;
}

void gather_large(const CornerSlots& slots, Corner* corners, Index* ends) noexcept {
  Index begin = 0;
  for (Index i = 0; i < slots.block.size; ++i) {
    if (slots.count[i] <= CornerSlot::kCapacity) continue;
    for (Index n = 0; n < CornerSlot::kCapacity; ++n) corners[begin + n] = slots.slot[i].corner(n);
    ends[i] = begin + CornerSlot::kCapacity;
    begin += slots.count[i];
  }
  for (Index j = 0; j < slots.overflow_count; ++j) {
    const LooseCorner& loose = slots.overflow[j];
    corners[ends[loose.vertex - slots.block.begin]++] = loose.corner;
  }
}

}  // namespace hedgerow::kernels
