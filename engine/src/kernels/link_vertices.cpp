#include "kernels/link_vertices.h"

#include <bit>
#include <cstddef>

#include "kernels/simd_path.h"

namespace hedgerow::kernels {

namespace {

bool is_single(unsigned mask) noexcept { return mask != 0 && (mask & (mask - 1)) == 0; }

// The corners whose source is `target`, as a bit set over the k corners of one slot.
unsigned followers(const CornerSlot& slot, Index k, Index target) noexcept {
  unsigned mask = 0;
  for (Index j = 0; j < k; ++j) mask |= static_cast<unsigned>(slot.source[j] == target) << j;
  return mask;
}

// One rotation from the first corner meets all of them and comes back.
bool link_closed(const CornerSlot& slot, Index k, Index* opposite) noexcept {
  Index follower[CornerSlot::kCapacity];
  Index i = 0;
  for (Index step = 1; step <= k; ++step) {
    const unsigned mask = followers(slot, k, slot.target[i]);
    if (!is_single(mask)) return false;
    follower[i] = static_cast<Index>(std::countr_zero(mask));
    i = follower[i];
    if (i == 0 && step < k) return false;
  }
  if (i != 0) return false;
  for (i = 0; i < k; ++i) opposite[slot.halfedge[i]] = slot.incoming[follower[i]];
  return true;
}

}  // namespace

LinkStats link_vertices_scalar(const CornerSlots& slots, Index* opposite, Index* outgoing,
                               Index* irregular) noexcept {
  LinkStats stats;
  for (Index i = 0; i < slots.block.size; ++i) {
    const Index k = slots.count[i];
    stats.step_count += k;
    if (k > 2 && k <= CornerSlot::kCapacity && link_closed(slots.slot[i], k, opposite)) {
      outgoing[slots.block.begin + i] = slots.slot[i].halfedge[0];
      stats.paired_count += k;
      stats.step_count += k * k;
    } else {
      irregular[stats.irregular_count++] = slots.block.begin + i;
    }
  }
  return stats;
}

LinkStats link_vertices(const CornerSlots& slots, Index* opposite, Index* outgoing,
                        Index* irregular) noexcept {
  if (has_avx2()) {
    return link_vertices_avx2(slots, opposite, outgoing, irregular);
  }
  return link_vertices_scalar(slots, opposite, outgoing, irregular);
}

// All targets but one (none, if closed) are the source of exactly one corner, and the chain from
// the corner that follows none meets all of them.
bool link_fan(std::span<const Corner> corners, Index* opposite, Index& outgoing,
              LinkStats& stats) noexcept {
  const std::size_t k = corners.size();
  stats.step_count += static_cast<std::int64_t>(k * k);
  std::size_t follower[kSmallValence];
  unsigned followed = 0;
  std::size_t end_count = 0;
  for (std::size_t i = 0; i < k; ++i) {
    unsigned mask = 0;
    for (std::size_t j = 0; j < k; ++j) {
      mask |= static_cast<unsigned>(corners[j].source == corners[i].target) << j;
    }
    if (mask != 0 && !is_single(mask)) return false;
    end_count += mask == 0;
    followed |= mask;
    follower[i] = mask == 0 ? k : static_cast<std::size_t>(std::countr_zero(mask));
  }
  const unsigned starts = ((1U << k) - 1) & ~followed;
  const bool is_open = end_count == 1 && is_single(starts);
  if (!is_open && (end_count != 0 || starts != 0 || k <= 2)) return false;

  const std::size_t start = is_open ? static_cast<std::size_t>(std::countr_zero(starts)) : 0;
  std::size_t length = 1;
  std::size_t i = follower[start];
  for (; i != k && i != start; i = follower[i]) ++length;
  if (length != k) return false;

  for (i = 0; i < k; ++i) {
    opposite[corners[i].halfedge] =
        follower[i] == k ? kInvalidIndex : corners[follower[i]].incoming;
  }
  outgoing = corners[start].halfedge;
  stats.paired_count += static_cast<std::int64_t>(k - end_count);
  stats.boundary_count += static_cast<std::int64_t>(end_count);
  return true;
}

}  // namespace hedgerow::kernels
