#include "hedgerow/triangulate.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernels/planar_faces.h"
#include "kernels/planar_order.h"
#include "kernels/planar_pieces.h"
#include "parallel/parallel.h"
#include "reorder/stable_sort.h"

namespace hedgerow {

namespace {

constexpr Index kPointGrain = 1 << 14;  // points a task: 1.6 MB of sides

/// The phases of one triangulation.
class Triangulator {
 public:
  Triangulator(std::span<const Point2> points, const Execution& execution)
      : points_(points.data()), count_(static_cast<Index>(points.size())), execution_(execution) {}

  Triangulation run(const kernels::PlanarBox& box) {
    sort_by_cells(box);
    Triangulation result;
    drop_repeated(result);
    order_within_cells();
    join_tree();
    result.mesh = mesh();
    return result;
  }

 private:
  void sort_by_cells(const kernels::PlanarBox& box) {
    const kernels::PlanarLattice lattice(box, count_);
    Buffer<kernels::KeyedItem> items(static_cast<std::size_t>(count_));
    par::for_each_range(execution_, count_, kPointGrain, [&](IndexRange range) {
      kernels::fill_planar_keys(range, points_, lattice, items.data());
    });
    order_ = detail::sorted_items(std::move(items), execution_);
    keys_ = Buffer<std::uint64_t>(order_.size());
    par::for_each_range(execution_, count_, kPointGrain, [&](IndexRange range) {
      for (Index i = range.begin; i < range.end; ++i) {
        keys_.data()[i] = lattice.key(points_[order_.data()[i]]);
      }
    });
  }

  // Calls function(range) -> Index for each run of two or more equal keys, and adds the results up.
  // A run belongs to the task in which it starts.
  template <class Function>
  Index for_each_cell(const Function& function) {
    return par::reduce<Index>(
        execution_, count_, kPointGrain,
        [&](IndexRange range) {
          Index sum = 0;
          const std::uint64_t* keys = keys_.data();
          Index i = range.begin;
          while (i > 0 && i < range.end && keys[i] == keys[i - 1]) ++i;
          while (i < range.end) {
            Index end = i + 1;
            while (end < count_ && keys[end] == keys[i]) ++end;
            if (end - i > 1) sum += function(IndexRange{i, end});
            i = end;
          }
          return sum;
        },
        [](Index a, Index b) { return a + b; });
  }

  void drop_repeated(Triangulation& result) {
    Index* order = order_.data();
    const Index repeated =
        for_each_cell([&](IndexRange cell) { return kernels::order_cell(cell, points_, order); });
    if (repeated == 0) return;
    result.same_as = Buffer<Index>(order_.size());
    Index* same_as = result.same_as.data();
    Index kept = 0;
    for (Index i = 0; i < count_; ++i) {
      const bool is_repeated = kept > 0 && points_[order[kept - 1]] == points_[order[i]];
      same_as[order[i]] = order[is_repeated ? kept - 1 : i];
      if (is_repeated) continue;
      keys_.data()[kept] = keys_.data()[i];
      order[kept++] = order[i];
    }
    count_ = kept;
  }

  void order_within_cells() {
    for_each_cell([&](IndexRange cell) {
      if (cell.size() > kernels::kSmallPiece) {
        kernels::order_as_tree(cell, points_, order_.data());
      }
      return Index{0};
    });
    sorted_ = Buffer<Point2>(static_cast<std::size_t>(count_));
    par::for_each_range(execution_, count_, kPointGrain, [&](IndexRange range) {
      for (Index i = range.begin; i < range.end; ++i) {
        sorted_.data()[i] = points_[order_.data()[i]];
      }
    });
  }

  struct Node {
    IndexRange range;
    unsigned depth;  // as PlanarCut has it
    bool is_by_y = false;
    std::size_t low = 0;  // children; none: the node is a task of its own
    std::size_t high = 0;
    kernels::Piece piece{};
  };

