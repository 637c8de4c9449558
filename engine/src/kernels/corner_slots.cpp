#include "kernels/corner_slots.h"

#include <type_traits>

namespace hedgerow::kernels {

namespace {

using Unsigned = std::make_unsigned_t<Index>;

void place(Index local, Index v, const Corner& corner, CornerSlots& slots) noexcept {
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

}  // namespace

void clear_slots(CornerSlots& slots) noexcept {
  for (Index i = 0; i < slots.block.size; ++i) {
    slots.count[i] = 0;
    for (Index& source : slots.slot[i].source) source = kInvalidIndex;
  }
  slots.overflow_count = 0;
}

void place_corners(IndexRange range, const FaceColumns& faces, Faces where,
                   CornerSlots& slots) noexcept {
  // A copy, so that the compiler need not think that a corner overwrites it.
  CornerSlots to = slots;
  const Index begin = to.block.begin;
  if (where == Faces::all_inside) {
    for_each_corner(range, faces,
                    [&](Index v, const Corner& corner) { place(v - begin, v, corner, to); });
  } else {
    const auto size = static_cast<Unsigned>(to.block.size);
    for_each_corner(range, faces, [&](Index v, const Corner& corner) {
      if (static_cast<Unsigned>(v - begin) < size) place(v - begin, v, corner, to);
    });
  }
  slots.overflow_count = to.overflow_count;
}

void place_loose(std::span<const LooseCorner> loose, CornerSlots& slots) noexcept {
  CornerSlots to = slots;
  for (const LooseCorner& l : loose) place(l.vertex - to.block.begin, l.vertex, l.corner, to);
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
