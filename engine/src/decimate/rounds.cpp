#include "decimate/rounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "at.h"
#include "decimate/part.h"
#include "parallel/parallel.h"
#include "reorder/orders.h"

namespace hedgerow::decimation {
namespace {

constexpr Index kRoundGrain = 1 << 16;
constexpr std::int64_t kRest = 32;  // a queue does the last collapses: one of so many,
constexpr std::int64_t kFew = 16;   // or what is left when a round does less than one of so many
// Of the collapses that are wanted, how many a round aims at.
constexpr double kAim = 0.8;
constexpr double kLeastYield = 0.25;
// Of the longest side. Cuts along a curve come at halves, quarters and so on of the box; those of a
// box that begins so much lower come elsewhere.
constexpr float kShift = 0.31F;

/// Where on a curve each vertex is: parts are what lies between two places.
Buffer<Index> places_on_curve(const Positions& positions, Index vertex_count,
                              const Execution& execution, float shift) {
  const Buffer<Index> order = detail::vertices_by_cells(positions, vertex_count, execution, shift);
  Buffer<Index> places(order.size());
  par::for_each_range(execution, vertex_count, kRoundGrain, [&](IndexRange range) {
    for (Index i = range.begin; i < range.end; ++i) places[at(order[at(i)])] = i;
  });
  return places;
}

/// How many edges each bucket holds, of equal shares of the half-edges.
class CostCounts {
 public:
  CostCounts(std::span<const float> costs, const Execution& execution)
      : costs_(costs),
        shares_(par::share_count(execution, count(), kRoundGrain)),
        counts_(at(shares_) * CostBuckets::kCount) {
    par::for_each_task(execution, shares_, [&](Index share, Index) {
      Index* own = counts_.data() + at(share) * CostBuckets::kCount;
      const IndexRange range = par::share_of(share, shares_, count());
      for (Index h = range.begin; h < range.end; ++h) {
        if (std::isfinite(costs_[at(h)])) ++own[CostBuckets::bucket_of(costs_[at(h)])];
      }
    });
  }

  [[nodiscard]] std::int64_t of_bucket(std::size_t bucket) const noexcept {
    std::int64_t sum = 0;
    for (Index share = 0; share < shares_; ++share) sum += of(share, bucket);
    return sum;
  }
  /// The edges up to a bucket, ascending.
  [[nodiscard]] Buffer<Index> edges_up_to(std::size_t highest, const Execution& execution) const {
    std::vector<std::size_t> begins = {0};
    for (Index share = 0; share < shares_; ++share) {
      std::size_t sum = begins.back();
      for (std::size_t i = 0; i <= highest; ++i) sum += at(of(share, i));
      begins.push_back(sum);
    }
    Buffer<Index> edges(begins.back());
    par::for_each_task(execution, shares_, [&](Index share, Index) {
      std::size_t to = begins[at(share)];
      const IndexRange range = par::share_of(share, shares_, count());
      for (Index h = range.begin; h < range.end; ++h) {
        const float cost = costs_[at(h)];
        if (std::isfinite(cost) && CostBuckets::bucket_of(cost) <= highest) edges[to++] = h;
      }
    });
    return edges;
  }

 private:
  [[nodiscard]] Index count() const noexcept { return static_cast<Index>(costs_.size()); }
  [[nodiscard]] Index of(Index share, std::size_t bucket) const noexcept {
    return counts_[at(share) * CostBuckets::kCount + bucket];
  }

