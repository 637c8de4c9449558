// hedgerow/circulate.h: the sum of the neighbours' ids for every vertex, by the range that a caller
// would use, over computed and over stored `next` and `face`, and written out by hand; and by the
// pass over the half-edges for callers to whom the order round a vertex is nothing.
#include <memory>
#include <string_view>
#include <utility>

#include "hedgerow/circulate.h"
#include "parallel_ranges.h"
#include "peers/measured_mesh.h"
#include "runner.h"
#include "stored_form.h"

namespace hedgerow::bench {

namespace {

/// Sums the ids of v's neighbours, modulo 2^32.
struct ByRange {
  template <Topology Mesh>
  std::uint32_t operator()(const Mesh& mesh, VertexId v) const noexcept {
    std::uint32_t sum = 0;
    for (const VertexId u : neighbours(mesh, v)) sum += static_cast<std::uint32_t>(u.value);
    return sum;
  }
};

/// Sums the ids of the half-edges that leave v: the walk alone.
struct ByOutgoing {
  template <Topology Mesh>
  std::uint32_t operator()(const Mesh& mesh, VertexId v) const noexcept {
    std::uint32_t sum = 0;
    for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
      sum += static_cast<std::uint32_t>(h.value);
    }
    return sum;
  }
};

struct ByHand {
  template <Topology Mesh>
  std::uint32_t operator()(const Mesh& mesh, VertexId v) const noexcept {
    const HalfedgeId start = mesh.outgoing[v];
    std::uint32_t sum = start.valid() ? fan_sum(mesh, start) : 0;
    for (const FanStart fan : extra_fans(mesh.fans, v)) sum += fan_sum(mesh, fan.start);
    return sum;
  }

 private:
  template <Topology Mesh>
  static std::uint32_t fan_sum(const Mesh& mesh, HalfedgeId start) noexcept {
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
};

/// Each vertex reads its neighbours and writes its own sum, so any partition is free of races.
template <Topology Mesh, class Sum>
void gather_sums(const Mesh& mesh, const Execution& execution, const Sum& sum_of,
                 std::vector<std::uint32_t>& sums) {
  const auto run = [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) {
      sums[static_cast<std::size_t>(v)] = sum_of(mesh, VertexId(v));
    }
  };
  for_ranges(execution, mesh.vertex_count(), 4096, run);
}

/// The sums of the half-edges that leave each vertex, from the column of origins.
std::string compare_outgoing(const std::vector<std::uint32_t>& sums, const Dataset& data) {
  std::vector<std::uint32_t> expected(sums.size(), 0);
  std::uint32_t h = 0;
  for (const Index v : data.mesh.origin()) expected[static_cast<std::size_t>(v)] += h++;
  return sums == expected ? "" : "other half-edges than leave the vertices; not measured";
}

std::string compare(const std::vector<std::uint32_t>& sums, const Dataset& data) {
  std::vector<std::uint32_t> expected = data.reference().one_ring_sums;
  for (const Index v : vertices_with_several_fans(data.mesh)) {
    expected[static_cast<std::size_t>(v)] = sums[static_cast<std::size_t>(v)];
  }
  return sums == expected ? "" : "other one-ring sums than the reference; not measured";
}

using Compare = std::string (*)(const std::vector<std::uint32_t>&, const Dataset&);

/// Over the mesh of `data`, or over `stored` if there is one.
template <class Sum>
Work prepare_engine(const Dataset& data, const Execution& execution, const Sum& sum_of,
                    std::shared_ptr<const Connectivity> stored, Compare compare_sums) {
  auto sums = std::make_shared<std::vector<std::uint32_t>>(
      static_cast<std::size_t>(data.mesh.vertex_count()));
  const Connectivity& mesh = stored ? *stored : data.mesh;
  Work work;
  work.run = [&mesh, stored = std::move(stored), execution, sum_of, sums] {
    mesh.visit([&](const auto& view) { gather_sums(view, execution, sum_of, *sums); });
  };
  work.check = [&data, sums, compare_sums] { return compare_sums(*sums, data); };
  work.digest = [sums] { return digest_of(*sums); };
  return work;
}

Work prepare_pass(const Dataset& data, const Execution&) {
  auto sums = std::make_shared<std::vector<std::uint32_t>>();
  Work work;
  work.run = [&data, sums] {
    sums->assign(static_cast<std::size_t>(data.mesh.vertex_count()), 0U);
    data.mesh.visit([&](const auto& view) {
      for_each_neighbour(view, {0, view.halfedge_count()}, [&](VertexId v, VertexId u) {
        (*sums)[static_cast<std::size_t>(v.value)] += static_cast<std::uint32_t>(u.value);
      });
    });
  };
  work.check = [&data, sums] { return compare(*sums, data); };
  work.digest = [sums] { return digest_of(*sums); };
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
  work.check = [&data, sums] { return compare(*sums, data); };
  work.digest = [sums] { return digest_of(*sums); };
  return work;
}

/// Reads opposite and outgoing; writes one sum a vertex.
Traffic outgoing_traffic(const Dataset& data) {
  const Counts counts = counts_of(data);
  return {kIndexBytes * (counts.halfedges + counts.vertices),
          sizeof(std::uint32_t) * counts.vertices};
}
/// Beside that, reads origin.
Traffic ring_traffic(const Dataset& data) {
  Traffic traffic = outgoing_traffic(data);
  traffic.read += kIndexBytes * counts_of(data).halfedges;
  return traffic;
}

template <class Sum>
void add_engine(const Plan& plan, const char* operation, const DatasetKey& key, const Sum& sum_of,
                bool is_stored, const std::string& variant) {
  const bool is_walk = operation == std::string_view("circulator");
  for (const int threads : plan.threads) {
    add({operation, key, threads, variant,
         [=](const Dataset& data, const Execution& execution) {
           return prepare_engine(data, execution, sum_of, is_stored ? stored_form(data) : nullptr,
                                 is_walk ? compare_outgoing : compare);
         },
         [=](const Dataset& data) {
           Traffic traffic = is_walk ? outgoing_traffic(data) : ring_traffic(data);
           if (is_stored) traffic.read += kIndexBytes * counts_of(data).halfedges;
           return traffic;
         },
         Mix::read});
  }
}

}  // namespace

void add_circulate(const Plan& plan) {
  for (const DatasetKey& key : plan.all) {
    add_engine(plan, "one_ring", key, ByRange{}, false, "");
    if (!plan.has_peers(key)) continue;
    for (const Peer& peer : peers()) {
      add({"one_ring", key, 1, peer.name,
           [&peer](const Dataset& data, const Execution&) { return prepare_peer(data, peer); },
           ring_traffic, Mix::read});
    }
  }
  for (const DatasetKey& key : plan.large) {
    add_engine(plan, "one_ring", key, ByHand{}, false, "by-hand");
    add_engine(plan, "one_ring", key, ByRange{}, true, "stored");
    add({"one_ring", key, 1, "pass", prepare_pass, ring_traffic, Mix::read});
    add_engine(plan, "circulator", key, ByOutgoing{}, false, "");
    add_engine(plan, "circulator", key, ByOutgoing{}, true, "stored");
  }
}

}  // namespace hedgerow::bench
