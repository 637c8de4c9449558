#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "hedgerow/circulate.h"
#include "hedgerow/dirty_normals.h"
#include "report/stages.h"

namespace hedgerow::tool {
namespace {

/// About a hundredth of the vertices, round the first one on a face: what a brush moves.
std::vector<Index> find_blob(const Connectivity& mesh) {
  const auto wanted = static_cast<std::size_t>(mesh.vertex_count() / 100 + 1);
  std::vector<bool> is_met(static_cast<std::size_t>(mesh.vertex_count()));
  std::vector<Index> blob;
  const auto meet = [&](Index v) {
    if (blob.size() == wanted || is_met[static_cast<std::size_t>(v)]) return;
    is_met[static_cast<std::size_t>(v)] = true;
    blob.push_back(v);
  };
  for (const Index v : mesh.origin().first(std::min<std::size_t>(1, mesh.origin().size()))) meet(v);
  mesh.visit([&](const auto& view) {
    for (std::size_t done = 0; done < blob.size(); ++done) {
      for (const VertexId u : neighbours(view, VertexId(blob[done]))) meet(u.value);
    }
  });
  return blob;
}

}  // namespace

void measure_dirty_normals(Stages& stages, const Subject& subject) {
  const std::vector<Index> blob = find_blob(subject.mesh);
  if (blob.empty()) return;
  Buffer<float> xyz = Buffer<float>::copy_of(subject.soup.xyz.span());
  const Positions positions{xyz.data(), subject.vertices()};
  Buffer<float> normals(xyz.size());
  const NormalsOut out{normals.data(), subject.vertices()};
  Workspace workspace;
  (void)gather_vertex_normals(subject.mesh, positions, out, {}, Execution::serial(), workspace);
  for (const Index v : blob) xyz[3 * static_cast<std::size_t>(v)] *= 1.01F;
  Buffer<float> expected(xyz.size());
  (void)gather_vertex_normals(subject.mesh, positions, {expected.data(), subject.vertices()}, {},
                              Execution::serial(), workspace);

  DirtySet dirty(subject.mesh);
  const auto work = [&](const Execution& execution) {
    return dirty.find(subject.mesh, MovedVertices::list(blob)) &&
           update_vertex_normals(subject.mesh, positions, out, {}, dirty, execution, workspace);
  };
  (void)work(Execution::serial());
  const auto touched = static_cast<std::int64_t>(dirty.is_all() ? subject.mesh.outgoing().size()
                                                                : dirty.vertices().size());
  Stage stage{.name = "dirty_normals", .variant = "1% moved"};
  stage.elements = touched;
  stage.unit = "dirty vertex";
  // Each dirty vertex: its half-edge, six half-edges round it and back, as many corners and
  // positions, and its normal.
  stage.bytes = touched * static_cast<std::int64_t>(sizeof(Index) * 13 + 2 * sizeof(float[3]));
  stage.mix = Mix::triad;
  stages.measure(
      std::move(stage),
      [&](const Execution& execution) {
        return work(execution) &&
               std::memcmp(normals.data(), expected.data(), normals.size_bytes()) == 0;
      },
      [&](const Execution& execution) { (void)work(execution); });
}

}  // namespace hedgerow::tool
