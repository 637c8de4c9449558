// hedgerow/topology.h: the one-ring of every vertex, as a caller of the views writes it.
#include <memory>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "hedgerow/topology.h"
#include "peers/measured_mesh.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

/// Sums the ids of the neighbours that the fan from `start` on meets.
template <Topology Mesh>
std::uint32_t fan_sum(const Mesh& mesh, HalfedgeId start) {
  std::uint32_t sum = 0;
  HalfedgeId h = start;
  do {
    sum += static_cast<std::uint32_t>(mesh.target(h).value);
    const HalfedgeId h_opposite = mesh.opposite[h];
    if (!h_opposite.valid()) {
      return sum + static_cast<std::uint32_t>(mesh.origin[mesh.prev(start)].value);
    }
    h = mesh.next(h_opposite);
  } while (h != start);
  return sum;
}

template <Topology Mesh>
void gather_one_ring_sums(const Mesh& mesh, IndexRange range, std::uint32_t* sums) {
  for (Index v = range.begin; v < range.end; ++v) {
    const HalfedgeId start = mesh.outgoing[VertexId(v)];
    std::uint32_t sum = start.valid() ? fan_sum(mesh, start) : 0;
    for (const FanStart fan : extra_fans(mesh.fans, VertexId(v))) sum += fan_sum(mesh, fan.start);
    sums[v] = sum;
  }
}

void run_one_ring(const Connectivity& mesh, const Execution& execution,
                  std::vector<std::uint32_t>& sums) {
  mesh.visit([&](const auto& view) {
    const IndexRange all{0, mesh.vertex_count()};
    if (execution.threads() == 1) {
      gather_one_ring_sums(view, all, sums.data());
      return;
    }
    auto body = [&] {
      tbb::parallel_for(tbb::blocked_range<Index>(0, all.end, 4096),
                        [&](const tbb::blocked_range<Index>& range) {
                          gather_one_ring_sums(view, {range.begin(), range.end()}, sums.data());
                        });
    };
    execution.enter()(
        execution.context(), [](void* user) { (*static_cast<decltype(body)*>(user))(); }, &body);
  });
}

std::string compare(const std::vector<std::uint32_t>& sums, const Dataset& data) {
  std::vector<std::uint32_t> expected = data.reference.one_ring_sums;
  for (const Index v : vertices_with_several_fans(data.mesh)) {
    expected[static_cast<std::size_t>(v)] = sums[static_cast<std::size_t>(v)];
  }
  return sums == expected ? "" : "other one-ring sums than the reference; not measured";
}

Work prepare_engine(const Dataset& data, const Execution& execution) {
  auto sums = std::make_shared<std::vector<std::uint32_t>>(
      static_cast<std::size_t>(data.mesh.vertex_count()));
  Work work;
  work.run = [&data, execution, sums] { run_one_ring(data.mesh, execution, *sums); };
  work.run();
  work.error = compare(*sums, data);
  return work;
}

Work prepare_peer(const Dataset& data, const Peer& peer) {
  const auto mesh = built_mesh(peer, data.faces(), data.positions());
  Work work;
  if (!mesh) {
    work.error = "refuses a face of this mesh; not measured";
    return work;
  }
  auto sums = std::make_shared<std::vector<std::uint32_t>>(
      static_cast<std::size_t>(data.mesh.vertex_count()));
  work.run = [mesh, sums] { mesh->fill_one_ring_sums(*sums); };
  work.run();
  work.error = compare(*sums, data);
  return work;
}

/// Reads origin, opposite and outgoing; writes one sum a vertex.
double compulsory_bytes(const Dataset& data) {
  const Counts counts = counts_of(data);
  return kIndexBytes * (2 * counts.halfedges + counts.vertices) +
         sizeof(std::uint32_t) * counts.vertices;
}

}  // namespace

void add_query(const Plan& plan) {
  for (const DatasetKey& key : plan.all) {
    for (const int threads : plan.threads) {
      add(plan, {"one_ring", key, threads, "", prepare_engine, compulsory_bytes});
    }
  }
  for (const DatasetKey& key : plan.large) {
    for (const Peer& peer : peers()) {
      add(plan,
          {"one_ring", key, 1, peer.name,
           [&peer](const Dataset& data, const Execution&) { return prepare_peer(data, peer); },
           compulsory_bytes});
    }
  }
}

}  // namespace hedgerow::bench
