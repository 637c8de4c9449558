#include "query/edges.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "hedgerow/query.h"
#include "parallel/parallel.h"

namespace hedgerow::detail {

namespace {

constexpr Index kEdgeGrain = 1 << 16;  // half-edges a task

template <Topology Mesh>
bool is_side(const Mesh& mesh, HalfedgeId h) noexcept {
  return mesh.face(h).valid();
}

// A half-edge of a face that has no face across its edge.
template <Topology Mesh>
bool is_unpaired(const Mesh& mesh, HalfedgeId h) noexcept {
  if (!is_side(mesh, h)) return false;
  const HalfedgeId opposite = mesh.opposite[h];
  return !opposite.valid() || !is_side(mesh, opposite);
}

template <Topology Mesh>
EdgeEnds ends_of(const Mesh& mesh, HalfedgeId h) noexcept {
  const Index a = mesh.origin[h].value;
  const Index b = mesh.target(h).value;
  return {std::min(a, b), std::max(a, b)};
}

struct Side {
  EdgeEnds ends;
  bool runs_up = false;  // from the smaller vertex to the larger

  friend bool operator<(const Side& a, const Side& b) noexcept { return a.ends < b.ends; }
};

template <Topology Mesh>
std::vector<Side> unpaired_sides(const Mesh& mesh, const Execution& execution) {
  const Index chunk_count = (mesh.halfedge_count() + kEdgeGrain - 1) / kEdgeGrain;
  std::vector<std::vector<Side>> found(static_cast<std::size_t>(chunk_count));
  par::for_each_task(execution, chunk_count, [&](Index chunk, Index) {
    auto& sides = found[static_cast<std::size_t>(chunk)];
    const Index end = std::min(mesh.halfedge_count(), (chunk + 1) * kEdgeGrain);
    for (Index i = chunk * kEdgeGrain; i < end; ++i) {
      const HalfedgeId h(i);
      if (!is_unpaired(mesh, h)) continue;
      const EdgeEnds ends = ends_of(mesh, h);
      sides.push_back({ends, mesh.origin[h].value == ends.a});
    }
  });
  std::vector<Side> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  return all;
}

// Runs of equal ends become edges.
std::vector<LooseEdge> gather_edges(const std::vector<Side>& sides) {
  std::vector<LooseEdge> edges;
  for (const Side& side : sides) {
    if (edges.empty() || !(edges.back().ends == side.ends)) edges.push_back({side.ends, 0, 0});
    ++(side.runs_up ? edges.back().up_count : edges.back().down_count);
  }
  return edges;
}

}  // namespace

template <Topology Mesh>
EdgeSurvey survey_edges(const Mesh& mesh, const Execution& execution) {
  EdgeSurvey survey;
  survey.loose = gather_edges(unpaired_sides(mesh, execution));
  // A pair may share its vertices with half-edges that were cut from pairing. Only where both ends
  // lie on a loose edge is it worth a search.
  std::vector<std::uint8_t> is_end(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (const LooseEdge& edge : survey.loose) {
    is_end[static_cast<std::size_t>(edge.ends.a)] = 1;
    is_end[static_cast<std::size_t>(edge.ends.b)] = 1;
  }
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    const HalfedgeId h(i);
    if (!is_side(mesh, h) || is_unpaired(mesh, h) || mesh.opposite[h] < h) continue;
    ++survey.pair_count;
    const EdgeEnds ends = ends_of(mesh, h);
    if (is_end[static_cast<std::size_t>(ends.a)] == 0) continue;
    if (is_end[static_cast<std::size_t>(ends.b)] == 0) continue;
    const auto edge =
        std::lower_bound(survey.loose.begin(), survey.loose.end(), ends,
                         [](const LooseEdge& e, const EdgeEnds& key) { return e.ends < key; });
    if (edge == survey.loose.end() || !(edge->ends == ends)) continue;
    ++edge->up_count;
    ++edge->down_count;
    --survey.pair_count;
  }
  return survey;
}

EdgeCounts counts_of(const EdgeSurvey& survey) noexcept {
  EdgeCounts counts;
  counts.edges = survey.pair_count + static_cast<std::int64_t>(survey.loose.size());
  for (const LooseEdge& edge : survey.loose) {
    counts.boundary += edge.halfedge_count() == 1;
    counts.nonmanifold += edge.halfedge_count() > 2;
    counts.inconsistent += edge.halfedge_count() == 2 && edge.up_count != 1;
  }
  return counts;
}

template EdgeSurvey survey_edges(const TriangleView& mesh, const Execution& execution);
template EdgeSurvey survey_edges(const PolygonView& mesh, const Execution& execution);

}  // namespace hedgerow::detail
