// Where every vertex but the first has a smaller neighbour, all are connected, and a pass over the
// vertices that looks at one face of each has shown it: so it is in grids and wherever vertices are
// numbered as a front passes over the surface. The first vertex without one ends that pass.
//
// Otherwise each thread joins a run of faces in trees of its own, over all vertices; then the trees
// are joined two by two. A root is the smallest vertex of its set whatever the order of the joins,
// so neither the number of runs nor the schedule shows in the labels.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "at.h"
#include "hedgerow/assert.h"
#include "hedgerow/query.h"
#include "kernels/join_sets.h"
#include "kernels/smaller_neighbours.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kFacesPerRun = 1 << 17;  // faces a run: fewer take no longer than starting a thread
constexpr Index kChunk = 1 << 14;        // vertices that are joined or labelled at a time

// Whether the vertices are one component, as far as their numbers show it; then it is labelled, and
// `root`, the first vertex that is not isolated, is its smallest.
template <Topology Mesh>
bool label_one_component(const Mesh& mesh, Index root, Index* label, const Execution& execution) {
  std::atomic<bool> is_shown = true;
  par::for_each_range(execution, mesh.vertex_count(), kChunk, [&](IndexRange range) {
    if (!is_shown.load(std::memory_order_relaxed)) return;
    if (kernels::label_with_root(range, root, mesh, label)) return;
    is_shown.store(false, std::memory_order_relaxed);
  });
  return is_shown.load(std::memory_order_relaxed);
}

// The last of `run_count` runs also has the half-edges without a face, which only the closed form
// has; an edge with such half-edges on both sides lies on no face.
template <Topology Mesh>
void join_run(Index run, Index run_count, const Mesh& mesh, bool is_scattered,
              Index* parent) noexcept {
  kernels::fill_singletons({0, mesh.vertex_count()}, parent);
  const IndexRange faces = par::share_of(run, run_count, mesh.face_count());
  if (is_scattered) {
    kernels::join_faces<true>(faces, mesh, parent);
  } else {
    kernels::join_faces<false>(faces, mesh, parent);
  }
  if (run + 1 < run_count) return;
  const Index side_count = mesh.face_count() == 0 ? 0 : mesh.first(FaceId(mesh.face_count())).value;
  kernels::join_halfedges({side_count, mesh.halfedge_count()}, mesh, parent);
}

// One array of parents a run: the labels for the first, scratch for the others.
class Trees {
 public:
  static std::size_t scratch_bytes(Index run_count, Index vertex_count) noexcept {
    return at(run_count - 1) * row_bytes(vertex_count) + flag_count(run_count, vertex_count);
  }

  Trees(Index run_count, std::span<Index> labels, std::byte* scratch) noexcept
      : run_count_(run_count),
        vertex_count_(static_cast<Index>(labels.size())),
        first_(labels.data()),
        scratch_(scratch) {}

  [[nodiscard]] Index* of(Index run) const noexcept {
    if (run == 0) return first_;
    return reinterpret_cast<Index*>(scratch_ + at(run - 1) * row_bytes(vertex_count_));
  }
  // Joins the trees of runs 2i and 2i + 1, then those of these pairs, and so on, into the first.
  // Where runs are local they share few vertices: chunks in which both joined something are rare.
  void join(const Execution& execution) const {
    std::byte* is_left = scratch_ + at(run_count_ - 1) * row_bytes(vertex_count_);
    const Index chunks = chunk_count(vertex_count_);
    const auto vertices = [&](Index chunk) {
      return IndexRange{chunk * kChunk, std::min(vertex_count_, (chunk + 1) * kChunk)};
    };
    for (Index step = 1; step < run_count_; step *= 2) {
      const auto to = [&](Index pair) { return of(pair * 2 * step); };
      const auto from = [&](Index pair) { return of(pair * 2 * step + step); };
      const Index pair_count = (run_count_ - step - 1) / (2 * step) + 1;
      par::for_each_task(execution, pair_count * chunks, [&](Index task, Index) {
        const Index pair = task / chunks;
        is_left[at(task)] =
            std::byte{kernels::hang_roots(vertices(task % chunks), from(pair), to(pair))};
      });
      par::for_each_task(execution, pair_count, [&](Index pair, Index) {
        for (Index chunk = 0; chunk < chunks; ++chunk) {
          if (is_left[at(pair * chunks + chunk)] == std::byte{0}) continue;
          kernels::join_trees(vertices(chunk), from(pair), to(pair));
        }
      });
    }
  }

 private:
  static constexpr std::size_t kCacheLine = 64;

  static Index chunk_count(Index vertex_count) noexcept { return (vertex_count - 1) / kChunk + 1; }
  static std::size_t row_bytes(Index vertex_count) noexcept {
    return (at(vertex_count) * sizeof(Index) + kCacheLine - 1) / kCacheLine * kCacheLine;
  }
  static std::size_t flag_count(Index run_count, Index vertex_count) noexcept {
    return at(run_count / 2) * at(chunk_count(vertex_count));
  }

  Index run_count_;
  Index vertex_count_;
  Index* first_;
  std::byte* scratch_;
};

}  // namespace

Result<Index> connected_components(const Connectivity& mesh, std::span<Index> labels,
                                   const Execution& execution, Workspace& workspace) {
  if (labels.size() != at(mesh.vertex_count())) {
    return fail({ErrorCode::count_mismatch, kInvalidIndex, static_cast<std::int64_t>(labels.size()),
                 mesh.vertex_count()});
  }
  if (labels.empty()) return Index{0};
  const Index run_count = par::share_count(execution, mesh.face_count(), kFacesPerRun);
  const std::size_t bytes = Trees::scratch_bytes(run_count, mesh.vertex_count());
  if (run_count > 1 && !workspace.reserve(bytes)) {
    return fail({ErrorCode::scratch_too_small, kInvalidIndex,
                 static_cast<std::int64_t>(workspace.size_bytes()),
                 static_cast<std::int64_t>(bytes)});
  }
  const Trees trees(run_count, labels, workspace.data());
  return mesh.visit([&](const auto& view) {
    const Index root = kernels::find_used_vertex(view);
    if (label_one_component(view, root, labels.data(), execution)) {
      return static_cast<Index>(root < view.vertex_count());
    }
    const bool is_scattered = kernels::has_scattered_faces(view);
    par::for_each_task(execution, run_count, [&](Index run, Index) {
      join_run(run, run_count, view, is_scattered, trees.of(run));
    });
    trees.join(execution);
    return par::reduce<Index>(
        execution, view.vertex_count(), kChunk,
        [&](IndexRange range) { return kernels::label_roots(range, view, labels.data()); },
        std::plus<>{});
  });
}

Components connected_components(const Connectivity& mesh, const Execution& execution) {
  Components components{Buffer<Index>(at(mesh.vertex_count())), 0};
  Workspace workspace;
  const Result<Index> count =
      connected_components(mesh, components.label.span(), execution, workspace);
  HEDGEROW_ASSERT(count);
  components.count = *count;
  return components;
}

}  // namespace hedgerow
