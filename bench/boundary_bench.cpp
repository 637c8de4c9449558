// hedgerow/boundary.h: between the default form and the closed form, every column made anew.
#include <algorithm>
#include <memory>
#include <optional>

#include "hedgerow/boundary.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

/// Reads origin, opposite and outgoing; writes them and next, face and first.
Traffic close_traffic(const Dataset& data) {
  const auto [halfedges, vertices, faces] = counts_of(data);
  return {kIndexBytes * (2 * halfedges + vertices),
          kIndexBytes * (4 * halfedges + vertices + faces)};
}
/// Reads all columns; writes origin, opposite and outgoing.
Traffic open_traffic(const Dataset& data) {
  const Traffic closing = close_traffic(data);
  return {closing.written, closing.read};
}

bool is_same(const Connectivity& a, const Connectivity& b) {
  return std::ranges::equal(a.origin(), b.origin()) &&
         std::ranges::equal(a.opposite(), b.opposite()) &&
         std::ranges::equal(a.outgoing(), b.outgoing());
}

Work prepare(const Dataset& data, const Execution& execution, bool is_closing) {
  Work work;
  Result<Connectivity> closed = close_boundary(data.mesh, Execution::serial());
  if (!closed) {
    work.error = "close_boundary failed; not measured";
    return work;
  }
  const auto closed_mesh = std::make_shared<Connectivity>(std::move(*closed));
  auto output = std::make_shared<std::optional<Connectivity>>();
  work.run = [&data, execution, is_closing, closed_mesh, output] {
    Result<Connectivity> result =
        is_closing ? close_boundary(data.mesh, execution) : open_boundary(*closed_mesh, execution);
    if (result) output->emplace(std::move(*result));
  };
  work.cleanup = [output] { output->reset(); };
  work.run();
  if (!output->has_value()) {
    work.error = "the operation failed; not measured";
  } else if (is_closing) {
    const Result<Connectivity> opened = open_boundary(**output, Execution::serial());
    if (!opened || !is_same(*opened, data.mesh)) {
      work.error = "opening the closed mesh gives another mesh; not measured";
    } else if (!is_same(**output, *closed_mesh)) {
      work.error = "another mesh than the serial run's; not measured";
    }
  } else if (!is_same(**output, data.mesh)) {
    work.error = "another mesh than the one that was closed; not measured";
  }
  work.cleanup();
  return work;
}

}  // namespace

void add_boundary(const Plan& plan) {
  for (const DatasetKey& key : plan.large) {
    for (const int threads : plan.threads) {
      add(plan, {"close_boundary", key, threads, "",
                 [](const Dataset& data, const Execution& execution) {
                   return prepare(data, execution, true);
                 },
                 close_traffic, Mix::copy});
      add(plan, {"open_boundary", key, threads, "",
                 [](const Dataset& data, const Execution& execution) {
                   return prepare(data, execution, false);
                 },
                 open_traffic, Mix::copy});
    }
  }
}

}  // namespace hedgerow::bench
