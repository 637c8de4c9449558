// hedgerow/reorder.h: renumbering a mesh whose order was lost.
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "hedgerow/reorder.h"
#include "hedgerow/validate.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

constexpr std::array<std::pair<ReorderMethod, const char*>, 4> kMethods = {
    {{ReorderMethod::hilbert, "reorder_hilbert"},
     {ReorderMethod::morton, "reorder_morton"},
     {ReorderMethod::breadth_first, "reorder_breadth_first"},
     {ReorderMethod::fronts, "reorder_fronts"}}};

/// Reads origin, opposite, outgoing and the positions; writes the three columns and the
/// permutations (vertices both ways, faces, half-edges).
Traffic traffic(const Dataset& data) {
  const auto [halfedges, vertices, faces] = counts_of(data);
  return {kIndexBytes * (2 * halfedges + vertices) + kPointBytes * vertices,
          kIndexBytes * (3 * halfedges + 3 * vertices + faces)};
}

/// Empty, or how the result is not the same mesh in another order.
std::string compare(const Dataset& data, const ReorderOutput& output) {
  const auto old_origin = data.mesh.origin();
  const auto old_opposite = data.mesh.opposite();
  const auto& halfedges = output.reordering.halfedges_new_to_old;
  const auto& vertices = output.reordering.vertices_new_to_old;
  for (std::size_t h = 0; h < halfedges.size(); ++h) {
    const auto old = static_cast<std::size_t>(halfedges[h]);
    const auto v = static_cast<std::size_t>(output.mesh.origin()[h]);
    if (vertices[v] != old_origin[old]) return "an origin that was not renumbered; not measured";
    const Index g = output.mesh.opposite()[h];
    const Index old_g = g == kInvalidIndex ? kInvalidIndex : halfedges[static_cast<std::size_t>(g)];
    if (old_g != old_opposite[old]) return "an opposite that was not renumbered; not measured";
  }
  if (!validate(output.mesh, Execution::serial()).empty()) {
    return "violations in the reordered mesh; not measured";
  }
  return "";
}

Work prepare(const Dataset& data, const Execution& execution, ReorderMethod method) {
  auto output = std::make_shared<std::optional<ReorderOutput>>();
  Work work;
  work.run = [&data, execution, method, output] {
    Result<ReorderOutput> result = reorder(data.mesh, data.positions(), method, execution);
    if (result) output->emplace(std::move(*result));
  };
  work.cleanup = [output] { output->reset(); };
  work.check = [&data, output] {
    return output->has_value() ? compare(data, **output) : "reorder failed; not measured";
  };
  work.digest = [output] { return output->has_value() ? digest_of((*output)->mesh) : 0; };
  work.notes = [output]() -> Notes {
    if (!output->has_value()) return {};
    return {{"bytes_per_halfedge", bytes_per_halfedge((*output)->mesh)}};
  };
  return work;
}

}  // namespace

void add_reorder(const Plan& plan) {
  for (const DatasetKey& key : plan.large) {
    for (const auto& [method, name] : kMethods) {
      for (const int threads : plan.threads) {
        add({name, key, threads, "",
             [method = method](const Dataset& data, const Execution& execution) {
               return prepare(data, execution, method);
             },
             traffic, Mix::copy});
      }
    }
  }
}

}  // namespace hedgerow::bench
