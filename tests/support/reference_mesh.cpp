#include "support/reference_mesh.h"

#include <algorithm>
#include <set>

#include "support/numbers.h"

namespace hedgerow::test {

namespace {

// Faces, half-edges and their cycles: everything that needs no neighbour.
ReferenceMesh with_faces(const std::vector<std::vector<Index>>& faces, Index vertex_count) {
  ReferenceMesh mesh;
  mesh.outgoing.assign(at(vertex_count), kInvalidIndex);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Index begin = mesh.halfedge_count();
    const auto degree = static_cast<Index>(faces[f].size());
    mesh.first.push_back(begin);
    for (Index k = 0; k < degree; ++k) {
      mesh.origin.push_back(faces[f][at(k)]);
      mesh.next.push_back(begin + (k + 1) % degree);
      mesh.prev.push_back(begin + (k + degree - 1) % degree);
      mesh.face.push_back(static_cast<Index>(f));
      mesh.opposite.push_back(kInvalidIndex);
    }
  }
  mesh.first.push_back(mesh.halfedge_count());
  return mesh;
}

void pair_edges(ReferenceMesh& mesh, const std::vector<bool>& is_cut) {
  for (const auto& [ends, halfedges] : edges_of(mesh)) {
    std::vector<Index> uncut;
    for (const Index h : halfedges) {
      if (is_cut.empty() || !is_cut[at(mesh.face[at(h)])]) uncut.push_back(h);
    }
    if (uncut.size() != 2 || mesh.origin[at(uncut[0])] == mesh.origin[at(uncut[1])]) continue;
    mesh.opposite[at(uncut[0])] = uncut[1];
    mesh.opposite[at(uncut[1])] = uncut[0];
  }
}

void find_fans(ReferenceMesh& mesh) {
  std::map<Index, std::set<Index>> leaving;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) leaving[mesh.origin[at(h)]].insert(h);
  for (auto& [v, halfedges] : leaving) {
    while (!halfedges.empty()) {
      const Index smallest = *halfedges.begin();
      Index start = smallest;
      while (true) {
        const Index before = mesh.opposite[at(mesh.prev[at(start)])];
        if (before == kInvalidIndex) break;
        start = before;
        if (start == smallest) break;
      }
      Index h = start;
      do {
        halfedges.erase(h);
        const Index opposite = mesh.opposite[at(h)];
        h = opposite == kInvalidIndex ? start : mesh.next[at(opposite)];
      } while (h != start);
      if (mesh.outgoing[at(v)] == kInvalidIndex) {
        mesh.outgoing[at(v)] = start;
      } else {
        mesh.fans.push_back({VertexId(v), HalfedgeId(start)});
      }
    }
  }
}

Buffer<Index> to_buffer(const std::vector<Index>& values) { return Buffer<Index>::copy_of(values); }

}  // namespace

bool ReferenceMesh::is_all_triangles() const {
  for (std::size_t f = 0; f + 1 < first.size(); ++f) {
    if (std::int64_t{first[f + 1]} - first[f] != 3) return false;
  }
  return true;
}

std::vector<std::vector<Index>> ReferenceMesh::faces() const {
  std::vector<std::vector<Index>> result;
  for (std::size_t f = 0; f + 1 < first.size(); ++f) {
    result.emplace_back(origin.begin() + first[f], origin.begin() + first[f + 1]);
  }
  return result;
}

std::vector<Index> ReferenceMesh::fan_starts(Index v) const {
  std::vector<Index> starts;
  if (outgoing[at(v)] != kInvalidIndex) starts.push_back(outgoing[at(v)]);
  for (const FanStart& fan : fans) {
    if (fan.vertex == VertexId(v)) starts.push_back(fan.start.value);
  }
  return starts;
}

