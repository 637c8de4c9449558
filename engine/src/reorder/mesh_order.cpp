// vertex_cache: P. Sander, D. Nehab, J. Barczak, "Fast triangle reordering for vertex locality and
// reduced overdraw", 2007 (Tipsify): all remaining faces round one vertex are taken, then those
// round the neighbour that will still be in the cache once its own faces have been taken.

#include <algorithm>
#include <vector>

#include "hedgerow/circulate.h"
#include "kernels/gather_reordered.h"
#include "parallel/parallel.h"
#include "reorder/orders.h"
#include "reorder/stable_sort.h"

namespace hedgerow::detail {

namespace {

constexpr Index kFaceOrderGrain = 1 << 14;  // faces a task
constexpr std::int64_t kCacheSize = 16;     // vertices; smaller than any cache that is in use

// Vertices in the order in which they are first added; the rest, in old order, at the end.
class VertexOrder {
 public:
  explicit VertexOrder(Index count)
      : new_to_old_(static_cast<std::size_t>(count)), is_added_(new_to_old_.size(), 0) {}

  void add(VertexId v) {
    std::uint8_t& is_added = is_added_[static_cast<std::size_t>(v.value)];
    if (is_added != 0) return;
    is_added = 1;
    new_to_old_[static_cast<std::size_t>(count_++)] = v.value;
  }
  [[nodiscard]] Index count() const { return count_; }
  [[nodiscard]] VertexId operator[](Index i) const {
    return VertexId(new_to_old_[static_cast<std::size_t>(i)]);
  }
  [[nodiscard]] Buffer<Index> take_with_rest() {
    for (Index v = 0; count_ < static_cast<Index>(new_to_old_.size()); ++v) add(VertexId(v));
    return std::move(new_to_old_);
  }

 private:
  Buffer<Index> new_to_old_;
  Buffer<std::uint8_t> is_added_;
  Index count_ = 0;
};

template <Topology Mesh>
class VertexCacheOrder {
 public:
  explicit VertexCacheOrder(const Mesh& mesh)
      : mesh_(mesh),
        order_(static_cast<std::size_t>(mesh.face_count())),
        is_taken_(static_cast<std::size_t>(mesh.face_count()), 0),
        remaining_(static_cast<std::size_t>(mesh.vertex_count()), 0),
        entered_(static_cast<std::size_t>(mesh.vertex_count()), 0),
        clock_(kCacheSize + 1) {
    for (Index h = 0; h < mesh.halfedge_count(); ++h) ++remaining_of(mesh.origin[HalfedgeId(h)]);
    recent_.reserve(static_cast<std::size_t>(mesh.halfedge_count()));
  }

  Buffer<Index> run() {
    for (VertexId v = next_in_order(); v.valid(); v = next_vertex()) take_faces_at(v);
    return std::move(order_);
  }

 private:
  Index& remaining_of(VertexId v) { return remaining_[static_cast<std::size_t>(v.value)]; }
  std::int64_t& entered(VertexId v) { return entered_[static_cast<std::size_t>(v.value)]; }

  void take_faces_at(VertexId center) {
    candidates_.clear();
    for (const FaceId f : incident_faces(mesh_, center)) {
      std::uint8_t& is_taken = is_taken_[static_cast<std::size_t>(f.value)];
      if (is_taken != 0) continue;
      is_taken = 1;
      order_[static_cast<std::size_t>(taken_count_++)] = f.value;
      for (const VertexId v : vertices(mesh_, f)) {
        recent_.push_back(v);
        candidates_.push_back(v);
        --remaining_of(v);
        if (clock_ - entered(v) > kCacheSize) entered(v) = clock_++;
      }
    }
  }

  // Of the vertices just used the oldest one that stays in the cache while its faces are taken.
  VertexId next_vertex() {
    VertexId best;
    std::int64_t best_age = -1;
    for (const VertexId v : candidates_) {
      const std::int64_t remaining = remaining_of(v);
      if (remaining == 0) continue;
      const std::int64_t age = clock_ - entered(v);
      const std::int64_t value = age + 2 * remaining <= kCacheSize ? age : 0;
      if (value <= best_age) continue;
      best_age = value;
      best = v;
    }
    return best.valid() ? best : next_after_dead_end();
  }

  VertexId next_after_dead_end() {
    while (!recent_.empty()) {
      const VertexId v = recent_.back();
      recent_.pop_back();
      if (remaining_of(v) > 0) return v;
    }
    return next_in_order();
  }

  VertexId next_in_order() {
    for (; cursor_ < mesh_.vertex_count(); ++cursor_) {
      if (remaining_of(VertexId(cursor_)) > 0) return VertexId(cursor_);
    }
    return {};
  }

  const Mesh& mesh_;
  Buffer<Index> order_;
  Buffer<std::uint8_t> is_taken_;
  Buffer<Index> remaining_;       // faces at a vertex that are not taken yet
  Buffer<std::int64_t> entered_;  // when a vertex last entered the cache
  std::vector<VertexId> recent_;  // used vertices, the last one on top
  std::vector<VertexId> candidates_;
  std::int64_t clock_;
  Index taken_count_ = 0;
  Index cursor_ = 0;
};

}  // namespace

Buffer<Index> breadth_first_vertices(const Connectivity& mesh) {
  return mesh.visit([](const auto& view) {
    VertexOrder order(view.vertex_count());
    Index done = 0;
    for (Index seed = 0; seed < view.vertex_count(); ++seed) {
      if (!view.outgoing[VertexId(seed)].valid()) continue;
      order.add(VertexId(seed));
      // The order so far is the queue.
      for (; done < order.count(); ++done) {
        for (const VertexId v : neighbours(view, order[done])) order.add(v);
      }
    }
    return order.take_with_rest();
  });
}

Buffer<Index> vertex_cache_faces(const Connectivity& mesh) {
  return mesh.visit([](const auto& view) { return VertexCacheOrder(view).run(); });
}

Buffer<Index> vertices_by_first_use(const Connectivity& mesh,
                                    const Buffer<Index>& faces_new_to_old) {
  return mesh.visit([&](const auto& view) {
    VertexOrder order(view.vertex_count());
    for (const Index f : faces_new_to_old) {
      for (const VertexId v : vertices(view, FaceId(f))) order.add(v);
    }
    return order.take_with_rest();
  });
}

Buffer<Index> faces_by_smallest_vertex(const Connectivity& mesh,
                                       const Buffer<Index>& vertices_old_to_new,
                                       const Execution& execution) {
  return mesh.visit([&](const auto& view) {
    Buffer<kernels::IndexedItem> items(static_cast<std::size_t>(view.face_count()));
    par::for_each_range(execution, view.face_count(), kFaceOrderGrain, [&](IndexRange range) {
      kernels::gather_smallest_vertex(range, view, vertices_old_to_new.data(), items.data());
    });
    return sorted_items(std::move(items), execution);
  });
}

}  // namespace hedgerow::detail
