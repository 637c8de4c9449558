// `opposite` is the answer for every edge with two faces; only the half-edges that it leaves alone
// are sorted by the ends of their edges. So a mesh without a boundary costs a copy.

#include "hedgerow/radial.h"

#include <algorithm>
#include <utility>

#include "at.h"
#include "float3_check.h"
#include "kernels/radial_cycles.h"
#include "parallel/parallel.h"
#include "reorder/stable_sort.h"

namespace hedgerow {

namespace {

constexpr Index kRadialGrain = 1 << 15;  // half-edges a block: 256 kB of two columns
constexpr Index kLooseGrain = 1 << 12;   // loose half-edges a block: a vertex is met at random

// Blocks of [0, count), each of which puts an unknown number of results to consecutive places. The
// blocks do not depend on the execution.
class Blocks {
 public:
  Blocks(Index count, Index grain, const Execution& execution)
      : execution_(execution),
        count_(count),
        grain_(grain),
        block_count_(count == 0 ? 0 : (count - 1) / grain + 1),
        places_(at(block_count_)) {}

  // kernel(range) counts the results of a block; returns their sum.
  template <class Kernel>
  Index count(const Kernel& kernel) {
    par::for_each_task(execution_, block_count_,
                       [&](Index b, Index) { places_[at(b)] = kernel(range_of(b)); });
    Index total = 0;
    for (Index& place : places_) total += std::exchange(place, total);
    total_ = total;
    return total;
  }
  // kernel(range, places of its results) for each block that has some.
  template <class Kernel>
  void fill(const Kernel& kernel) {
    par::for_each_task(execution_, block_count_, [&](Index b, Index) {
      const Index end = b + 1 < block_count_ ? places_[at(b + 1)] : total_;
      if (end > places_[at(b)]) kernel(range_of(b), IndexRange{places_[at(b)], end});
    });
  }

 private:
  [[nodiscard]] IndexRange range_of(Index b) const noexcept {
    return {b * grain_, b * grain_ + std::min(grain_, count_ - b * grain_)};
  }

  const Execution& execution_;
  Index count_;
  Index grain_;
  Index block_count_;
  Buffer<Index> places_;
  Index total_ = 0;
};

template <Topology Mesh>
class RadialBuild {
 public:
  RadialBuild(const Mesh& mesh, Form form, const Execution& execution)
      : mesh_(mesh), form_(form), execution_(execution), radial_(at(mesh.halfedge_count())) {}

  RadialCycles run(const Positions* positions) {
    Buffer<Index> loose = take_pairs();
    if (!loose.empty()) {
      sort_by_ends(loose);
      if (add_pairs_on_loose(loose)) {
        std::sort(loose.begin(), loose.end());
        sort_by_ends(loose);
      }
      link(loose, positions);
    }
    return RadialCycles(std::move(radial_));
  }

 private:
  // Fills the cycles of pairs, and returns the half-edges that are in none.
  Buffer<Index> take_pairs() {
    Blocks blocks(mesh_.halfedge_count(), kRadialGrain, execution_);
    Index* radial = radial_.data();
    const Index loose_count = blocks.count([&](IndexRange range) {
      if (form_ == Form::closed) return kernels::gather_closed_pairs(range, mesh_, radial);
      return kernels::gather_pairs(range, mesh_.opposite.data(), radial);
    });
    Buffer<Index> loose(at(loose_count));
    blocks.fill([&](IndexRange range, IndexRange places) {
      kernels::collect_loose(range, radial, loose.data() + places.begin);
    });
    return loose;
  }

  // Stable, so twice: by the larger vertex, then by the smaller.
  void sort_by_ends(Buffer<Index>& halfedges) const {
    for (const bool is_larger : {true, false}) {
      Buffer<kernels::KeyedItem> items(halfedges.size());
      par::for_each_range(
          execution_, static_cast<Index>(halfedges.size()), kLooseGrain, [&](IndexRange range) {
            kernels::fill_end_keys(range, mesh_, halfedges.data(), is_larger, items.data());
          });
      halfedges = detail::sorted_items(std::move(items), execution_);
    }
  }

  [[nodiscard]] kernels::SortedSides<Mesh> sorted(const Buffer<Index>& halfedges) const noexcept {
    return {mesh_, halfedges.data(), static_cast<Index>(halfedges.size())};
  }

  // Appends them in no order of use; false if there are none.
  bool add_pairs_on_loose(Buffer<Index>& loose) const {
    const kernels::SortedSides<Mesh> sides = sorted(loose);
    const auto outgoing = [&](VertexId v) { return outgoing_halfedges(mesh_, v); };
    Blocks blocks(sides.count, kLooseGrain, execution_);
    const Index found = blocks.count([&](IndexRange range) {
      return kernels::find_pairs_on_loose(range, sides, outgoing, nullptr);
    });
    if (found == 0) return false;
    Buffer<Index> all(loose.size() + at(found));
    std::copy(loose.begin(), loose.end(), all.begin());
    Index* out = all.data() + loose.size();
    blocks.fill([&](IndexRange range, IndexRange places) {
      (void)kernels::find_pairs_on_loose(range, sides, outgoing, out + places.begin);
    });
    loose = std::move(all);
    return true;
  }

  void link(const Buffer<Index>& halfedges, const Positions* positions) {
    const kernels::SortedSides<Mesh> sides = sorted(halfedges);
    Blocks blocks(sides.count, kLooseGrain, execution_);
    const Index crowded = blocks.count(
        [&](IndexRange range) { return kernels::link_runs(range, sides, radial_.data()); });
    if (positions == nullptr || crowded == 0) return;
    Buffer<kernels::RadialSide> by_angle(at(crowded));
    blocks.fill([&](IndexRange range, IndexRange places) {
      kernels::gather_crowded(range, sides, *positions, by_angle.data() + places.begin);
      kernels::link_by_angle(places, mesh_, *positions, by_angle.data(), radial_.data());
    });
  }

  const Mesh& mesh_;
  Form form_;
  const Execution& execution_;
  Buffer<Index> radial_;
};

RadialCycles build_cycles(const Connectivity& mesh, const Positions* positions,
                          const Execution& execution) {
  return mesh.visit(
      [&](const auto& view) { return RadialBuild(view, mesh.form(), execution).run(positions); });
}

}  // namespace

RadialCycles build_radial(const Connectivity& mesh, const Execution& execution) {
  return build_cycles(mesh, nullptr, execution);
}

Result<RadialCycles> build_radial(const Connectivity& mesh, Positions positions,
                                  const Execution& execution) {
  if (auto ok = detail::check_float3(positions, mesh.vertex_count()); !ok) return fail(ok.error());
  return build_cycles(mesh, &positions, execution);
}

}  // namespace hedgerow
