// fronts: E. Cuthill, J. McKee, "Reducing the bandwidth of sparse symmetric matrices", 1969, on
// vertices that already lie along a curve, so that the search stays in the caches.

#include <algorithm>
#include <utility>
#include <vector>

#include "hedgerow/circulate.h"
#include "kernels/gather_reordered.h"
#include "parallel/parallel.h"
#include "reorder/orders.h"

namespace hedgerow::detail {

namespace {

constexpr Index kFrontGrain = 1 << 14;  // faces a task

// Vertices in the order in which a search over edges reaches them; the order so far is its queue.
template <Topology Mesh>
class FrontSearch {
 public:
  explicit FrontSearch(const Mesh& mesh)
      : mesh_(mesh),
        new_to_old_(static_cast<std::size_t>(mesh.vertex_count())),
        old_to_new_(new_to_old_.size(), kInvalidIndex) {}

  VertexNumbers run() {
    const Index vertex_count = mesh_.vertex_count();
    for (Index seed = 0; seed < vertex_count && count_ < vertex_count; ++seed) {
      if (mesh_.outgoing[VertexId(seed)].valid()) search_from(seed);
    }
    for (Index v = 0; count_ < vertex_count; ++v) add(v);
    return {std::move(new_to_old_), std::move(old_to_new_)};
  }

 private:
  void search_from(Index seed) {
    Index done = count_;
    add(seed);
    for (; done < count_; ++done) {
      const VertexId v(new_to_old_[static_cast<std::size_t>(done)]);
      for (const VertexId u : neighbours(mesh_, v)) {
        if (count_ == mesh_.vertex_count()) return;
        add(u.value);
      }
    }
  }

  // Whether a neighbour is new cannot be predicted, so it decides what is kept, not what is done.
  // \pre there is a vertex that is not numbered
  void add(Index v) {
    Index& number = old_to_new_[static_cast<std::size_t>(v)];
    const bool is_new = number == kInvalidIndex;
    new_to_old_[static_cast<std::size_t>(count_)] = v;
    number = is_new ? count_ : number;
    count_ += static_cast<Index>(is_new);
  }

  const Mesh& mesh_;
  Buffer<Index> new_to_old_;
  Buffer<Index> old_to_new_;
  Index count_ = 0;
};

}  // namespace

VertexNumbers front_vertices(const Connectivity& mesh) {
  return mesh.visit([](const auto& view) { return FrontSearch(view).run(); });
}

Buffer<Index> faces_by_two_vertices(const Connectivity& mesh,
                                    const Buffer<Index>& vertices_old_to_new,
                                    const Execution& execution) {
  Buffer<Index> order = faces_by_smallest_vertex(mesh, vertices_old_to_new, execution);
  mesh.visit([&](const auto& view) {
    kernels::FaceRuns runs(view, vertices_old_to_new.data(), order.data());
    // Cut between runs before any of them is moved; a run over several blocks is passed once.
    const Index face_count = view.face_count();
    std::vector<Index> bounds(1, 0);
    for (Index end = kFrontGrain; end < face_count; end += kFrontGrain) {
      bounds.push_back(runs.end_of_run(std::max(end, bounds.back()), face_count));
    }
    bounds.push_back(face_count);
    par::for_each_task(execution, static_cast<Index>(bounds.size()) - 1, [&](Index block, Index) {
      const auto b = static_cast<std::size_t>(block);
      runs.sort({bounds[b], bounds[b + 1]});
    });
  });
  return order;
}

}  // namespace hedgerow::detail
