#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "hedgerow/soup.h"

namespace hedgerow::bench {

/// What a ray tracer's user writes who has index arrays and wants neighbours: a hash map from each
/// directed edge to its half-edge. A ring is found by asking it for the opposite edge, step by
/// step.
///
/// Triangles only; an edge that two faces run the same way keeps one of them.
class EdgeHash {
 public:
  explicit EdgeHash(const Soup& soup) : soup_(&soup) {
    map_.reserve(soup.corners.size());
    for (Index h = 0; h < static_cast<Index>(soup.corners.size()); ++h) {
      map_[key(origin(h), origin(next(h)))] = h;
    }
  }

  /// The sum of the neighbours of the vertex that `start` leaves, modulo 2^32, in the fan of it.
  [[nodiscard]] std::uint32_t ring_sum(Index start) const {
    std::uint32_t sum = 0;
    Index h = start;
    do {
      sum += static_cast<std::uint32_t>(origin(next(h)));
      const Index opposite = find(origin(next(h)), origin(h));
      if (opposite < 0) return sum + sum_backward(start);
      h = next(opposite);
    } while (h != start);
    return sum;
  }

 private:
  [[nodiscard]] Index origin(Index h) const { return soup_->corners[static_cast<std::size_t>(h)]; }
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index prev(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  static std::uint64_t key(Index from, Index to) {
    return static_cast<std::uint64_t>(from) << 32U | static_cast<std::uint32_t>(to);
  }
  [[nodiscard]] Index find(Index from, Index to) const {
    const auto found = map_.find(key(from, to));
    return found == map_.end() ? Index{-1} : found->second;
  }
  /// The neighbours on the other side of an open fan, from `start` on.
  [[nodiscard]] std::uint32_t sum_backward(Index start) const {
    std::uint32_t sum = 0;
    for (Index h = start;;) {
      const Index enters = prev(h);
      sum += static_cast<std::uint32_t>(origin(enters));
      const Index opposite = find(origin(h), origin(enters));
      if (opposite < 0) return sum;
      h = opposite;
    }
  }

  const Soup* soup_;
  std::unordered_map<std::uint64_t, Index> map_;
};

}  // namespace hedgerow::bench
