// Each thread joins the faces of its share of the half-edges in trees of its own; then the trees
// are joined into the first. A root is the smallest face of its set whatever the order.

#include <vector>

#include "hedgerow/radial.h"
#include "kernels/join_sets.h"
#include "kernels/patch_labels.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

// Half-edges a share: fewer are not worth trees of their own.
constexpr Index kPatchGrain = 1 << 19;

template <Topology Mesh>
Patches find_patches(const Mesh& mesh, const RadialCycles& cycles, const Execution& execution) {
  const IndexRange faces{0, mesh.face_count()};
  const Index share_count = par::share_count(execution, mesh.halfedge_count(), kPatchGrain);
  std::vector<Buffer<Index>> trees;
  for (Index i = 0; i < share_count; ++i) trees.emplace_back(static_cast<std::size_t>(faces.end));
  par::for_each_task(execution, share_count, [&](Index share, Index) {
    Index* parent = trees[static_cast<std::size_t>(share)].data();
    kernels::fill_singletons(faces, parent);
    kernels::join_across_pairs(par::share_of(share, share_count, mesh.halfedge_count()), mesh,
                               cycles.column(), parent);
  });
  for (std::size_t i = 1; i < trees.size(); ++i) {
    if (kernels::hang_roots(faces, trees[i].data(), trees[0].data())) {
      kernels::join_trees(faces, trees[i].data(), trees[0].data());
    }
  }
  Patches patches{std::move(trees[0]), 0};
  patches.count = kernels::flatten_trees(faces, patches.label.data());
  return patches;
}

}  // namespace

Patches manifold_patches(const Connectivity& mesh, const RadialCycles& cycles,
                         const Execution& execution) {
  return mesh.visit([&](const auto& view) { return find_patches(view, cycles, execution); });
}

}  // namespace hedgerow
