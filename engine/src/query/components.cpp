// Each thread joins a run of faces in trees of its own, over all vertices; then the trees are
// joined two by two. A root is the smallest vertex of its set whatever the order of the joins, so
// neither the number of runs nor the schedule shows in the labels.

#include <utility>
#include <vector>

#include "hedgerow/query.h"
#include "kernels/join_sets.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kGrain = 1 << 17;  // faces a run: fewer take no longer than starting a thread

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

// The last of `run_count` runs also has the half-edges without a face, which only the closed form
// has; an edge with such half-edges on both sides lies on no face.
template <Topology Mesh>
void join_run(Index run, Index run_count, const Mesh& mesh, Index* parent) noexcept {
  kernels::fill_singletons({0, mesh.vertex_count()}, parent);
  kernels::join_faces(par::share_of(run, run_count, mesh.face_count()), mesh, parent);
  if (run + 1 < run_count) return;
  const Index side_count = mesh.face_count() == 0 ? 0 : mesh.first(FaceId(mesh.face_count())).value;
  kernels::join_halfedges({side_count, mesh.halfedge_count()}, mesh, parent);
}

template <Topology Mesh>
Buffer<Index> join_all(const Mesh& mesh, const Execution& execution) {
  const Index run_count = par::share_count(execution, mesh.face_count(), kGrain);
  std::vector<Buffer<Index>> trees;
  for (Index i = 0; i < run_count; ++i) trees.emplace_back(at(mesh.vertex_count()));
  par::for_each_task(execution, run_count, [&](Index run, Index) {
    join_run(run, run_count, mesh, trees[at(run)].data());
  });
  for (Index step = 1; step < run_count; step *= 2) {
    const Index pair_count = (run_count - step - 1) / (2 * step) + 1;
    par::for_each_task(execution, pair_count, [&](Index pair, Index) {
      const Index to = pair * 2 * step;
      kernels::join_trees({0, mesh.vertex_count()}, trees[at(to + step)].data(),
                          trees[at(to)].data());
    });
  }
  return std::move(trees[0]);
}

}  // namespace

Components connected_components(const Connectivity& mesh, const Execution& execution) {
  return mesh.visit([&](const auto& view) {
    Components components{join_all(view, execution), 0};
    components.count = kernels::label_roots(view, components.label.data());
    return components;
  });
}

}  // namespace hedgerow
