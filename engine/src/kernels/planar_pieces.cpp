#include "kernels/planar_pieces.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "kernels/planar_order.h"

namespace hedgerow::kernels {
namespace {

constexpr Index opposite(Index side) noexcept { return side ^ 1; }

// What a merge does to the edges.
class Edges {
 public:
  explicit Edges(const PlanarColumns& columns) noexcept
      : points_(columns.points), sides_(columns.sides) {}

  [[nodiscard]] Index origin(Index side) const noexcept { return sides_[side].origin; }
  [[nodiscard]] Index target(Index side) const noexcept { return sides_[opposite(side)].origin; }
  [[nodiscard]] Index next(Index side) const noexcept { return sides_[side].next; }
  [[nodiscard]] Index prev(Index side) const noexcept { return sides_[side].prev; }

  [[nodiscard]] int turn(Index a, Index b, Index c) const noexcept {
    return orient2d(points_[a], points_[b], points_[c]);
  }
  [[nodiscard]] bool is_inside(Index a, Index b, Index c, Index d) const noexcept {
    return incircle(points_[a], points_[b], points_[c], points_[d]) > 0;
  }

  void start_free_list(IndexRange points) noexcept {
    free_ = 3 * points.begin;
    last_free_ = 3 * points.end - 1;
    for (Index edge = free_; edge <= last_free_; ++edge) {
      sides_[2 * edge] = {-1, edge + 1, -1, -1};
      sides_[2 * edge + 1] = {-1, -1, -1, -1};
    }
    sides_[2 * last_free_].next = -1;
  }
  // Lists are never empty: of 3 n edges at most 3 n - 3 are in use.
  void join_free_lists(const Piece& a, const Piece& b) noexcept {
    sides_[2 * a.last_free].next = b.free;
    free_ = a.free;
    last_free_ = b.last_free;
  }
  void give_free_list(Piece& piece) const noexcept {
    piece.free = free_;
    piece.last_free = last_free_;
  }

  // A new edge that is the only one at both ends; the side that leaves `from`.
  Index add(Index from, Index to) noexcept {
    const Index side = 2 * free_;
    free_ = sides_[side].next;
    sides_[side] = {from, side, side, -1};
    sides_[side + 1] = {to, side + 1, side + 1, -1};
    return side;
  }
  void insert_after(Index side, Index place) noexcept {
    const Index after = sides_[place].next;
    sides_[place].next = side;
    sides_[side].prev = place;
    sides_[side].next = after;
    sides_[after].prev = side;
  }
  void remove(Index side) noexcept {
    take_out(side);
    take_out(opposite(side));
    const Index edge = side / 2;
    sides_[2 * edge].origin = -1;
    sides_[2 * edge + 1].origin = -1;
    sides_[2 * edge].next = free_;
    free_ = edge;
  }

 private:
  void take_out(Index side) noexcept {
    const auto [origin, after, before, corner] = sides_[side];
    sides_[before].next = after;
    sides_[after].prev = before;
  }

