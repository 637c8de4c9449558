#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "hedgerow/topology.h"

/// The corners of a vertex in ascending order, whatever their number, without allocating.
namespace hedgerow::kernels {

/// Calls visit(h) for each half-edge with a face that leaves v, in the order of rotation, fan by
/// fan. O(valence).
template <Topology View, class Visit>
inline void for_each_corner(const View& mesh, VertexId v, const Visit& visit) noexcept {
  const auto rotate = [&](HalfedgeId start) {
    HalfedgeId h = start;
    do {
      if constexpr (std::is_same_v<View, TriangleView>) {
        visit(h.value);
      } else {
        if (mesh.face(h).valid()) visit(h.value);
      }
      const HalfedgeId opposite = mesh.opposite[h];
      if (!opposite.valid()) return;
      h = mesh.next(opposite);
    } while (h != start);
  };
  const HalfedgeId start = mesh.outgoing[v];
  if (!start.valid()) return;
  rotate(start);
  for (const FanStart& fan : extra_fans(mesh.fans, v)) rotate(fan.start);
}

/// A set of half-edges that gives back the smallest first: bits, with a bit above for each word
/// that is not zero, and so on up. Inserting and taking out cost O(log64 size) each. The
/// alternative, sorting, needs memory for the largest valence, which is not known before all are
/// walked.
class HalfedgeSet {
 public:
  /// Bytes for half-edges below `size`; a multiple of 64.
  [[nodiscard]] static std::size_t bytes(Index size) noexcept {
    std::size_t words = 0;
    std::size_t level = static_cast<std::size_t>(size);
    do {
      level = (level + 63) / 64;
      words += level;
    } while (level > 1);
    return (words * sizeof(std::uint64_t) + 63) / 64 * 64;
  }
  /// \pre `memory` holds bytes(size) zeros, and holds them again once the set is empty.
  HalfedgeSet(void* memory, Index size) noexcept {
    auto* words = static_cast<std::uint64_t*>(memory);
    std::size_t level = static_cast<std::size_t>(size);
    do {
      level = (level + 63) / 64;
      levels_[count_++] = words;
      words += level;
    } while (level > 1);
  }

  void insert(Index h) noexcept {
    auto i = static_cast<std::size_t>(h);
    for (int level = 0; level < count_; ++level, i >>= 6) {
      std::uint64_t& word = levels_[level][i >> 6];
      const bool was_known_above = word != 0;
      word |= std::uint64_t{1} << (i & 63);
      if (was_known_above) return;
    }
  }
  [[nodiscard]] bool empty() const noexcept { return levels_[count_ - 1][0] == 0; }
  /// \pre not empty
  [[nodiscard]] Index take_smallest() noexcept {
    std::size_t i = 0;
    for (int level = count_ - 1; level >= 0; --level) {
      i = i << 6 | static_cast<std::size_t>(std::countr_zero(levels_[level][i]));
    }
    const auto smallest = static_cast<Index>(i);
    for (int level = 0; level < count_; ++level, i >>= 6) {
      std::uint64_t& word = levels_[level][i >> 6];
      word &= ~(std::uint64_t{1} << (i & 63));
      if (word != 0) break;
    }
    return smallest;
  }

 private:
  static constexpr int kMaxLevels = 11;  // 64-bit indices
  std::uint64_t* levels_[kMaxLevels] = {};
  int count_ = 0;
};

/// Corners handed over at a time; more than almost every vertex has.
inline constexpr Index kChunk = 64;

/// Sorts a few numbers. Rings are short and nearly in rotation order.
inline void sort_few(Index* values, Index count) noexcept {
  for (Index i = 1; i < count; ++i) {
    const Index value = values[i];
    Index j = i;
    for (; j > 0 && values[j - 1] > value; --j) values[j] = values[j - 1];
    values[j] = value;
  }
}

/// Calls visit(ids, count) with the corners of v in ascending order, at most kChunk at a time.
/// \pre `spill` is empty; it is again afterwards.
template <Topology View, class Visit>
inline void for_each_chunk(const View& mesh, VertexId v, HalfedgeSet& spill,
                           const Visit& visit) noexcept {
  Index ids[kChunk + 3];  // three more, for the last group of four
  Index count = 0;
  bool has_spilled = false;
  for_each_corner(mesh, v, [&](Index h) {
    if (count == kChunk) {
      has_spilled = true;
      for (Index i = 0; i < kChunk; ++i) spill.insert(ids[i]);
      count = 0;
    }
    ids[count++] = h;
  });
  if (!has_spilled) {
    sort_few(ids, count);
    if (count > 0) visit(ids, count);
    return;
  }
  for (Index i = 0; i < count; ++i) spill.insert(ids[i]);
  while (!spill.empty()) {
    for (count = 0; count < kChunk && !spill.empty(); ++count) ids[count] = spill.take_smallest();
    visit(ids, count);
  }
}

}  // namespace hedgerow::kernels
