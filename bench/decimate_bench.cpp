// hedgerow/decimate.h.
#include <memory>
#include <string>
#include <utility>

#include "hedgerow/decimate.h"
#include "hedgerow/validate.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

/// A tenth of the faces is to be left.
DecimateOptions options_of(const Dataset& data, DecimateOrder order) {
  DecimateOptions options;
  options.faces = data.mesh.face_count() / 10;
  options.order = order;
  return options;
}

/// What is wrong with a result; "": nothing.
std::string find_fault(const Dataset& data, const DecimateOutput& output, DecimateOrder order) {
  const DecimateOptions options = options_of(data, DecimateOrder::queue);
  if (output.end != DecimateEnd::faces || output.mesh.face_count() > options.faces ||
      output.mesh.face_count() < options.faces - 1) {
    return "another number of faces than was asked for; not measured";
  }
  if (!validate(output.mesh, Execution::serial()).empty()) return "not a sound mesh; not measured";
  if (order == DecimateOrder::rounds) {
    const auto queue = decimate(data.mesh, data.positions(), options, Execution::serial());
    if (!queue || output.total_cost > 1.1 * queue->total_cost) {
      return "costs a tenth more than a queue; not measured";
    }
  }
  return "";
}

Work prepare(const Dataset& data, const Execution& execution, DecimateOrder order) {
  auto output = std::make_shared<DecimateOutput>();
  Work work;
  work.run = [&data, execution, order, output] {
    auto result = decimate(data.mesh, data.positions(), options_of(data, order), execution);
    if (result) *output = std::move(*result);
  };
  // The counts stay, for the notes.
  work.cleanup = [output] {
    output->mesh = {};
    output->positions = {};
    output->maps = {};
  };
  work.check = [&data, output, order] { return find_fault(data, *output, order); };
  work.digest = [output] { return digest_of(output->mesh); };
  work.notes = [output]() -> Notes {
    Notes notes = {{"collapses", static_cast<double>(output->collapses)}};
    if (output->rounds > 0) {
      notes["accepted_percent"] =
          100 * static_cast<double>(output->accepted) / static_cast<double>(output->candidates);
    }
    return notes;
  };
  return work;
}

/// Reads the mesh and the points, and writes an edited mesh and a quadric of each vertex: what goes
/// to and fro meanwhile is the algorithm's own.
Traffic traffic(const Dataset& data) {
  const auto [halfedges, vertices, faces] = counts_of(data);
  return {kIndexBytes * (2 * halfedges + vertices) + kPointBytes * vertices,
          kIndexBytes * (5 * halfedges + 2 * vertices + faces) + 13 * sizeof(double) * vertices};
}

void add_orders(const DatasetKey& key, const Plan& plan) {
  add({"decimate", key, 1, "queue",
       [](const Dataset& data, const Execution& execution) {
         return prepare(data, execution, DecimateOrder::queue);
       },
       traffic, Mix::copy});
  for (const int threads : plan.threads) {
    add({"decimate", key, threads, "rounds",
         [](const Dataset& data, const Execution& execution) {
           return prepare(data, execution, DecimateOrder::rounds);
         },
         traffic, Mix::copy});
  }
}

}  // namespace

void add_decimate(const Plan& plan) {
  if (plan.planar.empty()) return;
  constexpr std::int64_t kInCache = 20'000;
  constexpr std::int64_t kMillion = 1'000'000;
  if (plan.is_smoke) {
    add_orders({"terrain", 800, ""}, plan);
    return;
  }
  add_orders({"terrain", kInCache, ""}, plan);
  add_orders({"terrain", kMillion, ""}, plan);
  add_orders({"grid", kMillion, ""}, plan);
}

}  // namespace hedgerow::bench