  std::span<const float> costs_;
  Index shares_;
  std::vector<Index> counts_;
};

/// The bucket up to which there are as many edges as are wanted, or fewer; where that is less than
/// a quarter of them, one bucket more. None: nothing is to be done below `max_cost`.
std::optional<std::size_t> find_threshold(const CostCounts& counts, std::int64_t wanted,
                                          double max_cost) {
  if (!(max_cost > 0)) return {};
  // Within the bucket of the limit only a look at each edge tells.
  std::size_t end = CostBuckets::kCount;
  if (max_cost < static_cast<double>(std::numeric_limits<float>::max())) {
    end = CostBuckets::bucket_of(static_cast<float>(max_cost));
  }
  std::optional<std::size_t> found;
  std::int64_t below = 0;
  for (std::size_t bucket = 0; bucket < end; ++bucket) {
    const std::int64_t own = counts.of_bucket(bucket);
    if (own == 0) continue;
    if (below + own > wanted && 4 * below >= wanted) break;
    found = bucket;
    below += own;
  }
  return found;
}

/// Edges by the part of the vertex that their half-edge leaves, in their order in each part.
struct PartLists {
  Buffer<Index> edges;
  std::vector<Index> begins;  // of each part, and the end

  [[nodiscard]] std::span<Index> of(Index part) noexcept {
    const auto begin = at(begins[at(part)]);
    return edges.span().subspan(begin, at(begins[at(part) + 1]) - begin);
  }
};
PartLists list_by_part(const Buffer<Index>& edges, const Pass& pass, Index part_count,
                       const Execution& execution) {
  const auto count = static_cast<Index>(edges.size());
  const Index shares = par::share_count(execution, count, kRoundGrain);
  const auto for_each_edge = [&](Index share, const auto& visit) {
    const IndexRange range = par::share_of(share, shares, count);
    for (Index i = range.begin; i < range.end; ++i) {
      const VertexId v = pass.mesh.view().origin[HalfedgeId(edges[at(i)])];
      visit(edges[at(i)], pass.places[at(v.value)] / pass.part_size);
    }
  };
  // Of each part, share by share: first how many, then where they go.
  std::vector<Index> next(at(shares) * at(part_count));
  const auto next_of = [&](Index share, Index part) -> Index& {
    return next[at(share) * at(part_count) + at(part)];
  };
  par::for_each_task(execution, shares, [&](Index share, Index) {
    for_each_edge(share, [&](Index, Index part) { ++next_of(share, part); });
  });
  PartLists lists;
  lists.begins.reserve(at(part_count) + 1);
  Index sum = 0;
  for (Index part = 0; part < part_count; ++part) {
    lists.begins.push_back(sum);
    for (Index share = 0; share < shares; ++share) {
      sum += std::exchange(next_of(share, part), sum);
    }
  }
  lists.begins.push_back(sum);
  lists.edges = Buffer<Index>(at(sum));
  par::for_each_task(execution, shares, [&](Index share, Index) {
    for_each_edge(share, [&](Index h, Index part) { lists.edges[at(next_of(share, part)++)] = h; });
  });
  return lists;
}

/// All of the rounds.
class Rounds {
 public:
  Rounds(ShrinkingMesh& mesh, Buffer<float>& costs, const Positions& positions,
         const DecimateOptions& options, const Execution& execution, DecimateOutput& output)
      : mesh_(mesh),
        costs_(costs),
        options_(options),
        execution_(execution),
        output_(output),
        vertex_count_(mesh.view().vertex_count()),
        faces_(mesh.view().face_count()),
        following_(costs.size()),
        places_{places_on_curve(positions, vertex_count_, execution, 0),
                places_on_curve(positions, vertex_count_, execution, kShift)},
        queues_(at(par::slot_count(execution, vertex_count_))) {}

  std::int64_t run() {
    const std::int64_t all = wanted();
    double yield = kAim;
    while (wanted() > all / kRest) {
      // More edges than collapses that are wanted: each takes others along.
      const auto edges = static_cast<std::int64_t>(kAim / yield * static_cast<double>(wanted()));
      const CostCounts costs(costs_.span(), execution_);
      const auto highest = find_threshold(costs, edges, options_.max_cost);
      if (!highest) break;
      const std::int64_t wanted_before = wanted();
      const std::int64_t collapses_before = output_.accepted;
      Buffer<Index> list = costs.edges_up_to(*highest, execution_);
      const auto edge_count = static_cast<std::int64_t>(list.size());
      for (const Buffer<Index>& places : places_) list = run_pass(list, places, *highest);
      const auto postponed = static_cast<std::int64_t>(list.size());
      // What the second cut keeps apart, too, is left for the next round.
      output_.candidates += postponed;
      output_.postponed += postponed;
      ++output_.rounds;
      const std::int64_t collapses = output_.accepted - collapses_before;
      if (kFew * collapses < wanted_before) break;
      if (2 * (vertex_count_ - output_.collapses) < mesh_.view().vertex_count()) pack();
      yield = std::clamp(static_cast<double>(collapses) / static_cast<double>(edge_count),
                         kLeastYield, kAim);
    }
    return faces_;
  }

