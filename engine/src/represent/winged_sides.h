#pragma once

#include <cstddef>
#include <vector>

#include "hedgerow/winged_edge.h"

namespace hedgerow::detail {

/// The sides of tables whose entries may be any numbers: nothing is followed before it is known to
/// be in range. Sides are plain numbers here, 2e and 2e + 1; -1 = none. O(1) each.
class WingedSides {
 public:
  explicit WingedSides(const WingedEdgeTables& tables) noexcept : t_(&tables) {}

  [[nodiscard]] Index count() const noexcept { return 2 * t_->edge_count(); }
  [[nodiscard]] bool has_edge(Index e) const noexcept { return e >= 0 && e < t_->edge_count(); }
  [[nodiscard]] bool has_vertex(Index v) const noexcept { return v >= 0 && v < t_->vertex_count(); }
  [[nodiscard]] bool has_face(Index f) const noexcept { return f >= 0 && f < t_->face_count(); }
  [[nodiscard]] const WingedEdge& row(Index s) const noexcept {
    return t_->edges[static_cast<std::size_t>(s / 2)];
  }

  [[nodiscard]] Index origin(Index s) const noexcept {
    return s % 2 == 0 ? row(s).start.value : row(s).end.value;
  }
  [[nodiscard]] Index target(Index s) const noexcept { return origin(s ^ 1); }
  [[nodiscard]] Index next_edge(Index s) const noexcept {
    return s % 2 == 0 ? row(s).next_cw.value : row(s).next_ccw.value;
  }
  [[nodiscard]] Index prev_edge(Index s) const noexcept {
    return s % 2 == 0 ? row(s).prev_cw.value : row(s).prev_ccw.value;
  }
  [[nodiscard]] Index face(Index s) const noexcept {
    return s % 2 == 0 ? row(s).face_cw.value : row(s).face_ccw.value;
  }
  [[nodiscard]] bool has_links(Index s) const noexcept {
    return next_edge(s) != kInvalidIndex || prev_edge(s) != kInvalidIndex;
  }
  [[nodiscard]] bool exists(Index s) const noexcept {
    return has_links(s) || face(s) != kInvalidIndex;
  }

  /// The side of edge e that leaves v; -1 if there is none.
  [[nodiscard]] Index leaving(Index e, Index v) const noexcept {
    if (!has_edge(e)) return kInvalidIndex;
    if (origin(2 * e) == v) return 2 * e;
    return target(2 * e) == v ? 2 * e + 1 : kInvalidIndex;
  }
  [[nodiscard]] Index next(Index s) const noexcept { return leaving(next_edge(s), target(s)); }
  [[nodiscard]] Index prev(Index s) const noexcept {
    const Index back = leaving(prev_edge(s), origin(s));
    return back == kInvalidIndex ? kInvalidIndex : back ^ 1;
  }
  /// Whether `next(s)` exists and names s as its prev.
  [[nodiscard]] bool is_next_answered(Index s) const noexcept {
    const Index t = next(s);
    return t != kInvalidIndex && prev(t) == s;
  }
  [[nodiscard]] bool is_prev_answered(Index s) const noexcept {
    const Index t = prev(s);
    return t != kInvalidIndex && next(t) == s;
  }

 private:
  const WingedEdgeTables* t_;
};

/// The column of side s that holds what is named.
[[nodiscard]] inline WingedColumn next_column(Index s) noexcept {
  return s % 2 == 0 ? WingedColumn::next_cw : WingedColumn::next_ccw;
}
[[nodiscard]] inline WingedColumn prev_column(Index s) noexcept {
  return s % 2 == 0 ? WingedColumn::prev_cw : WingedColumn::prev_ccw;
}
[[nodiscard]] inline WingedColumn face_column(Index s) noexcept {
  return s % 2 == 0 ? WingedColumn::face_cw : WingedColumn::face_ccw;
}

/// Faults of the ends and links of edges, where it is known that there are some. O(n log n).
[[nodiscard]] std::vector<WingedFault> find_bad_ends(const WingedEdgeTables& tables);
/// \pre every end is a vertex. Not empty if some link is not answered.
[[nodiscard]] std::vector<WingedFault> find_bad_links(const WingedEdgeTables& tables);

}  // namespace hedgerow::detail
