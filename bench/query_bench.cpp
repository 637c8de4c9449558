// hedgerow/query.h and hedgerow/radial.h: questions about the whole mesh.
#include <memory>
#include <utility>

#include "hedgerow/query.h"
#include "hedgerow/radial.h"
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

Work prepare_radial(const Dataset& data, const Execution& execution) {
  auto edges = std::make_shared<RadialCycles>();
  Work work;
  work.run = [&data, execution, edges] { *edges = build_radial(data.mesh, execution); };
  work.cleanup = [edges] { *edges = {}; };
  work.run();
  const std::vector<Index>& opposite = data.reference.opposite;
  for (std::size_t h = 0; h < opposite.size() && work.error.empty(); ++h) {
    if (opposite[h] == kInvalidIndex ||
        edges->next(HalfedgeId(static_cast<Index>(h))).value == opposite[h])
      continue;
    // A pair between the vertices of an edge that was cut is part of a longer cycle.
    const HalfedgeId next = edges->next(HalfedgeId(static_cast<Index>(h)));
    if (edges->next(next).value == static_cast<Index>(h)) {
      work.error = "a pair that the reference does not have; not measured";
    }
  }
  work.cleanup();
  return work;
}

/// Reads opposite, and writes the next half-edge round the edge.
Traffic radial_traffic(const Dataset& data) {
  const double bytes = kIndexBytes * counts_of(data).halfedges;
  return {bytes, bytes};
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
  for (const DatasetKey& key : plan.large) {
    for (const int threads : plan.threads) {
      add(plan, {"build_radial", key, threads, "", prepare_radial, radial_traffic, Mix::copy});
    }
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
