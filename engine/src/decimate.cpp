#include "hedgerow/decimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "at.h"
#include "decimate/cost_buckets.h"
#include "decimate/rounds.h"
#include "decimate/shrinking_mesh.h"
#include "float3_check.h"
#include "hedgerow/circulate.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

using decimation::CostBuckets;
using decimation::Evaluation;
using decimation::ShrinkingMesh;

constexpr Index kCostGrain = 1 << 12;
constexpr float kNoCost = std::numeric_limits<float>::infinity();
constexpr std::size_t kFetchHalfedges = 16;  // places ahead
constexpr std::size_t kFetchVertices = 8;

/// What each edge costs, by the one of its half-edges that is queued; of others no cost.
Buffer<float> all_costs(const ShrinkingMesh& mesh, const Execution& execution) {
  const EditView& view = mesh.view();
  Buffer<float> costs(at(view.halfedge_count()));
  par::for_each_range(execution, view.halfedge_count(), kCostGrain, [&](IndexRange range) {
    for (Index h = range.begin; h < range.end; ++h) {
      const bool is_first = HalfedgeId(h) < view.opposite[HalfedgeId(h)];
      const float cost = is_first ? mesh.evaluate(HalfedgeId(h)).cost : kNoCost;
      costs[at(h)] = std::isfinite(cost) ? cost : kNoCost;
    }
  });
  return costs;
}

/// One queue of all edges.
class Queue {
 public:
  Queue(ShrinkingMesh& mesh, Buffer<float>& costs)
      : mesh_(mesh), view_(mesh.view()), costs_(costs) {
    for (Index h = 0; h < view_.halfedge_count(); ++h) {
      if (std::isfinite(costs_[at(h)])) queue_.push(costs_[at(h)], h);
    }
  }

  DecimateEnd shrink(std::int64_t faces, const DecimateOptions& options, DecimateOutput& output) {
    while (faces > options.faces) {
      const HalfedgeId h(queue_.pop());
      if (!h.valid()) return DecimateEnd::refused;
      fetch_ahead();
      if (!mesh_.mesh().has(h)) continue;
      costs_[at(h.value)] = kNoCost;
      const Evaluation evaluation = mesh_.evaluate(h);
      if (!std::isfinite(evaluation.cost)) continue;
      if (CostBuckets::bucket_of(evaluation.cost) > queue_.current()) {
        enter(h, evaluation.cost);
        continue;
      }
      const auto cost = static_cast<double>(evaluation.cost);
      if (cost > options.max_cost) return DecimateEnd::max_cost;
      const VertexId kept = view_.target(h);
      const int gone = mesh_.collapse(h, evaluation);
      if (gone < 0) continue;
      enter_ring(kept);
      faces -= gone;
      ++output.collapses;
      output.largest_cost = std::max(output.largest_cost, cost);
    }
    return DecimateEnd::faces;
  }

 private:
  void enter(HalfedgeId h, float cost) {
    if (!std::isfinite(cost)) return;
    queue_.push(cost, h.value);
    costs_[at(h.value)] = cost;
  }
  // Costs are evaluated at places far apart: most of the time would be spent waiting for them.
  void fetch_ahead() const noexcept {
    if (const Index far = queue_.ahead(kFetchHalfedges); far != kInvalidIndex) {
      __builtin_prefetch(view_.origin.data() + far);
      __builtin_prefetch(view_.opposite.data() + far);
      __builtin_prefetch(view_.next_of.data() + far);
    }
    if (const HalfedgeId near(queue_.ahead(kFetchVertices)); mesh_.mesh().has(near)) {
      for (const VertexId v : {view_.origin[near], view_.target(near)}) {
        __builtin_prefetch(&mesh_.of(v));
        __builtin_prefetch(&mesh_.of(v).position);
      }
    }
  }
  // What is not queued beside a vertex that moved: edges that were refused, and may be possible
  // now; and those that two edges of a triangle became, neither of them by its queued half-edge.
  void enter_ring(VertexId v) {
    for (const HalfedgeId h : outgoing_halfedges(view_, v)) {
      if (std::isfinite(costs_[at(h.value)]) ||
          std::isfinite(costs_[at(view_.opposite[h].value)])) {
        continue;
      }
      enter(h, mesh_.evaluate(h).cost);
    }
  }

  ShrinkingMesh& mesh_;
  const EditView& view_;
  Buffer<float>& costs_;  // finite: the queue has the edge under this name
  CostBuckets queue_;
};

}  // namespace

Result<DecimateOutput> decimate(const Connectivity& mesh, const Positions& positions,
                                const DecimateOptions& options, const Execution& execution) {
  if (const auto ok = detail::check_float3(positions, mesh.vertex_count()); !ok) {
    return fail(ok.error());
  }
  Result<EditMesh> edited = EditMesh::of(mesh, execution);
  if (!edited) return fail(edited.error());
  edited->set_recording(false);
  ShrinkingMesh shrinking(std::move(*edited), positions, options.boundary_weight, execution);
  Buffer<float> costs = all_costs(shrinking, execution);
  DecimateOutput counts;
  std::int64_t faces = shrinking.view().face_count();
  if (options.order == DecimateOrder::rounds) {
    faces = decimation::collapse_in_rounds(shrinking, costs, positions, options, execution, counts);
  }
  counts.end = Queue(shrinking, costs).shrink(faces, options, counts);
  return shrinking.finish(std::move(counts));
}

}  // namespace hedgerow
