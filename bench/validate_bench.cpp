// hedgerow/validate.h: all invariants of a sound mesh.
#include <memory>
#include <string>

#include "hedgerow/validate.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

/// Reads origin, opposite and outgoing.
Traffic traffic(const Dataset& data) {
  const Counts counts = counts_of(data);
  return {kIndexBytes * (2 * counts.halfedges + counts.vertices), 0};
}

/// A copy whose first opposite is wrong: what must be found before finding nothing means anything.
bool finds_damage(const Dataset& data, const Execution& execution) {
  Buffer<Index> opposite = Buffer<Index>::copy_of(data.mesh.opposite());
  opposite[0] = 0;
  ConnectivityColumns columns;
  columns.origin = ColumnStorage::borrow(data.mesh.origin());
  columns.opposite = std::move(opposite);
  columns.outgoing = ColumnStorage::borrow(data.mesh.outgoing());
  columns.all_triangles = true;
  const Connectivity damaged(std::move(columns));
  return !validate(damaged, execution).empty();
}

Work prepare(const Dataset& data, const Execution& execution) {
  auto violations = std::make_shared<std::vector<Violation>>();
  Work work;
  work.run = [&data, execution, violations] { *violations = validate(data.mesh, execution); };
  work.check = [&data, execution, violations]() -> std::string {
    if (!violations->empty()) return "violations in a sound mesh; not measured";
    if (data.mesh.is_implicit() && !finds_damage(data, execution)) {
      return "no violation in a damaged mesh; not measured";
    }
    return "";
  };
  work.digest = [violations] { return static_cast<std::uint64_t>(violations->size()); };
  return work;
}

}  // namespace

void add_validate(const Plan& plan) {
  for (const DatasetKey& key : plan.large) {
    for (const int threads : plan.threads) {
      add({"validate", key, threads, "", prepare, traffic, Mix::read});
    }
  }
}

}  // namespace hedgerow::bench
