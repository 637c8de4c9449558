// hedgerow/boundary.h: between the default form and the closed form, every column made anew.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>

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

std::string compare_closed(const Dataset& data, const Connectivity& closed,
                           const Connectivity& serially_closed) {
  const Result<Connectivity> opened = open_boundary(closed, Execution::serial());
  if (!opened || !is_same(*opened, data.mesh)) {
    return "opening the closed mesh gives another mesh; not measured";
  }
  return is_same(closed, serially_closed) ? "" : "another mesh than the serial run's; not measured";
}

std::string compare_opened(const Dataset& data, const Connectivity& opened) {
  return is_same(opened, data.mesh) ? ""
                                    : "another mesh than the one that was closed; not measured";
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
  work.check = [&data, is_closing, closed_mesh, output]() -> std::string {
    if (!output->has_value()) return "the operation failed; not measured";
    return is_closing ? compare_closed(data, **output, *closed_mesh)
                      : compare_opened(data, **output);
  };
  work.digest = [output] { return output->has_value() ? digest_of(**output) : 0; };
  work.notes = [output]() -> Notes {
    if (!output->has_value()) return {};
    return {{"bytes_per_halfedge", bytes_per_halfedge(**output)}};
  };
  return work;
}

}  // namespace

void add_boundary(const Plan& plan) {
  for (const DatasetKey& key : plan.large) {
    for (const int threads : plan.threads) {
      add({"close_boundary", key, threads, "",
           [](const Dataset& data, const Execution& execution) {
             return prepare(data, execution, true);
           },
           close_traffic, Mix::copy});
      add({"open_boundary", key, threads, "",
           [](const Dataset& data, const Execution& execution) {
             return prepare(data, execution, false);
           },
           open_traffic, Mix::copy});
    }
  }
}

}  // namespace hedgerow::bench
