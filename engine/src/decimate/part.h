#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "decimate/bucket_lists.h"
#include "decimate/shrinking_mesh.h"
#include "hedgerow/circulate.h"

namespace hedgerow::decimation {

/// What was done.
struct Counts {
  std::int64_t collapses = 0;
  std::int64_t faces = 0;  // that went
  std::int64_t candidates = 0;
  std::int64_t postponed = 0;
  float largest_cost = 0;

  friend Counts join(const Counts& a, const Counts& b) noexcept {
    return {a.collapses + b.collapses, a.faces + b.faces, a.candidates + b.candidates,
            a.postponed + b.postponed, std::max(a.largest_cost, b.largest_cost)};
  }
};

/// What all parts of a pass have in common.
struct Pass {
  ShrinkingMesh& mesh;
  std::span<float> costs;
  std::span<Index> following;
  std::span<const Index> places;
  std::size_t highest;  // the last bucket that is emptied
  Index part_size;
  std::int64_t edges;   // up to that bucket
  std::int64_t wanted;  // collapses at the most
};

/// The work on one part, alone.
class Part {
 public:
  Part(const Pass& pass, Index number, BucketLists& queue) noexcept
      : pass_(pass), view_(pass.mesh.view()), number_(number), queue_(queue) {}

  /// Leaves in front of `edges` those that are postponed.
  Counts run(std::span<Index> edges) noexcept {
    queue_.begin();
    postponed_ = edges;
    for (const Index h : edges) enter(HalfedgeId(h));
    // Where there are too many that cost about the same, each part gets its share.
    const auto own = static_cast<std::int64_t>(edges.size());
    left_ = pass_.edges > pass_.wanted ? own * pass_.wanted / pass_.edges : own;
    while (left_ > 0) {
      const HalfedgeId h(queue_.pop(pass_.highest, pass_.following));
      if (!h.valid()) return counts_;
      if (pass_.mesh.mesh().has(h)) look_at(h);
    }
    queue_.clear(pass_.highest);
    return counts_;
  }

 private:
  [[nodiscard]] float& cost(HalfedgeId h) const noexcept {
    return pass_.costs[static_cast<std::size_t>(h.value)];
  }
  [[nodiscard]] bool is_in(VertexId v) const noexcept {
    return pass_.places[static_cast<std::size_t>(v.value)] / pass_.part_size == number_;
  }
  // Whether all that a collapse reads is in this part.
  [[nodiscard]] bool has_ring(VertexId v) const noexcept {
    for (const HalfedgeId h : outgoing_halfedges(view_, v)) {
      if (!is_in(view_.target(h))) return false;
      if (!view_.face(h).valid()) continue;
      // The last corner of a triangle is a neighbour.
      HalfedgeId g = view_.next(view_.next(h));
      for (g = view_.next(g); g != h; g = view_.next(g)) {
        if (!is_in(view_.origin[g])) return false;
      }
    }
    return true;
  }

  void enter(HalfedgeId h) noexcept {
    if (is_in(view_.target(h))) {
      push(h);
    } else {
      postpone(h);
    }
  }
  void postpone(HalfedgeId h) noexcept {
    // An edge that was refused may be one more than there were: it stays for the next round.
    if (at_postponed_ == postponed_.size()) return;
    postponed_[at_postponed_++] = h.value;
    ++counts_.postponed;
  }
  void push(HalfedgeId h) noexcept {
    const std::size_t bucket = CostBuckets::bucket_of(cost(h));
    if (bucket <= pass_.highest) queue_.push(bucket, h.value, pass_.following);
  }

  void look_at(HalfedgeId h) noexcept {
    const Evaluation evaluation = pass_.mesh.evaluate(h);
    cost(h) = evaluation.cost;
    if (!std::isfinite(evaluation.cost)) return;
    if (CostBuckets::bucket_of(evaluation.cost) > queue_.current()) {
      push(h);
      return;
    }
    const VertexId kept = view_.target(h);
    if (!has_ring(view_.origin[h]) || !has_ring(kept)) {
      postpone(h);
      return;
    }
    ++counts_.candidates;
    cost(h) = std::numeric_limits<float>::infinity();
    const HalfedgeId o = view_.opposite[h];
    const std::array sides = {view_.next(h), view_.prev(h), view_.next(o), view_.prev(o), o};
    const int gone = pass_.mesh.collapse(h, evaluation);
    if (gone < 0) return;
    for (const HalfedgeId side : sides) {
      if (!pass_.mesh.mesh().has(side)) cost(side) = std::numeric_limits<float>::infinity();
    }
    --left_;
    ++counts_.collapses;
    counts_.faces += gone;
    counts_.largest_cost = std::max(counts_.largest_cost, evaluation.cost);
    enter_ring(kept);
  }

  // Edges without a place in a queue that may be possible now, as in the queue of all edges.
  void enter_ring(VertexId v) noexcept {
    for (const HalfedgeId h : outgoing_halfedges(view_, v)) {
      if (std::isfinite(cost(h)) || std::isfinite(cost(view_.opposite[h]))) continue;
      cost(h) = pass_.mesh.evaluate(h).cost;
      if (std::isfinite(cost(h))) push(h);
    }
  }

  const Pass& pass_;
  const EditView& view_;
  Index number_;
  BucketLists& queue_;
  std::int64_t left_ = 0;
  std::span<Index> postponed_;
  std::size_t at_postponed_ = 0;
  Counts counts_;
};

}  // namespace hedgerow::decimation
