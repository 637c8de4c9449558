#include "hedgerow/query.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "at.h"
#include "build/duplicate_faces.h"
#include "float3_check.h"
#include "kernels/find_boundary.h"
#include "kernels/join_sets.h"
#include "kernels/scatter_valences.h"
#include "parallel/parallel.h"
#include "query/edges.h"

namespace hedgerow {

namespace {

constexpr Index kQueryGrain = 1 << 14;  // vertices or faces a task
// Half-edges that are worth a thread's array of all vertices.
constexpr Index kValenceShare = 1 << 18;

kernels::FaceColumns face_columns(const Connectivity& mesh) noexcept {
  const Index* first = mesh.is_triangle_mesh() ? nullptr : mesh.polygons().first_of.data();
  return {mesh.origin().data(), first, mesh.face_count(), mesh.vertex_count()};
}

// The half-edges that loops consist of, in ascending order: those without opposite, or, in the
// closed form, all that are on no face, which stand behind those that are.
template <Topology Mesh>
Index next_on_loop(Index from, const Mesh& mesh, bool is_closed_form) noexcept {
  if (!is_closed_form) {
    return kernels::find_boundary({from, mesh.halfedge_count()}, mesh.opposite.data());
  }
  const Index side_count = mesh.face_count() == 0 ? 0 : mesh.first(FaceId(mesh.face_count())).value;
  return std::max(from, side_count);
}

template <Topology Mesh>
BoundaryLoops find_loops(const Mesh& mesh, bool is_closed_form) {
  std::vector<bool> seen(at(mesh.halfedge_count()), false);
  std::vector<Index> first = {0};
  std::vector<Index> halfedges;
  for (Index i = next_on_loop(0, mesh, is_closed_form); i < mesh.halfedge_count();
       i = next_on_loop(i + 1, mesh, is_closed_form)) {
    if (seen[at(i)]) continue;
    for (const HalfedgeId h : boundary_loop(mesh, HalfedgeId(i))) {
      seen[at(h.value)] = true;
      halfedges.push_back(h.value);
    }
    first.push_back(static_cast<Index>(halfedges.size()));
  }
  return {Buffer<Index>::copy_of(first), Buffer<Index>::copy_of(halfedges)};
}

// The fans of `v` are joined where they meet the same neighbour.
template <Topology Mesh>
Index count_groups(const Mesh& mesh, VertexId v, Index fan_count) {
  std::vector<std::pair<Index, Index>> spokes;  // neighbour, fan
  Index fan = -1;
  const auto is_start = [&](HalfedgeId h) {
    if (h == mesh.outgoing[v]) return true;
    const FanTable others = extra_fans(mesh.fans, v).subspan(at(fan));
    return !others.empty() && others.front().start == h;
  };
  for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
    if (is_start(h)) ++fan;
    spokes.emplace_back(mesh.target(h).value, fan);
    // Both edges of the corner; in the closed form the second comes up by itself.
    if (mesh.face(h).valid()) spokes.emplace_back(mesh.origin[mesh.prev(h)].value, fan);
  }
  std::sort(spokes.begin(), spokes.end());
  Buffer<Index> sets(at(fan_count));
  kernels::fill_singletons({0, fan_count}, sets.data());
  for (std::size_t i = 1; i < spokes.size(); ++i) {
    if (spokes[i].first != spokes[i - 1].first) continue;
    kernels::join_sets(sets.data(), spokes[i].second, spokes[i - 1].second);
  }
  Index groups = 0;
  for (Index i = 0; i < fan_count; ++i) groups += sets[at(i)] == i;
  return groups;
}

template <Topology Mesh>
std::int64_t count_bowties(const Mesh& mesh) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < mesh.fans.size();) {
    const VertexId v = mesh.fans[i].vertex;
    const std::size_t begin = i;
    while (i < mesh.fans.size() && mesh.fans[i].vertex == v) ++i;
    count += count_groups(mesh, v, static_cast<Index>(i - begin) + 1) > 1;
  }
  return count;
}

