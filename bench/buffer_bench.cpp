// hedgerow/buffer.h: a fresh column, allocated and written once; what a build pays before it
// starts.
#include <memory>
#include <vector>

#include "hedgerow/buffer.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

constexpr Index kStep = 3;

template <class Column>
void fill(Column& column) noexcept {
  const auto count = static_cast<Index>(column.size());
  for (Index i = 0; i < count; ++i) column[static_cast<std::size_t>(i)] = i * kStep;
}

template <class Column>
Work prepare(const Dataset& data, const Execution&) {
  const auto count = static_cast<std::size_t>(data.mesh.halfedge_count());
  auto column = std::make_shared<std::unique_ptr<Column>>();
  Work work;
  work.run = [count, column] {
    *column = std::make_unique<Column>(count);
    fill(**column);
  };
  work.cleanup = [column] { column->reset(); };
  work.check = [count, column] {
    const Index last = (**column)[count - 1];
    return last == static_cast<Index>(count - 1) * kStep ? "" : "wrong values; not measured";
  };
  work.digest = [column] { return digest_of(**column); };
  return work;
}

Traffic traffic(const Dataset& data) { return {0, kIndexBytes * counts_of(data).halfedges}; }

}  // namespace

void add_buffer(const Plan& plan) {
  if (plan.large.empty()) return;
  const DatasetKey& key = plan.large.front();
  add({"fill_column", key, 1, "", prepare<Buffer<Index>>, traffic, Mix::copy});
  add({"fill_column", key, 1, "vector", prepare<std::vector<Index>>, traffic, Mix::copy});
}

}  // namespace hedgerow::bench
