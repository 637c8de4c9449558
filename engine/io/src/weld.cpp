#include "weld.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace hedgerow::io {

namespace {

std::uint32_t key_of(float value) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits == 0x80000000u ? 0 : bits;
}

std::uint64_t hash_of(const float* xyz) noexcept {
  // Multiply and fold: every bit of the three floats reaches the low bits, where tables look.
  std::uint64_t hash = (std::uint64_t{key_of(xyz[0])} << 32 | key_of(xyz[1])) * 0x9e3779b97f4a7c15u;
  hash ^= hash >> 29;
  hash = (hash + key_of(xyz[2])) * 0xbf58476d1ce4e5b9u;
  return hash ^ hash >> 32;
}

bool is_same(const float* a, const float* b) noexcept {
  return key_of(a[0]) == key_of(b[0]) && key_of(a[1]) == key_of(b[1]) &&
         key_of(a[2]) == key_of(b[2]);
}

}  // namespace

// A closed triangle mesh has half a vertex a triangle, so a sixth of its points are different; the
// table starts for a quarter and doubles when that is not enough.
Welder::Welder(std::size_t point_count)
    : slots_(std::bit_ceil(std::max<std::size_t>(point_count / 2, 64)), Slot{0, kInvalidIndex}),
      mask_(slots_.size() - 1) {}

Index Welder::add(const float* xyz) {
  const std::uint64_t hash = hash_of(xyz);
  const auto tag = static_cast<std::uint32_t>(hash >> 32 ^ hash);
  std::size_t i = tag & mask_;
  for (; slots_.data()[i].vertex != kInvalidIndex; i = (i + 1) & mask_) {
    const Slot& slot = slots_.data()[i];
    if (slot.hash == tag && is_same(xyz_.data() + 3 * static_cast<std::size_t>(slot.vertex), xyz)) {
      return slot.vertex;
    }
  }
  const auto vertex = static_cast<Index>(size());
  slots_.data()[i] = {tag, vertex};
  std::copy_n(xyz, 3, xyz_.append(3));
  if (2 * size() > slots_.size()) grow();
  return vertex;
}

void Welder::grow() {
  Buffer<Slot> larger(2 * slots_.size(), Slot{0, kInvalidIndex});
  mask_ = larger.size() - 1;
  for (const Slot& slot : slots_) {
    if (slot.vertex == kInvalidIndex) continue;
    std::size_t i = slot.hash & mask_;
    while (larger.data()[i].vertex != kInvalidIndex) i = (i + 1) & mask_;
    larger.data()[i] = slot;
  }
  slots_ = std::move(larger);
}

}  // namespace hedgerow::io