struct VertexCounts {
  std::int64_t isolated = 0;
  Index min_valence = std::numeric_limits<Index>::max();
  Index max_valence = 0;

  friend VertexCounts operator+(const VertexCounts& a, const VertexCounts& b) noexcept {
    return {a.isolated + b.isolated, std::min(a.min_valence, b.min_valence),
            std::max(a.max_valence, b.max_valence)};
  }
};

// Neighbours of a vertex at the end of an edge that several half-edges were left unpaired on.
template <Topology Mesh>
Index distinct_valence(const Mesh& mesh, VertexId v) {
  std::vector<Index> found;
  for (const VertexId u : neighbours(mesh, v)) found.push_back(u.value);
  std::sort(found.begin(), found.end());
  return static_cast<Index>(std::unique(found.begin(), found.end()) - found.begin());
}

// Each thread counts at the ends of its share of the half-edges.
template <Topology Mesh>
Buffer<Index> count_neighbours(const Mesh& mesh, const Execution& execution) {
  const Index share_count = par::share_count(execution, mesh.halfedge_count(), kValenceShare);
  std::vector<Buffer<Index>> counts;
  for (Index i = 0; i < share_count; ++i) counts.emplace_back(at(mesh.vertex_count()));
  par::for_each_task(execution, share_count, [&](Index share, Index) {
    Buffer<Index>& count = counts[at(share)];
    std::fill(count.begin(), count.end(), Index{0});
    const IndexRange halfedges = par::share_of(share, share_count, mesh.halfedge_count());
    kernels::scatter_valences(halfedges, mesh, count.data());
  });
  par::for_each_range(execution, mesh.vertex_count(), kQueryGrain, [&](IndexRange range) {
    for (Index i = 1; i < share_count; ++i) {
      kernels::gather_valences(range, counts[at(i)].data(), counts[0].data());
    }
  });
  return std::move(counts[0]);
}

template <Topology Mesh>
VertexCounts count_vertices(const Mesh& mesh, const detail::EdgeSurvey& edges,
                            const Execution& execution) {
  std::vector<std::uint8_t> may_repeat(at(mesh.vertex_count()), 0);
  for (const detail::LooseEdge& edge : edges.loose) {
    if (edge.halfedge_count() < 2) continue;
    may_repeat[at(edge.ends.a)] = may_repeat[at(edge.ends.b)] = 1;
  }
  const Buffer<Index> valences = count_neighbours(mesh, execution);
  return par::reduce<VertexCounts>(
      execution, mesh.vertex_count(), kQueryGrain,
      [&](IndexRange range) {
        VertexCounts counts;
        for (Index i = range.begin; i < range.end; ++i) {
          const VertexId v(i);
          if (incident_faces(mesh, v).empty()) {
            ++counts.isolated;
            continue;
          }
          const Index k = may_repeat[at(i)] != 0 ? distinct_valence(mesh, v) : valences[at(i)];
          counts.min_valence = std::min(counts.min_valence, k);
          counts.max_valence = std::max(counts.max_valence, k);
        }
        return counts;
      },
      [](const VertexCounts& a, const VertexCounts& b) { return a + b; });
}

template <Topology Mesh>
void count_faces(const Mesh& mesh, Summary& summary) noexcept {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Index degree = mesh.degree(FaceId(f));
    summary.halfedges += degree;
    ++(degree == 3 ? summary.triangles : degree == 4 ? summary.quads : summary.polygons);
  }
}

