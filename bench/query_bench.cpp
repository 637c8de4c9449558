// hedgerow/query.h: questions about the whole mesh.
#include <memory>
#include <utility>

#include "hedgerow/query.h"
#include "peers/measured_mesh.h"
#include "runner.h"
#include "stored_form.h"

namespace hedgerow::bench {

namespace {

/// Over the mesh of `data`, or over `stored` if there is one.
Work prepare_loops(const Dataset& data, std::shared_ptr<const Connectivity> stored) {
  auto loops = std::make_shared<BoundaryLoops>();
  const Connectivity& mesh = stored ? *stored : data.mesh;
  Work work;
  work.run = [&mesh, stored = std::move(stored), loops] { *loops = boundary_loops(mesh); };
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
Traffic loops_traffic(const Dataset& data) { return {kIndexBytes * counts_of(data).halfedges, 0}; }
/// Reads origin; writes a label for each vertex.
Traffic components_traffic(const Dataset& data) {
  const Counts counts = counts_of(data);
  return {kIndexBytes * counts.halfedges, kIndexBytes * counts.vertices};
}

}  // namespace

void add_query(const Plan& plan) {
  for (const DatasetKey& key : plan.large) {
    add(plan, {"boundary_loops", key, 1, "stored",
               [](const Dataset& data, const Execution&) {
                 return prepare_loops(data, stored_form(data));
               },
               loops_traffic, Mix::read});
  }
  for (const DatasetKey& key : plan.all) {
    add(plan, {"boundary_loops", key, 1, "",
               [](const Dataset& data, const Execution&) { return prepare_loops(data, nullptr); },
               loops_traffic, Mix::read});
    for (const int threads : plan.threads) {
      add(plan,
          {"components", key, threads, "", prepare_components, components_traffic, Mix::read});
    }
    if (!plan.has_peers(key)) continue;
    for (const Peer& peer : peers()) {
      if (!peer.is_baseline) continue;
      add(plan, {"components", key, 1, peer.name,
                 [&peer](const Dataset& data, const Execution&) {
                   return prepare_peer_components(data, peer);
                 },
                 components_traffic, Mix::read});
    }
  }
}

}  // namespace hedgerow::bench
