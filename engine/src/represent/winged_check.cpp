#include <algorithm>
#include <iterator>

#include "at.h"
#include "represent/winged_sides.h"

namespace hedgerow {

namespace {

using detail::WingedSides;

constexpr const char* kTableNames[] = {"vertices", "faces", "edges"};
constexpr const char* kColumnNames[] = {"edge",     "start",    "end",     "prev_cw", "next_cw",
                                        "prev_ccw", "next_ccw", "face_cw", "face_ccw"};
static_assert(std::size(kColumnNames) == static_cast<std::size_t>(WingedColumn::face_ccw) + 1);

bool are_ends_and_links_good(const WingedSides& sides) {
  for (Index s = 0; s < sides.count(); ++s) {
    if (!sides.has_vertex(sides.origin(s)) || sides.origin(s) == sides.target(s)) return false;
    if (!sides.exists(s)) continue;
    if (!sides.is_next_answered(s) || !sides.is_prev_answered(s)) return false;
  }
  return true;
}

// The face that most sides of a cycle have; the smallest of several.
Index most_common(std::vector<Index>& faces) {
  std::sort(faces.begin(), faces.end());
  Index best = kInvalidIndex;
  std::ptrdiff_t best_count = 0;
  for (auto run = faces.begin(); run != faces.end();) {
    const auto last = std::upper_bound(run, faces.end(), *run);
    if (last - run > best_count) {
      best = *run;
      best_count = last - run;
    }
    run = last;
  }
  return best;
}

// Follows the links, which are known to be good, and looks at what they join.
class CycleCheck {
 public:
  explicit CycleCheck(const WingedEdgeTables& tables)
      : t_(tables), sides_(tables), cycle_of_face_(at(tables.face_count()), kInvalidIndex) {}

  std::vector<WingedFault> check_faces() {
    std::vector<std::uint8_t> is_met(at(sides_.count()), 0);
    for (Index s = 0; s < sides_.count(); ++s) {
      if (sides_.exists(s) && is_met[at(s)] == 0) check_cycle(s, is_met);
    }
    if (found_.empty() && has_loops_) check_all_sides_exist();
    return std::move(found_);
  }

  std::vector<WingedFault> check_edges_of_others() {
    std::vector<Index> of_vertex(at(t_.vertex_count()), kInvalidIndex);
    std::vector<Index> of_face(at(t_.face_count()), kInvalidIndex);
    for (Index s = sides_.count(); s-- > 0;) {
      of_vertex[at(sides_.origin(s))] = s / 2;
      if (sides_.face(s) != kInvalidIndex) of_face[at(sides_.face(s))] = s / 2;
    }
    for (Index v = 0; v < t_.vertex_count(); ++v) {
      const Index e = t_.vertex_edge[at(v)].value;
      const bool is_good = of_vertex[at(v)] == kInvalidIndex
                               ? e == kInvalidIndex
                               : sides_.leaving(e, v) != kInvalidIndex;
      if (!is_good) add(WingedTable::vertices, v, e, of_vertex[at(v)]);
    }
    for (Index f = 0; f < t_.face_count(); ++f) {
      const Index e = t_.face_edge[at(f)].value;
      const bool is_good =
          of_face[at(f)] == kInvalidIndex
              ? e == kInvalidIndex
              : sides_.has_edge(e) && (sides_.face(2 * e) == f || sides_.face(2 * e + 1) == f);
      if (!is_good) add(WingedTable::faces, f, e, of_face[at(f)]);
    }
    return std::move(found_);
  }

 private:
  void add(WingedTable table, Index row, Index found, Index expected) {
    found_.push_back({table, row, WingedColumn::edge, found, expected});
  }
  void add_face(Index s, Index expected) {
    found_.push_back({WingedTable::edges, s / 2, detail::face_column(s), sides_.face(s), expected});
  }

  void check_cycle(Index start, std::vector<std::uint8_t>& is_met) {
    faces_.clear();
    Index s = start;
    do {
      is_met[at(s)] = 1;
      const Index f = sides_.face(s);
      if (f == kInvalidIndex || sides_.has_face(f)) faces_.push_back(f);
      s = sides_.next(s);
    } while (s != start);
    // A cycle of which no side has a face that exists is the face that has no cycle yet.
    const Index face = faces_.empty() ? unused_face() : most_common(faces_);
    do {
      if (sides_.face(s) != face) add_face(s, face);
      s = sides_.next(s);
    } while (s != start);
    if (face == kInvalidIndex) {
      has_loops_ = true;
    } else if (cycle_of_face_[at(face)] == kInvalidIndex) {
      cycle_of_face_[at(face)] = start;
    } else {
      add_face(start, unused_face());  // a face has one cycle
    }
  }

  // The next face that no side names; none if there are no more.
  Index unused_face() {
    if (is_used_.empty()) {
      is_used_.assign(at(t_.face_count()) + 1, 0);
      for (Index s = 0; s < sides_.count(); ++s) {
        if (sides_.has_face(sides_.face(s))) is_used_[at(sides_.face(s))] = 1;
      }
    }
    while (next_unused_ < t_.face_count() && is_used_[at(next_unused_)] != 0) ++next_unused_;
    return next_unused_ < t_.face_count() ? next_unused_++ : kInvalidIndex;
  }

  // Where some holes have their walk, all have.
  void check_all_sides_exist() {
    for (Index s = 0; s < sides_.count(); ++s) {
      if (sides_.exists(s)) continue;
      found_.push_back({WingedTable::edges, s / 2, detail::next_column(s), kInvalidIndex,
                        next_round_the_hole(s) / 2});
    }
  }
  // The side without face that leaves where s arrives, by rotation through the faces.
  [[nodiscard]] Index next_round_the_hole(Index s) const {
    Index t = s ^ 1;
    while (sides_.exists(t) && sides_.face(t) != kInvalidIndex) t = sides_.prev(t) ^ 1;
    return t;
  }

  const WingedEdgeTables& t_;
  WingedSides sides_;
  std::vector<Index> cycle_of_face_;
  std::vector<Index> faces_;  // of the cycle at hand
  std::vector<WingedFault> found_;
  std::vector<std::uint8_t> is_used_;  // by face; empty until it is needed
  Index next_unused_ = 0;
  bool has_loops_ = false;  // the closed form
};

void sort(std::vector<WingedFault>& faults) {
  std::sort(faults.begin(), faults.end(), [](const WingedFault& a, const WingedFault& b) {
    if (a.table != b.table) return a.table < b.table;
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  });
}

}  // namespace

const char* name(WingedTable table) noexcept {
  return kTableNames[static_cast<std::size_t>(table)];
}
const char* name(WingedColumn column) noexcept {
  return kColumnNames[static_cast<std::size_t>(column)];
}

std::vector<WingedFault> check_winged_edges(const WingedEdgeTables& tables) {
  std::vector<WingedFault> found;
  if (!are_ends_and_links_good(WingedSides(tables))) {
    found = detail::find_bad_ends(tables);
    if (found.empty()) found = detail::find_bad_links(tables);
  }
  if (found.empty()) found = CycleCheck(tables).check_faces();
  if (found.empty()) found = CycleCheck(tables).check_edges_of_others();
  sort(found);
  return found;
}

}  // namespace hedgerow