  // The upper part of the tree of cuts, level by level.
  void plan(std::vector<Node>& nodes, std::vector<std::size_t>& levels) const {
    nodes.push_back({{0, count_}, 0});
    for (std::size_t begin = 0; begin < nodes.size();) {
      levels.push_back(begin);
      const std::size_t end = nodes.size();
      for (std::size_t i = begin; i < end; ++i) {
        const Node node = nodes[i];
        if (node.range.size() <=
            std::max(par::grain_of(execution_, kPointGrain), kernels::kSmallPiece)) {
          continue;
        }
        const kernels::PlanarCut cut = kernels::cut_of(node.range, node.depth, keys_.data());
        nodes[i].is_by_y = cut.is_by_y;
        nodes[i].low = nodes.size();
        nodes[i].high = nodes.size() + 1;
        nodes.push_back({{node.range.begin, cut.at}, cut.depth});
        nodes.push_back({{cut.at, node.range.end}, cut.depth});
      }
      begin = end;
    }
    levels.push_back(nodes.size());
  }

  void join_tree() {
    sides_ = Buffer<kernels::Side>(static_cast<std::size_t>(6 * count_));
    hull_ = Buffer<Index>(static_cast<std::size_t>(count_));
    if (count_ == 0) return;
    const kernels::PlanarColumns columns{sorted_.data(), keys_.data(), sides_.data(), hull_.data()};
    std::vector<Node> nodes;
    std::vector<std::size_t> levels;
    plan(nodes, levels);
    for (std::size_t level = levels.size() - 1; level-- > 0;) {
      const auto width = static_cast<Index>(levels[level + 1] - levels[level]);
      par::for_each_task(execution_, width, [&](Index task, Index) {
        Node& node = nodes[levels[level] + static_cast<std::size_t>(task)];
        node.piece = node.low == 0
                         ? kernels::triangulate_range(node.range, node.depth, columns)
                         : kernels::join_pieces(nodes[node.low].piece, nodes[node.high].piece,
                                                node.is_by_y, columns);
      });
    }
    const Index start = hull_.data()[nodes[0].piece.low_x];
    if (start >= 0) kernels::mark_outside(start ^ 1, sides_.data());
  }

  Connectivity mesh() {
    const auto side_count = static_cast<Index>(sides_.size());
    const Index halfedge_count = kernels::number_corners(side_count, sides_.data());
    const auto size = static_cast<std::size_t>(halfedge_count);
    Buffer<Index> origin(size);
    Buffer<Index> opposite(size);
    kernels::fill_triangles(side_count, sides_.data(), order_.data(), origin.data(),
                            opposite.data());
    kernels::fill_starts({0, count_}, side_count, sides_.data(), hull_.data());
    Buffer<Index> outgoing(order_.size(), kInvalidIndex);
    for (Index i = 0; i < count_; ++i) {
      outgoing.data()[order_.data()[i]] = hull_.data()[i];
    }
    ConnectivityColumns columns;
    columns.origin = std::move(origin);
    columns.opposite = std::move(opposite);
    columns.outgoing = std::move(outgoing);
    columns.all_triangles = true;
    return Connectivity(std::move(columns));
  }

  const Point2* points_;
  Index count_;  // without repeated ones, once these are dropped
  const Execution& execution_;
  Buffer<Index> order_;
  Buffer<std::uint64_t> keys_;
  Buffer<Point2> sorted_;
  Buffer<kernels::Side> sides_;
  Buffer<Index> hull_;
};

}  // namespace

Result<Triangulation> triangulate(std::span<const Point2> points, const Execution& execution) {
  constexpr std::int64_t kLimit = kMaxCount / 6;
  const auto count = static_cast<std::int64_t>(points.size());
  if (count > kLimit) {
    return fail({ErrorCode::too_many_elements, kInvalidIndex, count, kLimit});
  }
  const kernels::PlanarBox box = par::reduce<kernels::PlanarBox>(
      execution, static_cast<Index>(count), kPointGrain,
      [&](IndexRange range) { return kernels::find_planar_box(range, points.data()); },
      [](const kernels::PlanarBox& a, const kernels::PlanarBox& b) { return join(a, b); });
  if (box.bad_count > 0) {
    const Point2& bad = points[static_cast<std::size_t>(box.bad)];
    const std::int64_t axis = kernels::is_usable(bad[0]) ? 1 : 0;
    return fail(
        {ErrorCode::coordinate_out_of_range, box.bad, axis, kernels::kMaxExponent, box.bad_count});
  }
  return Triangulator(points, execution).run(box);
}

}  // namespace hedgerow
