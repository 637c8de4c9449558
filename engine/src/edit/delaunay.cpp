#include "hedgerow/delaunay.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "float3_check.h"
#include "kernels/flip_tests.h"
#include "parallel/parallel.h"

namespace hedgerow {
namespace {

using kernels::EdgeState;

constexpr Index kDelaunayGrain = 1 << 13;  // edges a task

/// Whether a mesh records, until the end of the scope.
class Recording {
 public:
  Recording(EditMesh& mesh, bool is_recording) : mesh_(mesh), was_recording_(mesh.is_recording()) {
    mesh.set_recording(is_recording);
  }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  ~Recording() { mesh_.set_recording(was_recording_); }

 private:
  EditMesh& mesh_;
  bool was_recording_;
};

class DelaunayFlips {
 public:
  DelaunayFlips(EditMesh& mesh, const Positions& positions, const DelaunayOptions& options,
                const Execution& execution)
      : mesh_(mesh), positions_(positions), options_(options), execution_(execution) {}

  DelaunayReport run() {
    is_waiting_.resize(static_cast<std::size_t>(mesh_.halfedge_count()));
    waiting_.reserve(is_waiting_.size() / 2);
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) push(HalfedgeId(h));
    const auto edges = static_cast<std::int64_t>(waiting_.size());
    flips_left_ = options_.max_flips >= 0 ? options_.max_flips : 100 * edges + 1000;
    if (options_.order == DelaunayOrder::queue) {
      run_queue();
    } else {
      while (run_round()) ++report_.rounds;
    }
    count_left();
    return report_;
  }

 private:
  // An edge has the number of its first half-edge.
  [[nodiscard]] HalfedgeId edge_of(HalfedgeId h) const noexcept {
    return std::min(h, mesh_.view().opposite[h]);
  }
  [[nodiscard]] bool is_between_triangles(HalfedgeId h) const noexcept {
    const EditView mesh = mesh_.view();
    const HalfedgeId o = mesh.opposite[h];
    return mesh.face(h).valid() && mesh.face(o).valid() &&
           mesh.next(mesh.next(h)) == mesh.prev(h) && mesh.next(mesh.next(o)) == mesh.prev(o);
  }
  void push(HalfedgeId h) {
    if (!mesh_.has(h) || edge_of(h) != h || !is_between_triangles(h)) return;
    std::vector<bool>::reference is_waiting = is_waiting_[static_cast<std::size_t>(h.value)];
    if (is_waiting) return;
    is_waiting = true;
    waiting_.push_back(h);
  }
  // The other edges of both triangles.
  void push_round(HalfedgeId h) {
    const EditView mesh = mesh_.view();
    for (const HalfedgeId side : {h, mesh.opposite[h]}) {
      push(edge_of(mesh.next(side)));
      push(edge_of(mesh.prev(side)));
    }
  }

  [[nodiscard]] EdgeState state_of(HalfedgeId h) const noexcept {
    const EditView mesh = mesh_.view();
    const HalfedgeId o = mesh.opposite[h];
    const auto at = [&](HalfedgeId corner) { return positions_[mesh.origin[corner].value]; };
    const auto test = options_.test == DelaunayTest::in_circle ? &kernels::test_in_circle
                                                               : &kernels::test_angle_sum;
    return test(at(h), at(o), at(mesh.prev(o)), at(mesh.prev(h)));
  }

  void keep_record(const Change& change) {
    if (options_.record != nullptr) options_.record->push_back(change);
  }