Summary count_all_but_duplicates(const Connectivity& mesh, const Execution& execution) {
  Summary s;
  s.vertices = mesh.vertex_count();
  s.faces = mesh.face_count();
  const VertexCounts vertices = mesh.visit([&](const auto& view) {
    count_faces(view, s);
    const detail::EdgeSurvey edges = detail::survey_edges(view, execution);
    s.edge_counts = detail::counts_of(edges);
    s.nonmanifold_vertices = count_bowties(view);
    return count_vertices(view, edges, execution);
  });
  s.isolated_vertices = vertices.isolated;
  s.components = connected_components(mesh, execution).count;
  const std::int64_t used = s.vertices - s.isolated_vertices;
  s.euler = used - s.edge_counts.edges + s.faces;
  if (s.is_manifold() && s.is_oriented()) {
    s.boundary_loops = boundary_loops(mesh).count();
    s.genus = (2 * s.components - *s.boundary_loops - s.euler) / 2;
  }
  if (used > 0) {
    s.valence = Valence{vertices.min_valence, vertices.max_valence,
                        2.0 * static_cast<double>(s.edge_counts.edges) / static_cast<double>(used)};
  }
  return s;
}

// Newell's sum as it is usually written, with no shift: exact zero is what is asked for.
template <Topology Mesh>
bool has_zero_area(const Mesh& mesh, FaceId f, Positions positions) noexcept {
  double x = 0;
  double y = 0;
  double z = 0;
  for (const HalfedgeId h : halfedges(mesh, f)) {
    const float* p = positions[mesh.origin[h].value];
    const float* q = positions[mesh.target(h).value];
    const double px = p[0], py = p[1], pz = p[2];
    const double qx = q[0], qy = q[1], qz = q[2];
    x += (py - qy) * (pz + qz);
    y += (pz - qz) * (px + qx);
    z += (px - qx) * (py + qy);
  }
  return x == 0 && y == 0 && z == 0;
}

}  // namespace

BoundaryLoops boundary_loops(const Connectivity& mesh) {
  return mesh.visit(
      [&](const auto& view) { return find_loops(view, mesh.form() == Form::closed); });
}

EdgeCounts count_edges(const Connectivity& mesh, const Execution& execution) {
  return mesh.visit(
      [&](const auto& view) { return detail::counts_of(detail::survey_edges(view, execution)); });
}

std::int64_t count_nonmanifold_vertices(const Connectivity& mesh) {
  return mesh.visit([](const auto& view) { return count_bowties(view); });
}

Summary summarise(const Connectivity& mesh, const Execution& execution) {
  Summary s = count_all_but_duplicates(mesh, execution);
  s.duplicate_faces =
      static_cast<std::int64_t>(detail::find_duplicate_faces(face_columns(mesh), execution).size());
  return s;
}

std::int64_t euler_characteristic(const Connectivity& mesh, const Execution& execution) {
  return count_all_but_duplicates(mesh, execution).euler;
}

std::optional<std::int64_t> genus(const Connectivity& mesh, const Execution& execution) {
  return count_all_but_duplicates(mesh, execution).genus;
}

std::int64_t count_degenerate_faces(const BuildStats& stats, const Policies& policies) noexcept {
  std::int64_t count = 0;
  for (const DefectKind kind : {DefectKind::too_few_corners, DefectKind::repeated_vertex}) {
    if (policies[kind] == Action::skip) count += stats.defect_count[static_cast<std::size_t>(kind)];
  }
  return count;
}

Result<std::int64_t> count_zero_area_faces(const Connectivity& mesh, Positions positions,
                                           const Execution& execution) {
  if (auto ok = detail::check_float3(positions, mesh.vertex_count()); !ok) return fail(ok.error());
  return mesh.visit([&](const auto& view) {
    return par::reduce<std::int64_t>(
        execution, view.face_count(), kQueryGrain,
        [&](IndexRange range) {
          std::int64_t count = 0;
          for (Index f = range.begin; f < range.end; ++f) {
            count += has_zero_area(view, FaceId(f), positions);
          }
          return count;
        },
        [](std::int64_t a, std::int64_t b) { return a + b; });
  });
}

}  // namespace hedgerow
