// hedgerow/build.h: from an index buffer to opposites and outgoing half-edges. Allocation of the
// result is part of the time, for every contender; freeing it is not.
#include <algorithm>
#include <memory>
#include <optional>

#include "hedgerow/build.h"
#include "peers/adjacency.h"
#include "peers/measured_mesh.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

/// Reads the corners, writes an opposite for each and an outgoing half-edge for each vertex.
Traffic traffic(const Dataset& data) {
  const Counts counts = counts_of(data);
  return {kIndexBytes * counts.halfedges, kIndexBytes * (counts.halfedges + counts.vertices)};
}

Work prepare_engine(const Dataset& data, const Execution& execution, BuildStrategy strategy) {
  BuildOptions options;
  options.borrow_corners = true;  // the caller's index buffer is the `origin` column
  options.strategy = strategy;
  auto output = std::make_shared<std::optional<BuildOutput>>();
  Work work;
  work.run = [&data, execution, options, output] {
    Result<BuildOutput> built = build(data.faces(), options, execution);
    if (built) output->emplace(std::move(*built));
  };
  work.cleanup = [output] { output->reset(); };
  work.check = [&data, output]() -> std::string {
    if (!output->has_value()) return "build failed; not measured";
    const bool is_right = std::ranges::equal((*output)->mesh.opposite(), data.reference().opposite);
    return is_right ? "" : "wrong opposites; not measured";
  };
  work.digest = [output] { return output->has_value() ? digest_of((*output)->mesh) : 0; };
  work.notes = [output]() -> Notes {
    if (!output->has_value()) return {};
    const BuildStats& stats = (*output)->stats;
    return {{"is_window", stats.strategy == BuildStrategy::window ? 1 : 0},
            {"scans_per_face", static_cast<double>(stats.scan_per_mille) / 1000},
            {"bytes_per_halfedge", bytes_per_halfedge((*output)->mesh)}};
  };
  return work;
}

Work prepare_peer(const Dataset& data, const Peer& peer) {
  auto mesh = std::make_shared<std::unique_ptr<MeasuredMesh>>();
  Work work;
  work.run = [&data, &peer, mesh] { *mesh = peer.build(data.faces(), data.positions()); };
  work.cleanup = [mesh] { mesh->reset(); };
  work.check = [&data, mesh]() -> std::string {
    if (!*mesh) return "refuses a face of this mesh; not measured";
    const bool is_right = (*mesh)->opposite() == data.reference().opposite;
    return is_right ? "" : "other opposites than the reference; not measured";
  };
  work.digest = [mesh] { return *mesh ? digest_of((*mesh)->opposite()) : 0; };
  return work;
}

#if defined(HEDGEROW_BENCH_MESHOPTIMIZER)
/// The vertex across each edge, as meshoptimizer gives it, from our own opposites.
bool agrees(const std::vector<std::uint32_t>& adjacency, const Dataset& data) {
  const auto origin = data.mesh.origin();
  const auto& opposite = data.reference().opposite;
  for (std::size_t h = 0; h < opposite.size(); ++h) {
    if (opposite[h] == kInvalidIndex) continue;
    const auto g = static_cast<std::size_t>(opposite[h]);
    const std::size_t g_prev = g % 3 == 0 ? g + 2 : g - 1;
    if (adjacency[2 * h + 1] != static_cast<std::uint32_t>(origin[g_prev])) return false;
  }
  return true;
}

Work prepare_adjacency(const Dataset& data) {
  Work work;
  if (!data.faces().is_triangles()) {
    work.error = "takes triangles only; not measured";
    return work;
  }
  const std::size_t size = 6 * static_cast<std::size_t>(data.faces().face_count);
  auto adjacency = std::make_shared<std::vector<std::uint32_t>>();
  work.run = [&data, adjacency, size] {
    adjacency->resize(size);
    fill_adjacency_buffer(data.faces(), data.positions(), *adjacency);
  };
  work.cleanup = [adjacency] { *adjacency = {}; };
  work.check = [&data, adjacency]() -> std::string {
    if (agrees(*adjacency, data)) return "";
    return "other neighbours than the reference (it joins equal positions); not measured";
  };
  work.digest = [adjacency] { return digest_of(*adjacency); };
  return work;
}

#endif

void add_adjacency([[maybe_unused]] const DatasetKey& key) {
#if defined(HEDGEROW_BENCH_MESHOPTIMIZER)
  // The library takes 32-bit indices; wider ones would have to be copied first.
  if constexpr (sizeof(Index) == sizeof(std::uint32_t)) {
    add({"build", key, 1, "meshoptimizer",
         [](const Dataset& data, const Execution&) { return prepare_adjacency(data); }, traffic,
         Mix::copy});
  }
#endif
}

void add_engine(const char* operation, const DatasetKey& key, int threads, BuildStrategy strategy,
                const std::string& variant) {
  add({operation, key, threads, variant,
       [strategy](const Dataset& data, const Execution& execution) {
         return prepare_engine(data, execution, strategy);
       },
       traffic, Mix::copy});
}

void add_peers(const DatasetKey& key) {
  for (const Peer& peer : peers()) {
    add({"build", key, 1, peer.name,
         [&peer](const Dataset& data, const Execution&) { return prepare_peer(data, peer); },
         traffic, Mix::copy});
  }
  add_adjacency(key);
}

}  // namespace

void add_build(const Plan& plan) {
  for (const DatasetKey& key : plan.all) {
    for (const int threads : plan.threads) {
      add_engine("build", key, threads, BuildStrategy::automatic, "");
    }
    if (plan.has_peers(key)) add_peers(key);
  }
  for (const DatasetKey& key : plan.large) {
    for (const int threads : plan.threads) {
      // On shuffled faces every block of vertices would scan all of them.
      if (key.shape != "shuffled") {
        add_engine("build", key, threads, BuildStrategy::window, "window");
      }
      add_engine("build", key, threads, BuildStrategy::partition, "partition");
    }
  }
  for (const DatasetKey& key : plan.disordered) {
    add_engine("strategy", key, 1, BuildStrategy::automatic, "");
    add_engine("strategy", key, 1, BuildStrategy::window, "window");
    add_engine("strategy", key, 1, BuildStrategy::partition, "partition");
  }
}

}  // namespace hedgerow::bench