  const Point2* points_;
  Side* sides_;
  Index free_ = -1;
  Index last_free_ = -1;
};

bool is_before_by_x(const Point2& a, const Point2& b) noexcept {
  return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}
bool is_before_by_y(const Point2& a, const Point2& b) noexcept {
  return a[1] < b[1] || (a[1] == b[1] && a[0] > b[0]);
}

Piece one_point(Index p, const PlanarColumns& columns) noexcept {
  Piece piece{p, p, p, p, -1, -1};
  Edges edges(columns);
  edges.start_free_list({p, p + 1});
  edges.give_free_list(piece);
  columns.hull[p] = -1;
  return piece;
}

void set_extremes(Piece& piece, IndexRange range, const Point2* points) noexcept {
  piece.low_x = piece.high_x = piece.low_y = piece.high_y = range.begin;
  for (Index p = range.begin + 1; p < range.end; ++p) {
    if (is_before_by_x(points[p], points[piece.low_x])) piece.low_x = p;
    if (is_before_by_x(points[piece.high_x], points[p])) piece.high_x = p;
    if (is_before_by_y(points[p], points[piece.low_y])) piece.low_y = p;
    if (is_before_by_y(points[piece.high_y], points[p])) piece.high_y = p;
  }
}

Piece two_points(Index p, const PlanarColumns& columns) noexcept {
  Piece piece{};
  set_extremes(piece, {p, p + 2}, columns.points);
  Edges edges(columns);
  edges.start_free_list({p, p + 2});
  const Index side = edges.add(p, p + 1);
  columns.hull[p] = side;
  columns.hull[p + 1] = opposite(side);
  edges.give_free_list(piece);
  return piece;
}

Piece three_points(Index p, const PlanarColumns& columns) noexcept {
  Piece piece{};
  set_extremes(piece, {p, p + 3}, columns.points);
  Edges edges(columns);
  edges.start_free_list({p, p + 3});
  // From the first to the last by x.
  Index a = piece.low_x;
  Index c = piece.high_x;
  Index b = 3 * p + 3 - a - c;
  const int turn = edges.turn(a, b, c);
  if (turn < 0) std::swap(b, c);
  const Index ab = edges.add(a, b);
  const Index bc = edges.add(b, c);
  edges.insert_after(bc, opposite(ab));
  columns.hull[a] = ab;
  columns.hull[b] = bc;
  columns.hull[c] = opposite(bc);
  if (turn != 0) {
    const Index ca = edges.add(c, a);
    edges.insert_after(ca, opposite(bc));
    edges.insert_after(opposite(ca), ab);
    columns.hull[c] = ca;
  }
  edges.give_free_list(piece);
  return piece;
}

// The hull sides that leave the ends of the lower common tangent: of `left` clockwise, of `right`
// counter-clockwise; -1 where a piece is one point.
struct Tangent {
  Index left;
  Index right;
  Index left_side;
  Index right_side;
};

Tangent find_lower_tangent(Index left, Index right, const Edges& edges,
                           const Index* hull) noexcept {
  Tangent t{left, right, hull[left] < 0 ? -1 : edges.prev(hull[left]), hull[right]};
  while (true) {
    if (t.left_side >= 0 && edges.turn(t.left, edges.target(t.left_side), t.right) > 0) {
      t.left = edges.target(t.left_side);
      t.left_side = edges.prev(opposite(t.left_side));
    } else if (t.right_side >= 0 && edges.turn(t.right, edges.target(t.right_side), t.left) < 0) {
      t.right = edges.target(t.right_side);
      t.right_side = edges.next(opposite(t.right_side));
    } else {
      return t;
    }
  }
}

// Fills the gap between two pieces, upwards from their lower tangent. Returns the upper one.
Index rise(Index base, Edges& edges) noexcept {
  while (true) {
    const Index left = edges.target(base);
    const Index right = edges.origin(base);
    // Edges whose circle with the base holds the next point of the same piece go.
    Index to_left = edges.next(opposite(base));
    const bool has_left = edges.turn(left, right, edges.target(to_left)) > 0;
    if (has_left) {
      for (Index beyond = edges.next(to_left);
           beyond != opposite(base) &&
           edges.is_inside(left, right, edges.target(to_left), edges.target(beyond));
           beyond = edges.next(to_left)) {
        edges.remove(std::exchange(to_left, beyond));
      }
    }
    Index to_right = edges.prev(base);
    const bool has_right = edges.turn(left, right, edges.target(to_right)) > 0;
    if (has_right) {
      for (Index beyond = edges.prev(to_right);
           beyond != base &&
           edges.is_inside(left, right, edges.target(to_right), edges.target(beyond));
           beyond = edges.prev(to_right)) {
        edges.remove(std::exchange(to_right, beyond));
      }
    }
    if (!has_left && !has_right) return base;
    const bool takes_right =
        !has_left ||
        (has_right && edges.is_inside(left, right, edges.target(to_left), edges.target(to_right)));
    if (takes_right) {
      const Index side = edges.add(edges.target(to_right), left);
      edges.insert_after(side, edges.prev(opposite(to_right)));
      edges.insert_after(opposite(side), opposite(base));
      base = side;
    } else {
      const Index side = edges.add(right, edges.target(to_left));
      edges.insert_after(side, edges.prev(base));
      edges.insert_after(opposite(side), opposite(to_left));
      base = side;
    }
  }
}

}  // namespace

PlanarCut cut_of(IndexRange range, unsigned depth, const std::uint64_t* keys) noexcept {
  const std::uint64_t differing = keys[range.begin] ^ keys[range.end - 1];
  if (differing == 0) {
    return {range.begin + range.size() / 2, is_by_y_at(depth), depth + 1};
  }
  const auto bit = static_cast<unsigned>(std::bit_width(differing)) - 1;
  const std::uint64_t* at =
      std::partition_point(keys + range.begin, keys + range.end,
                           [bit](std::uint64_t key) noexcept { return (key >> bit & 1U) == 0; });
  return {static_cast<Index>(at - keys), bit % 2 == 1, 0};
}

Piece triangulate_range(IndexRange range, unsigned depth, const PlanarColumns& columns) noexcept {
  if (range.size() == 1) return one_point(range.begin, columns);
  if (range.size() == 2) return two_points(range.begin, columns);
  if (range.size() == kSmallPiece) return three_points(range.begin, columns);
  const PlanarCut cut = cut_of(range, depth, columns.keys);
  const Piece low = triangulate_range({range.begin, cut.at}, cut.depth, columns);
  const Piece high = triangulate_range({cut.at, range.end}, cut.depth, columns);
  return join_pieces(low, high, cut.is_by_y, columns);
}

Piece join_pieces(const Piece& low, const Piece& high, bool is_by_y,
                  const PlanarColumns& columns) noexcept {
  Edges edges(columns);
  edges.join_free_lists(low, high);
  const Tangent lower = find_lower_tangent(is_by_y ? low.high_y : low.high_x,
                                           is_by_y ? high.low_y : high.low_x, edges, columns.hull);
  const Index base = edges.add(lower.right, lower.left);
  if (lower.right_side >= 0) edges.insert_after(base, edges.prev(lower.right_side));
  if (lower.left_side >= 0) edges.insert_after(opposite(base), lower.left_side);
  const Index upper = rise(base, edges);
  columns.hull[lower.left] = opposite(base);
  columns.hull[edges.origin(upper)] = upper;

  const Point2* points = columns.points;
  Piece piece{};
  piece.low_x = is_before_by_x(points[low.low_x], points[high.low_x]) ? low.low_x : high.low_x;
  piece.high_x = is_before_by_x(points[low.high_x], points[high.high_x]) ? high.high_x : low.high_x;
  piece.low_y = is_before_by_y(points[low.low_y], points[high.low_y]) ? low.low_y : high.low_y;
  piece.high_y = is_before_by_y(points[low.high_y], points[high.high_y]) ? high.high_y : low.high_y;
  edges.give_free_list(piece);
  return piece;
}

}  // namespace hedgerow::kernels
