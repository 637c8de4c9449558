#include "kernels/link_irregular.h"

#include <algorithm>
#include <array>
#include <utility>

namespace hedgerow::kernels {

namespace {

constexpr std::size_t kInsertionSize = 32;

// Stable, by `key`; returns the moves made. Insertion for the few, bytes from the least significant
// up for the many, so that a vertex with a million corners costs a million times one with one.
template <class Key>
std::int64_t sort_spokes(std::span<Spoke> spokes, std::span<Spoke> room, const Key& key) noexcept {
  const std::size_t n = spokes.size();
  std::int64_t steps = 0;
  if (n <= kInsertionSize) {
    for (std::size_t i = 1; i < n; ++i) {
      const Spoke spoke = spokes[i];
      std::size_t j = i;
      for (; j > 0 && key(spokes[j - 1]) > key(spoke); --j) spokes[j] = spokes[j - 1];
      spokes[j] = spoke;
      steps += static_cast<std::int64_t>(i - j) + 1;
    }
    return steps;
  }
  Index largest = 0;
  for (const Spoke& s : spokes) largest = std::max(largest, key(s));
  Spoke* from = spokes.data();
  Spoke* to = room.data();
  for (int shift = 0; shift < static_cast<int>(8 * sizeof(Index)) && (largest >> shift) > 0;
       shift += 8) {
    std::array<std::size_t, 256> ends{};
    for (std::size_t i = 0; i < n; ++i) ++ends[(key(from[i]) >> shift) & 0xff];
    std::size_t sum = 0;
    for (std::size_t& end : ends) sum += std::exchange(end, sum);
    for (std::size_t i = 0; i < n; ++i) to[ends[(key(from[i]) >> shift) & 0xff]++] = from[i];
    std::swap(from, to);
    steps += static_cast<std::int64_t>(n);
  }
  if (from != spokes.data()) std::copy_n(from, n, spokes.data());
  return steps;
}

// Union of corners, the smallest number being the root. Corners are joined in runs, so the paths
// stay short; halving keeps them so.
Index root_of(std::span<Index> parent, Index i) noexcept {
  while (parent[static_cast<std::size_t>(i)] != i) {
    auto& p = parent[static_cast<std::size_t>(i)];
    p = parent[static_cast<std::size_t>(p)];
    i = p;
  }
  return i;
}

void join(std::span<Index> parent, Index a, Index b) noexcept {
  a = root_of(parent, a);
  b = root_of(parent, b);
  parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

class VertexLinker {
 public:
  VertexLinker(VertexId v, std::span<const Corner> corners, const std::uint8_t* is_cut,
               const IrregularScratch& scratch) noexcept
      : v_(v),
        corners_(corners),
        is_cut_(is_cut),
        scratch_(scratch),
        spokes_(scratch.spokes.first(2 * corners.size())),
        room_(scratch.spokes.subspan(2 * corners.size())) {}

  IrregularResult run(bool is_triangles, Index* opposite, Index& outgoing) noexcept {
    fill_spokes();
    for_each_edge([&](std::span<Spoke> edge) { link_edge(edge); });
    write_opposites(opposite);
    find_fans(outgoing);
    report_groups();
    if (is_triangles) {
      for_each_edge([&](std::span<Spoke> edge) { report_duplicates(edge); });
    }
    return result_;
  }

 private:
  [[nodiscard]] static std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] bool is_cut(Index halfedge) const noexcept {
    return is_cut_ != nullptr && is_cut_[halfedge] != 0;
  }

  void report(const Defect& defect) noexcept {
    scratch_.defects[at(result_.defect_count++)] = defect;
  }

  void fill_spokes() noexcept {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Corner& c = corners_[i];
      const auto corner = static_cast<Index>(i);
      spokes_[2 * i] = {c.target, corner, c.halfedge, true};
      spokes_[2 * i + 1] = {c.source, corner, c.incoming, false};
      scratch_.follower[i] = scratch_.preceder[i] = kInvalidIndex;
      scratch_.group[i] = corner;
    }
    result_.stats.step_count +=
        sort_spokes(spokes_, room_, [](const Spoke& s) { return s.neighbour; });
  }

  template <class Visit>
  void for_each_edge(const Visit& visit) noexcept {
    for (std::size_t begin = 0, end = 0; begin < spokes_.size(); begin = end) {
      while (end < spokes_.size() && spokes_[end].neighbour == spokes_[begin].neighbour) ++end;
      visit(spokes_.subspan(begin, end - begin));
    }
  }

  void link_edge(std::span<const Spoke> edge) noexcept {
    const Spoke* out = nullptr;
    const Spoke* in = nullptr;
    int out_count = 0;
    int in_count = 0;
    Index smallest = edge[0].halfedge;
    for (const Spoke& s : edge) {
      smallest = std::min(smallest, s.halfedge);
      join(scratch_.group, edge[0].corner, s.corner);
      if (is_cut(s.halfedge)) continue;
      (s.is_outgoing ? out : in) = &s;
      ++(s.is_outgoing ? out_count : in_count);
    }
    if (out_count == 1 && in_count == 1) {
      scratch_.follower[at(out->corner)] = in->corner;
      scratch_.preceder[at(in->corner)] = out->corner;
      ++result_.stats.paired_count;
    }
    classify(edge, smallest);
  }

