#include <algorithm>
#include <set>

#include "support/numbers.h"
#include "support/reference_mesh.h"

namespace hedgerow::test {

namespace {

// Cycles of boundary edges of a manifold mesh, where one such edge leads on from each vertex.
std::int64_t count_loops(const ReferenceMesh& mesh, const EdgeMap& edges) {
  std::map<Index, Index> target_of;
  for (const auto& [ends, halfedges] : edges) {
    if (halfedges.size() != 1) continue;
    const Index h = halfedges[0];
    target_of[mesh.origin[at(h)]] = mesh.origin[at(mesh.next[at(h)])];
  }
  std::int64_t loops = 0;
  while (!target_of.empty()) {
    ++loops;
    for (auto v = target_of.begin(); v != target_of.end();) {
      const Index target = v->second;
      target_of.erase(v);
      v = target_of.find(target);
    }
  }
  return loops;
}

}  // namespace

std::vector<Index> reference_components(const ReferenceMesh& mesh) {
  std::map<Index, std::set<Index>> neighbours;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    const Index a = mesh.origin[at(h)];
    const Index b = mesh.origin[at(mesh.next[at(h)])];
    neighbours[a].insert(b);
    neighbours[b].insert(a);
  }
  std::vector<Index> labels(at(mesh.vertex_count()), kInvalidIndex);
  for (const auto& [seed, unused] : neighbours) {
    if (labels[at(seed)] != kInvalidIndex) continue;
    std::vector<Index> todo = {seed};
    while (!todo.empty()) {
      const Index v = todo.back();
      todo.pop_back();
      if (labels[at(v)] != kInvalidIndex) continue;
      labels[at(v)] = seed;
      todo.insert(todo.end(), neighbours[v].begin(), neighbours[v].end());
    }
  }
  return labels;
}

ReferenceSummary reference_summary(const ReferenceMesh& mesh) {
  ReferenceSummary s;
  const EdgeMap edges = edges_of(mesh);
  std::map<Index, std::int64_t> valence;
  for (const auto& [ends, halfedges] : edges) {
    const bool same_way =
        halfedges.size() == 2 && mesh.origin[at(halfedges[0])] == mesh.origin[at(halfedges[1])];
    ++s.edges;
    s.boundary_edges += halfedges.size() == 1;
    s.nonmanifold_edges += halfedges.size() > 2;
    s.inconsistent_edges += same_way;
    ++valence[ends.first];
    ++valence[ends.second];
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    std::set<Index> groups;
    for (const auto& [face, group] : groups_at(mesh, edges, v)) groups.insert(group);
    s.isolated_vertices += groups.empty();
    s.nonmanifold_vertices += groups.size() > 1;
  }
  std::set<std::set<Index>> vertex_sets;
  for (const auto& corners : mesh.faces()) {
    s.duplicate_faces += !vertex_sets.insert({corners.begin(), corners.end()}).second;
  }
  std::set<Index> labels;
  for (const Index label : reference_components(mesh)) {
    if (label != kInvalidIndex) labels.insert(label);
  }
  s.components = static_cast<std::int64_t>(labels.size());
  s.euler = mesh.vertex_count() - s.isolated_vertices - s.edges + mesh.face_count();
  if (s.nonmanifold_edges + s.inconsistent_edges + s.nonmanifold_vertices == 0) {
    s.boundary_loops = count_loops(mesh, edges);
    s.genus = (2 * s.components - *s.boundary_loops - s.euler) / 2;
  }
  if (!valence.empty()) s.valence_min = valence.begin()->second;
  for (const auto& [v, k] : valence) {
    s.valence_min = std::min(s.valence_min, k);
    s.valence_max = std::max(s.valence_max, k);
  }
  return s;
}

}  // namespace hedgerow::test
