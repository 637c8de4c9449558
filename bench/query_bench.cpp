// hedgerow/query.h: questions about the whole mesh, on the calling thread as they are.
#include <memory>

#include "hedgerow/query.h"
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

Work prepare_components(const Dataset& data, const Execution&) {
  auto components = std::make_shared<Components>();
  Work work;
  work.run = [&data, components] { *components = connected_components(data.mesh); };
  work.run();
  if (components->count != data.reference.components) {
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
    add(plan, {"components", key, 1, "", prepare_components, components_bytes});
  }
}

}  // namespace hedgerow::bench
