// hedgerow/query.h: questions about the whole mesh.
#include <memory>

#include "hedgerow/query.h"
#include "peers/measured_mesh.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

Work prepare_loops(const Dataset& data, const Execution&) {
  auto loops = std::make_shared<BoundaryLoops>();
  Work work;
  work.run = [&data, loops] { *loops = boundary_loops(data.mesh); };
  work.run();
  if (loops->count() != data.reference.boundary_loops) {
    work.error = "another number of boundary loops than the reference; not measured";
  }
  return work;
}

Work prepare_components(const Dataset& data, const Execution& execution) {
  auto components = std::make_shared<Components>();
  Work work;
  work.run = [&data, components, execution] {
    *components = connected_components(data.mesh, execution);
  };
  work.run();
  if (components->count != data.reference.components) {
    work.error = "another number of components than the reference; not measured";
  }
  return work;
}

Work prepare_peer_components(const Dataset& data, const Peer& peer) {
  const auto mesh = built_mesh(peer, data.faces(), data.positions());
  auto count = std::make_shared<Index>();
  Work work;
  work.run = [mesh, count] { *count = mesh->component_count(); };
  work.run();
  if (*count != data.reference.components) {
    work.error = "another number of components than the reference; not measured";
  }
  return work;
}

/// Reads opposite.
double loops_bytes(const Dataset& data) { return kIndexBytes * counts_of(data).halfedges; }
/// Reads origin; writes a label for each vertex.
double components_bytes(const Dataset& data) {
  const Counts counts = counts_of(data);
  return kIndexBytes * (counts.halfedges + counts.vertices);
}

}  // namespace

void add_query(const Plan& plan) {
  for (const DatasetKey& key : plan.large) {
    add(plan, {"boundary_loops", key, 1, "", prepare_loops, loops_bytes});
    for (const int threads : plan.threads) {
      add(plan, {"components", key, threads, "", prepare_components, components_bytes});
    }
    for (const Peer& peer : peers()) {
      if (!peer.is_baseline) continue;
      add(plan, {"components", key, 1, peer.name,
                 [&peer](const Dataset& data, const Execution&) {
                   return prepare_peer_components(data, peer);
                 },
                 components_bytes});
    }
  }
}

}  // namespace hedgerow::bench
