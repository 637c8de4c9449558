// Which of two entries that contradict each other is the wrong one: the one that fewer others speak
// for.
#include <algorithm>
#include <tuple>
#include <utility>

#include "represent/winged_sides.h"

namespace hedgerow::detail {

namespace {

struct Vote {
  Index edge;
  Index vertex;

  friend auto operator<=>(const Vote&, const Vote&) noexcept = default;
};

// Every link, and every edge of a vertex, says of another edge that it touches a certain vertex.
std::vector<Vote> gather_votes(const WingedEdgeTables& tables) {
  const WingedSides sides(tables);
  std::vector<Vote> votes;
  const auto add = [&](Index e, Index v) {
    if (sides.has_edge(e) && sides.has_vertex(v)) votes.push_back({e, v});
  };
  for (Index s = 0; s < sides.count(); ++s) {
    add(sides.next_edge(s), sides.target(s));
    add(sides.prev_edge(s), sides.origin(s));
  }
  for (Index v = 0; v < tables.vertex_count(); ++v) {
    add(tables.vertex_edge[static_cast<std::size_t>(v)].value, v);
  }
  std::sort(votes.begin(), votes.end());
  return votes;
}

class EndJudge {
 public:
  explicit EndJudge(const WingedEdgeTables& tables)
      : sides_(tables), votes_(gather_votes(tables)) {}

  // Adds the end of e that side s leaves, if others know better.
  void judge(Index s, std::vector<WingedFault>& found) const {
    const Index here = sides_.origin(s);
    const Index other = sides_.target(s);
    const bool is_loop = here == other;
    if (!is_loop && sides_.has_vertex(here) && count(s / 2, here) > 0) return;
    const Index expected = most_named(s / 2, is_loop ? kInvalidIndex : here, other);
    if (sides_.has_vertex(here)) {
      if (!is_loop && expected == kInvalidIndex) return;
      // An edge from a vertex to itself has one bad end: the one whose links lead elsewhere.
      if (is_loop && is_start_bad(s / 2, expected) != (s % 2 == 0)) return;
    }
    const WingedColumn column = s % 2 == 0 ? WingedColumn::start : WingedColumn::end;
    found.push_back({WingedTable::edges, s / 2, column, here, expected});
  }

 private:
  [[nodiscard]] bool is_start_bad(Index e, Index expected) const noexcept {
    return expected != kInvalidIndex &&
           (sides_.leaving(sides_.prev_edge(2 * e), expected) != kInvalidIndex ||
            sides_.leaving(sides_.next_edge(2 * e + 1), expected) != kInvalidIndex);
  }
  [[nodiscard]] std::ptrdiff_t count(Index e, Index v) const {
    const auto [first, last] = std::equal_range(votes_.begin(), votes_.end(), Vote{e, v});
    return last - first;
  }
  [[nodiscard]] Index most_named(Index e, Index here, Index other) const {
    auto vote = std::lower_bound(votes_.begin(), votes_.end(), Vote{e, kInvalidIndex});
    Index best = kInvalidIndex;
    std::ptrdiff_t best_count = 0;
    while (vote != votes_.end() && vote->edge == e) {
      const auto last = std::upper_bound(vote, votes_.end(), *vote);
      const bool is_new = vote->vertex != here && vote->vertex != other;
      if (is_new && last - vote > best_count) {
        best = vote->vertex;
        best_count = last - vote;
      }
      vote = last;
    }
    return best;
  }

  WingedSides sides_;
  std::vector<Vote> votes_;
};

// What a side whose link leads nowhere good should be linked to: whoever names it, or else whoever
// is alone at the same vertex in the same face.
class LinkJudge {
 public:
  explicit LinkJudge(const WingedEdgeTables& tables) : sides_(tables) {
    for (Index s = 0; s < sides_.count(); ++s) {
      if (!sides_.exists(s)) continue;
      if (!sides_.is_next_answered(s)) {
        note(claims_next_, s, sides_.next(s));
        ends_.push_back({sides_.target(s), sides_.face(s), s});
      }
      if (!sides_.is_prev_answered(s)) {
        note(claims_prev_, s, sides_.prev(s));
        starts_.push_back({sides_.origin(s), sides_.face(s), s});
      }
    }
    std::sort(claims_next_.begin(), claims_next_.end());
    std::sort(claims_prev_.begin(), claims_prev_.end());
    std::sort(ends_.begin(), ends_.end());
    std::sort(starts_.begin(), starts_.end());
  }

