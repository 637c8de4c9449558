#include "hedgerow/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "at.h"
#include "float3_check.h"
#include "hedgerow/assert.h"
#include "kernels/join_sets.h"
#include "kernels/weld_cells.h"

namespace hedgerow {

namespace {

using kernels::WeldBox;
using kernels::WeldCell;
using kernels::WeldPoint;

// Joins the vertices at one place, and returns one point for each place.
std::vector<WeldPoint> join_equal(Positions positions, Index* parent) {
  std::vector<WeldPoint> points;
  points.reserve(static_cast<std::size_t>(positions.count));
  for (Index v = 0; v < static_cast<Index>(positions.count); ++v) {
    const float* p = positions[v];
    if (std::isnan(p[0]) || std::isnan(p[1]) || std::isnan(p[2])) continue;
    points.push_back({{p[0] + 0.0F, p[1] + 0.0F, p[2] + 0.0F}, v});  // -0 becomes 0
  }
  const auto key = [](const WeldPoint& a) { return std::tuple(a.p[0], a.p[1], a.p[2], a.vertex); };
  std::sort(points.begin(), points.end(),
            [&](const WeldPoint& a, const WeldPoint& b) { return key(a) < key(b); });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_same = i > 0 && std::equal(points[i].p, points[i].p + 3, points[kept - 1].p);
    if (is_same) {
      kernels::join_sets(parent, points[kept - 1].vertex, points[i].vertex);
    } else {
      points[kept++] = points[i];
    }
  }
  points.resize(kept);
  return points;
}

// Points in runs: of one half cell, and of one cell after the other.
class Grid {
 public:
  Grid(std::vector<WeldPoint>&& points, double distance)
      : limit_(distance * distance), points_(std::move(points)) {
    const double side = 0.5 * distance * kernels::kWeldMargin;
    struct Placed {
      WeldCell cell;
      WeldPoint point;
      [[nodiscard]] auto key() const noexcept {
        return std::tuple(cell.whole(0), cell.whole(1), cell.whole(2), cell.half[0], cell.half[1],
                          cell.half[2], point.vertex);
      }
    };
    std::vector<Placed> placed;
    placed.reserve(points_.size());
    for (const WeldPoint& point : points_) placed.push_back({kernels::cell_of(point, side), point});
    std::sort(placed.begin(), placed.end(),
              [](const Placed& a, const Placed& b) { return a.key() < b.key(); });
    for (std::size_t i = 0; i < placed.size(); ++i) {
      points_[i] = placed[i].point;
      const auto is_other = [&](const auto& part) {
        return i == 0 || part(placed[i]) != part(placed[i - 1]);
      };
      const auto whole = [](const Placed& p) {
        return std::array{p.cell.whole(0), p.cell.whole(1), p.cell.whole(2)};
      };
      const auto half = [](const Placed& p) {
        return std::array{p.cell.half[0], p.cell.half[1], p.cell.half[2]};
      };
      if (is_other(whole)) cells_.push_back({whole(placed[i]), octants_.size()});
      if (is_other(half)) octants_.push_back(i);
    }
    octants_.push_back(points_.size());
    fill_table();
  }

  void join_near(Index* parent) {
    for (std::size_t o = 0; o + 1 < octants_.size(); ++o) {
      for (std::size_t i = octants_[o] + 1; i < octants_[o + 1]; ++i) {
        kernels::join_sets(parent, points_[octants_[o]].vertex, points_[i].vertex);
      }
    }
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      join_octants(c, c, parent);
      for (int step = 14; step < 27; ++step) {  // one of each two opposite neighbours
        const std::array<std::int64_t, 3> neighbour = {cells_[c].place[0] + step / 9 - 1,
                                                       cells_[c].place[1] + step / 3 % 3 - 1,
                                                       cells_[c].place[2] + step % 3 - 1};
        if (const std::size_t other = find(neighbour); other < cells_.size()) {
          join_octants(c, other, parent);
        }
      }
    }
  }

 private:
  struct Cell {
    std::array<std::int64_t, 3> place;
    std::size_t first_octant;
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  [[nodiscard]] std::size_t end_octant(std::size_t c) const noexcept {
    return c + 1 < cells_.size() ? cells_[c + 1].first_octant : octants_.size() - 1;
  }

  [[nodiscard]] std::size_t slot_of(const std::array<std::int64_t, 3>& place) const noexcept {
    std::uint64_t hash = 0;
    for (const std::int64_t i : place) {
      hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 29U;
    }
    return static_cast<std::size_t>(hash) & (table_.size() - 1);
  }
  void fill_table() {
    std::size_t size = 2;
    while (size < 2 * cells_.size()) size *= 2;
    table_.assign(size, kNone);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      std::size_t slot = slot_of(cells_[c].place);
      while (table_[slot] != kNone) slot = (slot + 1) & (size - 1);
      table_[slot] = c;
    }
  }
  [[nodiscard]] std::size_t find(const std::array<std::int64_t, 3>& place) const noexcept {
    std::size_t slot = slot_of(place);
    while (table_[slot] != kNone && cells_[table_[slot]].place != place) {
      slot = (slot + 1) & (table_.size() - 1);
    }
    return table_[slot];
  }

