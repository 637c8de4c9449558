// hedgerow/query.h and hedgerow/radial.h: questions about the whole mesh.
#include <memory>
#include <string>
#include <utility>
#include <vector>

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
  work.check = [&data, loops] {
    return loops->count() == data.reference().boundary_loops
               ? ""
               : "another number of boundary loops than the reference; not measured";
  };
  work.digest = [loops] { return digest_of(loops->halfedges); };
  return work;
}

std::string compare_count(Index component_count, const Dataset& data) {
  return component_count == data.reference().components
             ? ""
             : "another number of components than the reference; not measured";
}

Work prepare_components(const Dataset& data, const Execution& execution) {
  // Kept from run to run, as a program would that asks again and again.
  struct Labels {
    Buffer<Index> label;
    Workspace workspace;
    Result<Index> count;
  };
  auto labels = std::make_shared<Labels>(
      Labels{Buffer<Index>(static_cast<std::size_t>(data.mesh.vertex_count())), {}, Index{0}});
  Work work;
  work.run = [&data, labels, execution] {
    labels->count =
        connected_components(data.mesh, labels->label.span(), execution, labels->workspace);
  };
  work.check = [&data, labels] {
    return labels->count ? compare_count(*labels->count, data)
                         : "the operation failed; not measured";
  };
  work.digest = [labels] { return digest_of(labels->label); };
  return work;
}

Work prepare_peer_components(const Dataset& data, const Peer& peer) {
  const auto mesh = built_mesh(peer, data.faces(), data.positions());
  auto count = std::make_shared<Index>();
  Work work;
  work.run = [mesh, count] { *count = mesh->component_count(); };
  work.check = [&data, count] { return compare_count(*count, data); };
  work.digest = [count] { return static_cast<std::uint64_t>(*count); };
  return work;
}

/// A pair between the vertices of an edge that was cut is part of a longer cycle.
std::string compare_cycles(const RadialCycles& edges, const std::vector<Index>& opposite) {
  for (std::size_t h = 0; h < opposite.size(); ++h) {
    const HalfedgeId next = edges.next(HalfedgeId(static_cast<Index>(h)));
    if (opposite[h] == kInvalidIndex || next.value == opposite[h]) continue;
    if (edges.next(next).value == static_cast<Index>(h)) {
      return "a pair that the reference does not have; not measured";
    }
  }
  return "";
}

Work prepare_radial(const Dataset& data, const Execution& execution) {
  auto edges = std::make_shared<RadialCycles>();
  Work work;
  work.run = [&data, execution, edges] { *edges = build_radial(data.mesh, execution); };
  work.cleanup = [edges] { *edges = {}; };
  work.check = [&data, edges] { return compare_cycles(*edges, data.reference().opposite); };
  work.digest = [&data, edges] {
    std::vector<Index> next(static_cast<std::size_t>(data.mesh.halfedge_count()));
    for (std::size_t h = 0; h < next.size(); ++h) {
      next[h] = edges->next(HalfedgeId(static_cast<Index>(h))).value;
    }
    return digest_of(next);
  };
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
    add({"boundary_loops", key, 1, "stored",
         [](const Dataset& data, const Execution&) {
           return prepare_loops(data, stored_form(data));
         },
         loops_traffic, Mix::read});
  }
  for (const DatasetKey& key : plan.large) {
    for (const int threads : plan.threads) {
      add({"build_radial", key, threads, "", prepare_radial, radial_traffic, Mix::copy});
    }
  }
  for (const DatasetKey& key : plan.all) {
    add({"boundary_loops", key, 1, "",
         [](const Dataset& data, const Execution&) { return prepare_loops(data, nullptr); },
         loops_traffic, Mix::read});
    for (const int threads : plan.threads) {
      add({"components", key, threads, "", prepare_components, components_traffic, Mix::read});
    }
    if (!plan.has_peers(key)) continue;
    for (const Peer& peer : peers()) {
      if (!peer.is_baseline) continue;
      add({"components", key, 1, peer.name,
           [&peer](const Dataset& data, const Execution&) {
             return prepare_peer_components(data, peer);
           },
           components_traffic, Mix::read});
    }
  }
}

}  // namespace hedgerow::bench