 private:
  // None of them takes more than two faces away.
  [[nodiscard]] std::int64_t wanted() const noexcept { return (faces_ - options_.faces) / 2; }

  // Half of what a cache line holds is gone by now.
  void pack() {
    const PackedIds ids = mesh_.pack();
    const auto move = [](auto& values, const Buffer<Index>& numbers, Index count) {
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] >= 0) values[at(numbers[i])] = values[i];
      }
      values.truncate(at(count));
    };
    move(costs_, ids.halfedges, mesh_.view().halfedge_count());
    for (Buffer<Index>& places : places_) move(places, ids.vertices, mesh_.view().vertex_count());
  }

  // In one way to cut. Returns the edges that are postponed.
  Buffer<Index> run_pass(const Buffer<Index>& edges, const Buffer<Index>& places,
                         std::size_t highest) {
    // As many as there are left in a part.
    const std::int64_t part_size = std::max<std::int64_t>(options_.part_vertices, 1);
    const auto size = static_cast<Index>(std::min<std::int64_t>(
        vertex_count_, part_size * vertex_count_ / (vertex_count_ - output_.collapses)));
    const Index part_count = (vertex_count_ - 1) / size + 1;
    const Pass pass{mesh_,
                    costs_.span(),
                    following_.span(),
                    places.span(),
                    highest,
                    size,
                    static_cast<std::int64_t>(edges.size()),
                    wanted()};
    PartLists lists = list_by_part(edges, pass, part_count, execution_);
    std::vector<Index> postponed(at(part_count));
    const Counts counts = par::reduce_tasks<Counts>(
        execution_, part_count,
        [&](Index part, Index slot) {
          const Counts own = Part(pass, part, queues_[at(slot)]).run(lists.of(part));
          postponed[at(part)] = static_cast<Index>(own.postponed);
          return own;
        },
        [](const Counts& a, const Counts& b) { return join(a, b); });
    faces_ -= counts.faces;
    output_.collapses += counts.collapses;
    output_.accepted += counts.collapses;
    output_.candidates += counts.candidates;
    output_.largest_cost = std::max(output_.largest_cost, static_cast<double>(counts.largest_cost));
    Buffer<Index> rest(at(static_cast<Index>(counts.postponed)));
    std::size_t rest_count = 0;
    for (Index part = 0; part < part_count; ++part) {
      // Some went with a collapse beside them, later on.
      for (const Index h : lists.of(part).first(at(postponed[at(part)]))) {
        if (mesh_.mesh().has(HalfedgeId(h))) rest[rest_count++] = h;
      }
    }
    rest.truncate(rest_count);
    return rest;
  }

  ShrinkingMesh& mesh_;
  Buffer<float>& costs_;
  const DecimateOptions& options_;
  const Execution& execution_;
  DecimateOutput& output_;
  Index vertex_count_;
  std::int64_t faces_;
  Buffer<Index> following_;
  Buffer<Index> places_[2];
  std::vector<BucketLists> queues_;
};

}  // namespace

std::int64_t collapse_in_rounds(ShrinkingMesh& mesh, Buffer<float>& costs,
                                const Positions& positions, const DecimateOptions& options,
                                const Execution& execution, DecimateOutput& output) {
  if (mesh.view().face_count() <= options.faces) return mesh.view().face_count();
  return Rounds(mesh, costs, positions, options, execution, output).run();
}

}  // namespace hedgerow::decimation
