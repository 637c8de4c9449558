#include <algorithm>
#include <array>
#include <utility>

#include "hedgerow/reorder.h"
#include "hedgerow/validate.h"
#include "report/stages.h"

namespace hedgerow::tool {
namespace {

constexpr std::array<std::pair<ReorderMethod, const char*>, 5> kMethods = {
    {{ReorderMethod::hilbert, "hilbert"},
     {ReorderMethod::morton, "morton"},
     {ReorderMethod::breadth_first, "bfs"},
     {ReorderMethod::vertex_cache, "vertex-cache"},
     {ReorderMethod::fronts, "fronts"}}};

bool is_permutation_of(const Buffer<Index>& numbers, Index count) {
  std::vector<bool> is_seen(static_cast<std::size_t>(count), false);
  if (numbers.size() != is_seen.size()) return false;
  for (const Index number : numbers) {
    if (number < 0 || number >= count || is_seen[static_cast<std::size_t>(number)]) return false;
    is_seen[static_cast<std::size_t>(number)] = true;
  }
  return true;
}

/// True if `output` is the old mesh under its permutations: every new half-edge leaves the vertex
/// that its old number left, and faces the same half-edge across its edge.
bool is_same_mesh(const Connectivity& before, const ReorderOutput& output) {
  const Reordering& order = output.reordering;
  if (!is_permutation_of(order.vertices_new_to_old, before.vertex_count()) ||
      !is_permutation_of(order.faces_new_to_old, before.face_count()) ||
      !is_permutation_of(order.halfedges_new_to_old, before.halfedge_count())) {
    return false;
  }
  const auto old_of = [](const Buffer<Index>& new_to_old, Index i) {
    return i == kInvalidIndex ? i : new_to_old[static_cast<std::size_t>(i)];
  };
  for (std::size_t h = 0; h < order.halfedges_new_to_old.size(); ++h) {
    const auto old = static_cast<std::size_t>(order.halfedges_new_to_old[h]);
    if (old_of(order.vertices_new_to_old, output.mesh.origin()[h]) != before.origin()[old] ||
        old_of(order.halfedges_new_to_old, output.mesh.opposite()[h]) != before.opposite()[old]) {
      return false;
    }
  }
  return true;
}

}  // namespace

void measure_reorder(Stages& stages, const Subject& subject) {
  for (const auto& [method, word] : kMethods) {
    Stage stage{.name = "reorder", .variant = word};
    stage.elements = subject.halfedges();
    stage.unit = "half-edge";
    // Every column in and out, positions in, four permutations out.
    stage.bytes = 2 * static_cast<std::int64_t>(subject.mesh.bytes()) +
                  static_cast<std::int64_t>(subject.soup.xyz.size_bytes()) +
                  kIndexBytes * (2 * subject.vertices() + subject.faces() + subject.halfedges());
    stage.mix = Mix::copy;
    const auto work = [&, method = method](const Execution& execution) {
      return reorder(subject.mesh, subject.soup.positions(), method, execution);
    };
    stages.measure(
        std::move(stage),
        [&](const Execution& execution) {
          const Result<ReorderOutput> output = work(execution);
          return output && is_same_mesh(subject.mesh, *output) &&
                 validate(output->mesh, execution).empty();
        },
        [&](const Execution& execution) { const Result<ReorderOutput> output = work(execution); });
  }
}

}  // namespace hedgerow::tool