EdgeMap edges_of(const ReferenceMesh& mesh) {
  EdgeMap edges;
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.face[at(h)] == kInvalidIndex) continue;
    const Index a = mesh.origin[at(h)];
    const Index b = mesh.origin[at(mesh.next[at(h)])];
    edges[std::minmax(a, b)].push_back(h);
  }
  return edges;
}

std::map<Index, Index> groups_at(const ReferenceMesh& mesh, const EdgeMap& edges, Index v) {
  std::map<Index, Index> group_of;  // by face
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.face[at(h)] != kInvalidIndex && mesh.origin[at(h)] == v) {
      group_of[mesh.face[at(h)]] = h;
    }
  }
  for (const auto& [ends, halfedges] : edges) {
    if (ends.first != v && ends.second != v) continue;
    for (const Index h : halfedges) {
      const Index a = group_of[mesh.face[at(halfedges[0])]];
      const Index b = group_of[mesh.face[at(h)]];
      for (auto& [face, group] : group_of) {
        if (group == std::max(a, b)) group = std::min(a, b);
      }
    }
  }
  return group_of;
}

ReferenceMesh reference_mesh(const std::vector<std::vector<Index>>& faces, Index vertex_count,
                             const std::vector<bool>& is_cut) {
  ReferenceMesh mesh = with_faces(faces, vertex_count);
  pair_edges(mesh, is_cut);
  find_fans(mesh);
  return mesh;
}

ReferenceMesh reference_closed(const ReferenceMesh& mesh) {
  ReferenceMesh closed = mesh;
  closed.form = Form::closed;
  // Behind a half-edge h without opposite, the hole goes on along the half-edge that enters the
  // same fan at its open end.
  const auto next_round_hole = [&](Index h) {
    while (mesh.opposite[at(mesh.prev[at(h)])] != kInvalidIndex) {
      h = mesh.opposite[at(mesh.prev[at(h)])];
    }
    return mesh.prev[at(h)];
  };
  for (Index h = 0; h < mesh.halfedge_count(); ++h) {
    if (closed.opposite[at(h)] != kInvalidIndex) continue;
    const Index begin = closed.halfedge_count();
    for (Index g = h; closed.opposite[at(g)] == kInvalidIndex; g = next_round_hole(g)) {
      const Index b = closed.halfedge_count();
      closed.opposite[at(g)] = b;
      closed.origin.push_back(mesh.origin[at(mesh.next[at(g)])]);
      closed.opposite.push_back(g);
      closed.face.push_back(kInvalidIndex);
      closed.next.push_back(b + 1);
      closed.prev.push_back(b - 1);
    }
    closed.next.back() = begin;
    closed.prev[at(begin)] = closed.halfedge_count() - 1;
  }
  const auto start_on_boundary = [&](Index start) {
    const Index before = closed.opposite[at(mesh.prev[at(start)])];
    return before < mesh.halfedge_count() ? start : before;
  };
  for (Index& start : closed.outgoing) {
    if (start != kInvalidIndex) start = start_on_boundary(start);
  }
  for (FanStart& fan : closed.fans) fan.start = HalfedgeId(start_on_boundary(fan.start.value));
  return closed;
}

ConnectivityColumns to_columns(const ReferenceMesh& mesh, bool store_all) {
  ConnectivityColumns columns;
  columns.all_triangles = mesh.is_all_triangles();
  columns.form = mesh.form;
  columns.origin = to_buffer(mesh.origin);
  columns.opposite = to_buffer(mesh.opposite);
  columns.outgoing = to_buffer(mesh.outgoing);
  columns.fans = Buffer<FanStart>::copy_of(mesh.fans);
  if (store_all || !columns.all_triangles || mesh.form == Form::closed) {
    columns.next = to_buffer(mesh.next);
    columns.face = to_buffer(mesh.face);
    columns.first = to_buffer(mesh.first);
  }
  return columns;
}

Connectivity to_connectivity(const ReferenceMesh& mesh, bool store_all) {
  return Connectivity(to_columns(mesh, store_all));
}

}  // namespace hedgerow::test
