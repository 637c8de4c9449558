#include "report/reference.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hedgerow::tool {
namespace {

struct DirectedEdge {
  Index low;
  Index high;
  Index halfedge;

  friend bool operator<(const DirectedEdge& a, const DirectedEdge& b) {
    return std::pair(a.low, a.high) < std::pair(b.low, b.high);
  }
};

}  // namespace

Index Reference::first(Index face) const noexcept {
  return soup_.offsets.empty() ? 3 * face : soup_.offsets[static_cast<std::size_t>(face)];
}

Index Reference::next(Index face, Index h) const noexcept {
  return h + 1 == first(face + 1) ? first(face) : h + 1;
}

Reference::Reference(const Soup& soup)
    : soup_(soup), opposite_(soup.corners.size(), kInvalidIndex) {
  const auto origin = [&](Index h) { return soup_.corners[static_cast<std::size_t>(h)]; };
  std::vector<DirectedEdge> edges;
  edges.reserve(soup.corners.size());
  for (Index f = 0; f < face_count(); ++f) {
    for (Index h = first(f); h < first(f + 1); ++h) {
      const auto [low, high] = std::minmax({origin(h), origin(next(f, h))});
      edges.push_back({low, high, h});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && !(edges[i] < edges[end])) ++end;
    if (end - i == 2 && origin(edges[i].halfedge) != origin(edges[i + 1].halfedge)) {
      opposite_[static_cast<std::size_t>(edges[i].halfedge)] = edges[i + 1].halfedge;
      opposite_[static_cast<std::size_t>(edges[i + 1].halfedge)] = edges[i].halfedge;
    }
    i = end;
  }
}

std::vector<std::uint32_t> Reference::neighbour_sums() const {
  std::vector<std::uint32_t> sums(static_cast<std::size_t>(soup_.vertex_count()), 0);
  for (Index f = 0; f < face_count(); ++f) {
    for (Index h = first(f); h < first(f + 1); ++h) {
      const auto origin = static_cast<std::size_t>(soup_.corners[static_cast<std::size_t>(h)]);
      const auto target =
          static_cast<std::size_t>(soup_.corners[static_cast<std::size_t>(next(f, h))]);
      sums[origin] += static_cast<std::uint32_t>(target);
      if (opposite_[static_cast<std::size_t>(h)] == kInvalidIndex) {
        sums[target] += static_cast<std::uint32_t>(origin);
      }
    }
  }
  return sums;
}

std::int64_t Reference::boundary_loop_count() const {
  std::vector<Index> prev(opposite_.size());
  for (Index f = 0; f < face_count(); ++f) {
    for (Index h = first(f); h < first(f + 1); ++h) prev[static_cast<std::size_t>(next(f, h))] = h;
  }
  std::vector<bool> is_seen(opposite_.size(), false);
  std::int64_t count = 0;
  for (std::size_t start = 0; start < opposite_.size(); ++start) {
    if (opposite_[start] != kInvalidIndex || is_seen[start]) continue;
    ++count;
    for (std::size_t h = start; !is_seen[h];) {
      is_seen[h] = true;
      auto before = static_cast<std::size_t>(prev[h]);
      while (opposite_[before] != kInvalidIndex) {
        before = static_cast<std::size_t>(prev[static_cast<std::size_t>(opposite_[before])]);
      }
      h = before;
    }
  }
  return count;
}

std::int64_t Reference::component_count() const {
  std::vector<Index> parent(static_cast<std::size_t>(soup_.vertex_count()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](Index v) {
    while (parent[static_cast<std::size_t>(v)] != v) {
      Index& above = parent[static_cast<std::size_t>(v)];
      above = parent[static_cast<std::size_t>(above)];
      v = above;
    }
    return v;
  };
  std::vector<bool> is_used(parent.size(), false);
  std::int64_t count = 0;
  for (const Index corner : soup_.corners) {
    if (is_used[static_cast<std::size_t>(corner)]) continue;
    is_used[static_cast<std::size_t>(corner)] = true;
    ++count;
  }
  for (Index f = 0; f < face_count(); ++f) {
    for (Index h = first(f) + 1; h < first(f + 1); ++h) {
      const Index a = root(soup_.corners[static_cast<std::size_t>(h - 1)]);
      const Index b = root(soup_.corners[static_cast<std::size_t>(h)]);
      if (a == b) continue;
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
      --count;
    }
  }
  return count;
}

}  // namespace hedgerow::tool