  // Every half-edge of a kept face counts here, those cut from pairing too.
  void classify(std::span<const Spoke> edge, Index smallest) noexcept {
    const auto count = static_cast<std::int64_t>(edge.size());
    if (count == 1) {
      result_.stats.boundary_count += edge[0].is_outgoing;
      return;
    }
    const bool consistent = edge.size() == 2 && edge[0].is_outgoing != edge[1].is_outgoing;
    const Index other = edge[0].neighbour;
    if (consistent) {
      // Counted by the half-edges that pair; a pair that was cut apart is still one edge.
      const bool apart = is_cut(edge[0].halfedge) || is_cut(edge[1].halfedge);
      result_.stats.bad_edge_count += apart && v_.value < other;
      return;
    }
    if (v_.value > other) return;
    ++result_.stats.bad_edge_count;
    paired_bad_edge(edge);
    const auto kind = count == 2 ? DefectKind::inconsistent_edge : DefectKind::nonmanifold_edge;
    report({kind, FaceId(), HalfedgeId(smallest), v_, VertexId(other), count});
  }

  // A bad edge of which just two half-edges are left to pair must not be counted twice.
  void paired_bad_edge(std::span<const Spoke> edge) noexcept {
    int out_count = 0;
    int in_count = 0;
    for (const Spoke& s : edge) {
      if (!is_cut(s.halfedge)) ++(s.is_outgoing ? out_count : in_count);
    }
    result_.stats.bad_edge_count -= out_count == 1 && in_count == 1;
  }

  void write_opposites(Index* opposite) const noexcept {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Index j = scratch_.follower[i];
      opposite[corners_[i].halfedge] =
          j == kInvalidIndex ? kInvalidIndex : corners_[at(j)].incoming;
    }
  }

  // Fans in the order of their smallest corner, since corners ascend. `follower` is marked as the
  // rotation passes: a corner seen is never a start again.
  void find_fans(Index& outgoing) noexcept {
    constexpr Index kSeen = -2;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (scratch_.follower[i] == kSeen) continue;
      Index start = static_cast<Index>(i);
      while (scratch_.preceder[at(start)] != kInvalidIndex) {
        start = scratch_.preceder[at(start)];
        if (start == static_cast<Index>(i)) break;
      }
      for (Index c = start; c != kInvalidIndex && scratch_.follower[at(c)] != kSeen;) {
        c = std::exchange(scratch_.follower[at(c)], kSeen);
      }
      scratch_.fans[at(result_.fan_count++)] = {v_, HalfedgeId(corners_[at(start)].halfedge)};
    }
    outgoing = scratch_.fans[0].start.value;
  }

  void report_groups() noexcept {
    std::int64_t groups = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      groups += scratch_.group[i] == static_cast<Index>(i);
    }
    if (groups > 1) {
      report({DefectKind::nonmanifold_vertex, FaceId(), HalfedgeId(), v_, VertexId(), groups});
    }
  }

  // Triangles with the same vertices meet at the edge of the two smallest; it is looked at from the
  // smallest, and the faces on it compared by their third vertex.
  void report_duplicates(std::span<Spoke> edge) noexcept {
    if (edge.size() < 2 || edge[0].neighbour < v_.value) return;
    const auto third = [&](const Spoke& s) {
      const Corner& c = corners_[at(s.corner)];
      return s.is_outgoing ? c.source : c.target;
    };
    result_.stats.step_count += sort_spokes(edge, room_, third);
    for (std::size_t begin = 0, end = 0; begin < edge.size(); begin = end) {
      Index first = edge[begin].halfedge;
      for (; end < edge.size() && third(edge[end]) == third(edge[begin]); ++end) {
        first = std::min(first, edge[end].halfedge);
      }
      if (third(edge[begin]) < edge[begin].neighbour) continue;
      for (std::size_t i = begin; i < end; ++i) {
        if (edge[i].halfedge == first) continue;
        report({DefectKind::duplicate_face, FaceId(edge[i].halfedge / 3), HalfedgeId(), VertexId(),
                VertexId(), first / 3});
      }
    }
  }

  VertexId v_;
  std::span<const Corner> corners_;
  const std::uint8_t* is_cut_;
  const IrregularScratch& scratch_;
  std::span<Spoke> spokes_;
  std::span<Spoke> room_;
  IrregularResult result_;
};

}  // namespace

IrregularResult link_irregular(VertexId v, std::span<const Corner> corners, bool is_triangles,
                               const std::uint8_t* is_cut, Index* opposite, Index& outgoing,
                               const IrregularScratch& scratch) noexcept {
  IrregularResult result =
      VertexLinker(v, corners, is_cut, scratch).run(is_triangles, opposite, outgoing);
  result.stats.step_count += static_cast<std::int64_t>(corners.size());
  return result;
}

}  // namespace hedgerow::kernels