  std::vector<WingedFault> run() const {
    std::vector<WingedFault> found;
    for (Index s = 0; s < sides_.count(); ++s) judge(s, found);
    for (Index s = 0; found.empty() && s < sides_.count(); ++s) {
      if (!sides_.exists(s) || sides_.is_next_answered(s)) continue;
      const Index t = sides_.next(s);  // all links lead somewhere, else something was found
      found.push_back({WingedTable::edges, t / 2, prev_column(t), sides_.prev_edge(t), s / 2});
    }
    return found;
  }

 private:
  using Claim = std::pair<Index, Index>;          // named, by whom
  using Loose = std::tuple<Index, Index, Index>;  // vertex, face, side

  static void note(std::vector<Claim>& claims, Index s, Index named) {
    if (named != kInvalidIndex) claims.emplace_back(named, s);
  }
  static Index claimant(const std::vector<Claim>& claims, Index s) {
    const auto claim = std::lower_bound(claims.begin(), claims.end(), Claim{s, kInvalidIndex});
    return claim != claims.end() && claim->first == s ? claim->second : kInvalidIndex;
  }
  static Index neighbour(const std::vector<Loose>& loose, Index v, Index f, Index s) {
    for (auto i = std::lower_bound(loose.begin(), loose.end(), Loose{v, f, kInvalidIndex});
         i != loose.end() && std::get<0>(*i) == v && std::get<1>(*i) == f; ++i) {
      if (std::get<2>(*i) != (s ^ 1)) return std::get<2>(*i);
    }
    return kInvalidIndex;
  }
  static Index edge_of(Index s) noexcept { return s == kInvalidIndex ? s : s / 2; }

  void judge(Index s, std::vector<WingedFault>& found) const {
    if (!sides_.exists(s)) return;
    const Index claims_us_next = claimant(claims_prev_, s);  // names s as its prev
    const Index claims_us_prev = claimant(claims_next_, s);
    if (!sides_.has_links(s) && claims_us_next == kInvalidIndex &&
        claims_us_prev == kInvalidIndex && !has_loose_neighbours(s)) {
      found.push_back({WingedTable::edges, s / 2, face_column(s), sides_.face(s), kInvalidIndex});
      return;
    }
    if (const Index p = sides_.prev(s);
        !sides_.is_prev_answered(s) && (!is_side(p) || sides_.is_next_answered(p))) {
      const Index expected = claims_us_prev != kInvalidIndex
                                 ? claims_us_prev
                                 : neighbour(ends_, sides_.origin(s), sides_.face(s), s);
      found.push_back(
          {WingedTable::edges, s / 2, prev_column(s), sides_.prev_edge(s), edge_of(expected)});
    }
    if (const Index n = sides_.next(s);
        !sides_.is_next_answered(s) && (!is_side(n) || sides_.is_prev_answered(n))) {
      const Index expected = claims_us_next != kInvalidIndex
                                 ? claims_us_next
                                 : neighbour(starts_, sides_.target(s), sides_.face(s), s);
      found.push_back(
          {WingedTable::edges, s / 2, next_column(s), sides_.next_edge(s), edge_of(expected)});
    }
  }
  [[nodiscard]] bool is_side(Index s) const noexcept {
    return s != kInvalidIndex && sides_.exists(s);
  }
  [[nodiscard]] bool has_loose_neighbours(Index s) const {
    return neighbour(ends_, sides_.origin(s), sides_.face(s), s) != kInvalidIndex ||
           neighbour(starts_, sides_.target(s), sides_.face(s), s) != kInvalidIndex;
  }

  WingedSides sides_;
  std::vector<Claim> claims_next_;  // {t, s}: s names t as its next, unanswered
  std::vector<Claim> claims_prev_;
  std::vector<Loose> ends_;    // sides that lack a next, by the vertex they reach
  std::vector<Loose> starts_;  // sides that lack a prev, by the vertex they leave
};

}  // namespace

std::vector<WingedFault> find_bad_ends(const WingedEdgeTables& tables) {
  const EndJudge judge(tables);
  std::vector<WingedFault> found;
  for (Index s = 0; s < 2 * tables.edge_count(); ++s) judge.judge(s, found);
  return found;
}

std::vector<WingedFault> find_bad_links(const WingedEdgeTables& tables) {
  return LinkJudge(tables).run();
}

}  // namespace hedgerow::detail
