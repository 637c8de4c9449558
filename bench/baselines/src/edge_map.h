#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "hedgerow/face_list.h"
#include "hedgerow/index.h"

namespace hedgerow::baselines::detail {

/// An edge as its smaller and larger vertex.
struct EdgeKey {
  Index smaller;
  Index larger;

  friend bool operator==(EdgeKey, EdgeKey) noexcept = default;
};

struct EdgeKeyHash {
  std::size_t operator()(EdgeKey key) const noexcept {
    const std::uint64_t mixed = static_cast<std::uint64_t>(key.smaller) * 0x9E3779B97F4A7C15U +
                                static_cast<std::uint64_t>(key.larger);
    return static_cast<std::size_t>(mixed ^ (mixed >> 32U));
  }
};

/// What the map knows of an edge: the first half-edge met on it, and how many there were.
template <class Handle>
struct EdgeEntry {
  Handle first{};
  Index count = 0;
};

template <class Handle>
using EdgeMap = std::unordered_map<EdgeKey, EdgeEntry<Handle>, EdgeKeyHash>;

}  // namespace hedgerow::baselines::detail