  // Whether there may be more to do.
  bool run_round() {
    std::vector<HalfedgeId> edges = std::exchange(waiting_, {});
    for (const HalfedgeId h : edges) is_waiting_[static_cast<std::size_t>(h.value)] = false;
    std::vector<char> fails(edges.size());
    par::for_each_range(execution_, static_cast<Index>(edges.size()), kDelaunayGrain,
                        [&](IndexRange range) {
                          for (Index i = range.begin; i < range.end; ++i) {
                            const auto k = static_cast<std::size_t>(i);
                            fails[k] = state_of(edges[k]) == EdgeState::illegal ? 1 : 0;
                          }
                        });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (fails[i] != 0) edges[kept++] = edges[i];
    }
    edges.resize(kept);
    report_.candidates += static_cast<std::int64_t>(kept);
    if (static_cast<std::int64_t>(kept) > flips_left_) {
      edges.resize(static_cast<std::size_t>(flips_left_));
      report_.is_cut_short = true;
    }
    if (edges.empty()) return false;
    const EditBatch batch = mesh_.flip_batch(edges, execution_);
    report_.postponed += static_cast<std::int64_t>(batch.rest.size());
    count_flips(static_cast<std::int64_t>(batch.done.size()));
    if (batch.done.empty()) return false;
    keep_record(*batch.change);
    for (const HalfedgeId h : batch.done) push_round(h);
    for (const HalfedgeId h : batch.rest) push(h);
    // What stood in their way may be gone.
    for (const HalfedgeId h : batch.refused) push(h);
    return true;
  }

  void count_flips(std::int64_t flips) noexcept {
    report_.flips += flips;
    flips_left_ -= flips;
  }

  void run_queue() {
    std::vector<HalfedgeId> refused;
    std::int64_t flips_before = -1;
    // Refused ones again, as long as there was a flip that may have cleared their way.
    while (!waiting_.empty() && flips_before != report_.flips) {
      flips_before = report_.flips;
      refused.clear();
      for (std::size_t i = 0; i < waiting_.size(); ++i) {
        const HalfedgeId h = waiting_[i];
        is_waiting_[static_cast<std::size_t>(h.value)] = false;
        if (state_of(h) != EdgeState::illegal) continue;
        ++report_.candidates;
        if (flips_left_ == 0) {
          report_.is_cut_short = true;
          return;
        }
        const EditResult done = mesh_.flip(h);
        if (!done) {
          refused.push_back(h);
          continue;
        }
        count_flips(1);
        keep_record(**done);
        push_round(h);
        shorten_queue(i);
      }
      waiting_.clear();
      for (const HalfedgeId h : refused) push(h);
    }
  }

  // Forgets what has been looked at once it is most of the queue.
  void shorten_queue(std::size_t& i) {
    constexpr std::size_t kMany = 1 << 16;
    if (i < kMany || 2 * i < waiting_.size()) return;
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }

  struct Count {
    std::int64_t left = 0;
    std::int64_t undefined = 0;
  };
  void count_left() {
    const Count count = par::reduce<Count>(
        execution_, mesh_.halfedge_count(), kDelaunayGrain,
        [&](IndexRange range) {
          Count part;
          for (HalfedgeId h(range.begin); h.value < range.end; ++h.value) {
            if (!mesh_.has(h) || edge_of(h) != h || !is_between_triangles(h)) continue;
            const EdgeState state = state_of(h);
            part.left += state == EdgeState::illegal ? 1 : 0;
            part.undefined += state == EdgeState::undefined ? 1 : 0;
          }
          return part;
        },
        [](const Count& a, const Count& b) {
          return Count{a.left + b.left, a.undefined + b.undefined};
        });
    report_.left = count.left;
    report_.undefined = count.undefined;
  }

  EditMesh& mesh_;
  const Positions& positions_;
  const DelaunayOptions& options_;
  const Execution& execution_;
  DelaunayReport report_;
  std::int64_t flips_left_ = 0;
  std::vector<HalfedgeId> waiting_;
  std::vector<bool> is_waiting_;  // by edge
};

}  // namespace

Result<DelaunayReport> flip_to_delaunay(EditMesh& mesh, const Positions& positions,
                                        const DelaunayOptions& options,
                                        const Execution& execution) {
  if (const Result<void> checked = detail::check_float3(positions, mesh.vertex_count()); !checked) {
    return fail(checked.error());
  }
  const Recording recording(mesh, options.record != nullptr);
  return DelaunayFlips(mesh, positions, options, execution).run();
}

}  // namespace hedgerow