  void join_octants(std::size_t c, std::size_t other, Index* parent) {
    for (std::size_t a = cells_[c].first_octant; a < end_octant(c); ++a) {
      const std::size_t begin = c == other ? a + 1 : cells_[other].first_octant;
      for (std::size_t b = begin; b < end_octant(other); ++b) {
        const Index va = points_[octants_[a]].vertex;
        const Index vb = points_[octants_[b]].vertex;
        if (kernels::find_root(parent, va) == kernels::find_root(parent, vb)) continue;
        const bool is_near =
            has_near(points_.data() + octants_[a], points_.data() + octants_[a + 1],
                     points_.data() + octants_[b], points_.data() + octants_[b + 1]);
        if (is_near) kernels::join_sets(parent, va, vb);
      }
    }
  }

  // Whether some point of one run is near one of the other. The runs may be put in another order.
  [[nodiscard]] bool has_near(WeldPoint* a, WeldPoint* a_end, WeldPoint* b,
                              WeldPoint* b_end) const {
    constexpr std::ptrdiff_t kFew = 64;
    if ((a_end - a) * (b_end - b) <= kFew) {
      for (const WeldPoint* p = a; p < a_end; ++p) {
        for (const WeldPoint* q = b; q < b_end; ++q) {
          if (kernels::square_distance(*p, *q) <= limit_) return true;
        }
      }
      return false;
    }
    const WeldBox box_a = kernels::box_of(a, a_end);
    const WeldBox box_b = kernels::box_of(b, b_end);
    if (kernels::least_square_distance(box_a, box_b) > limit_) return false;
    if (kernels::most_square_distance(box_a, box_b) <= limit_) return true;
    if (b_end - b > a_end - a) return has_near_halved(b, b_end, a, a_end, box_b);
    return has_near_halved(a, a_end, b, b_end, box_a);
  }
  [[nodiscard]] bool has_near_halved(WeldPoint* a, WeldPoint* a_end, WeldPoint* b, WeldPoint* b_end,
                                     const WeldBox& box_a) const {
    const int axis = box_a.longest_axis();
    WeldPoint* middle = a + (a_end - a) / 2;
    std::nth_element(a, middle, a_end, [axis](const WeldPoint& p, const WeldPoint& q) {
      return p.p[axis] < q.p[axis];
    });
    return has_near(a, middle, b, b_end) || has_near(middle, a_end, b, b_end);
  }

  double limit_;
  std::vector<WeldPoint> points_;
  std::vector<std::size_t> octants_;  // where each begins, and the end
  std::vector<Cell> cells_;
  std::vector<std::size_t> table_;  // of cells, by their place
};

}  // namespace

Result<Weld> find_weld(Positions positions, double distance) {
  HEDGEROW_ASSERT(distance >= 0);
  if (positions.count > kMaxCount) {
    return fail({ErrorCode::too_many_elements, kInvalidIndex, positions.count, kMaxCount});
  }
  if (auto ok = detail::check_float3(positions, positions.count); !ok) return fail(ok.error());
  const auto count = static_cast<Index>(positions.count);
  std::vector<Index> parent(at(count));
  kernels::fill_singletons({0, count}, parent.data());
  std::vector<WeldPoint> places = join_equal(positions, parent.data());
  if (distance > 0) Grid(std::move(places), distance).join_near(parent.data());
  Weld weld;
  weld.old_to_new = Buffer<Index>(at(count));
  std::vector<Index> kept;
  for (Index v = 0; v < count; ++v) {
    const Index root = kernels::find_root(parent.data(), v);
    if (root == v) kept.push_back(v);
    // The smallest of a group is its root, so it has its new number already.
    weld.old_to_new[at(v)] =
        root == v ? static_cast<Index>(kept.size()) - 1 : weld.old_to_new[at(root)];
  }
  weld.new_to_old = Buffer<Index>::copy_of(kept);
  return weld;
}

Soup welded(const Soup& soup, const Weld& weld) {
  Soup out{Buffer<float>(3 * weld.new_to_old.size()), Buffer<Index>(soup.corners.size()),
           Buffer<Index>::copy_of(soup.offsets.span())};
  for (std::size_t v = 0; v < weld.new_to_old.size(); ++v) {
    std::copy_n(soup.xyz.data() + 3 * at(weld.new_to_old[v]), 3, out.xyz.data() + 3 * v);
  }
  for (std::size_t c = 0; c < soup.corners.size(); ++c) {
    const Index v = soup.corners[c];
    const bool is_vertex = v >= 0 && v < soup.vertex_count();
    out.corners[c] = is_vertex ? weld.old_to_new[at(v)] : v;
  }
  return out;
}

}  // namespace hedgerow
