#include <algorithm>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "hedgerow/query.h"
#include "hedgerow/topology.h"
#include "report/stages.h"
#include "report/timing.h"

namespace hedgerow::tool {
namespace {

/// Writes the elements of `sums` in `range`, and only these; reads the mesh.
template <Topology Mesh>
void gather_ring_sums(const Mesh& mesh, IndexRange range, std::span<std::uint32_t> sums) {
  for (Index v = range.begin; v < range.end; ++v) {
    std::uint32_t sum = 0;
    for (const VertexId u : neighbours(mesh, VertexId(v))) {
      sum += static_cast<std::uint32_t>(u.value);
    }
    sums[static_cast<std::size_t>(v)] = sum;
  }
}

template <Topology Mesh>
void gather_ring_sums(const Mesh& mesh, std::span<std::uint32_t> sums, Run& run,
                      const Execution& execution) {
  const Index count = mesh.vertex_count();
  if (execution.threads() == 1) {
    gather_ring_sums(mesh, {0, count}, sums);
    return;
  }
  run.in_arena([&] {
    tbb::parallel_for(tbb::blocked_range<Index>(0, count, 4096),
                      [&](const tbb::blocked_range<Index>& range) {
                        gather_ring_sums(mesh, {range.begin(), range.end()}, sums);
                      });
  });
}

}  // namespace

void measure_one_ring(Stages& stages, const Subject& subject) {
  const std::vector<std::uint32_t> expected = subject.reference.neighbour_sums();
  std::vector<std::uint32_t> sums(expected.size());
  Stage stage{.name = "one_ring"};
  stage.elements = subject.vertices();
  stage.unit = "vertex";
  stage.mix = Mix::read;
  stages.run().progress().step("one_ring, the other meshes");
  stage.pointer_ms = time_median([&] { subject.pointer.fill_one_ring_sums(sums); }).ms;
  stage.aos_ms = time_median([&] { subject.structs.fill_one_ring_sums(sums); }).ms;
  const auto sum_bytes = static_cast<std::int64_t>(sizeof(std::uint32_t)) * subject.vertices();
  const auto measure = [&](const auto& view, const char* variant, std::int64_t columns_bytes) {
    stage.variant = variant;
    stage.bytes = columns_bytes + sum_bytes;
    const auto work = [&](const Execution& execution) {
      gather_ring_sums(view, sums, stages.run(), execution);
    };
    stages.measure(
        stage,
        [&](const Execution& execution) {
          std::ranges::fill(sums, 0u);
          work(execution);
          return sums == expected;
        },
        work);
  };
  const std::int64_t implicit_bytes = kIndexBytes * (2 * subject.halfedges() + subject.vertices());
  if (subject.mesh.is_implicit()) measure(subject.mesh.triangles(), "implicit", implicit_bytes);
  // `next` for every step; the face and its first half-edge for the one `prev` of each vertex.
  measure(subject.explicit_mesh.polygons(), "explicit",
          implicit_bytes + kIndexBytes * (subject.halfedges() + 2 * subject.vertices()));
}

void measure_boundary_loops(Stages& stages, const Subject& subject) {
  const std::int64_t expected = subject.reference.boundary_loop_count();
  Stage stage{.name = "boundary_loops"};
  stage.variant = subject.mesh.is_implicit() ? "implicit" : "explicit";
  stage.elements = subject.halfedges();
  stage.unit = "half-edge";
  stage.bytes = kIndexBytes * subject.halfedges();
  stage.mix = Mix::read;
  stages.run().progress().step("boundary_loops, the other meshes");
  std::int64_t count = 0;
  stage.pointer_ms = time_median([&] { count += subject.pointer.boundary_loop_count(); }).ms;
  stage.aos_ms = time_median([&] { count += subject.structs.boundary_loop_count(); }).ms;
  const auto is_whole = [&](const BoundaryLoops& loops) {
    const auto boundary = std::ranges::count(subject.reference.opposites(), kInvalidIndex);
    return loops.count() == expected && std::ssize(loops.halfedges.span()) == boundary;
  };
  stages.measure_serial(
      std::move(stage), [&](const Execution&) { return is_whole(boundary_loops(subject.mesh)); },
      [&](const Execution&) { count += boundary_loops(subject.mesh).count(); });
}

void measure_components(Stages& stages, const Subject& subject) {
  const std::int64_t expected = subject.reference.component_count();
  Stage stage{.name = "components"};
  stage.elements = subject.vertices();
  stage.unit = "vertex";
  // One column read, a label a vertex read and written.
  stage.bytes = kIndexBytes * (subject.halfedges() + 2 * subject.vertices());
  stage.mix = Mix::read;
  stages.run().progress().step("components, the other meshes");
  std::int64_t count = 0;
  stage.pointer_ms = time_median([&] { count += subject.pointer.component_count(); }).ms;
  stage.aos_ms = time_median([&] { count += subject.structs.component_count(); }).ms;
  stages.measure(
      std::move(stage),
      [&](const Execution& execution) {
        return connected_components(subject.mesh, execution).count == expected;
      },
      [&](const Execution& execution) {
        count += connected_components(subject.mesh, execution).count;
      });
}

}  // namespace hedgerow::tool
