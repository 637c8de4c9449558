#include "build/repair.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "at.h"
#include "build/corner_source.h"

namespace hedgerow::detail {

namespace {

// Steps round a face or a vertex on columns that are not a `Connectivity` yet.
struct Walker {
  const kernels::FaceColumns& faces;
  const PairOutput& paired;

  [[nodiscard]] Index next(Index h) const noexcept {
    const Index f = face_of(faces, HalfedgeId(h)).value;
    return h + 1 < faces.begin(f) + faces.degree(f) ? h + 1 : faces.begin(f);
  }
  [[nodiscard]] Index prev(Index h) const noexcept {
    const Index f = face_of(faces, HalfedgeId(h)).value;
    return h > faces.begin(f) ? h - 1 : faces.begin(f) + faces.degree(f) - 1;
  }
  template <class Visit>
  void for_each_in_fan(HalfedgeId start, const Visit& visit) const {
    Index h = start.value;
    do {
      visit(h);
      const Index opposite = paired.opposite[at(h)];
      if (opposite == kInvalidIndex) return;
      h = next(opposite);
    } while (h != start.value);
  }
  [[nodiscard]] std::vector<HalfedgeId> fans_of(VertexId v) const {
    std::vector<HalfedgeId> starts = {HalfedgeId(paired.outgoing[at(v.value)])};
    for (const FanStart& fan : extra_fans(paired.fans, v)) starts.push_back(fan.start);
    return starts;
  }
};

// What is still to come on one bad edge, as its half-edges pass in ascending order.
struct EdgeState {
  std::pair<Index, Index> ends;
  bool keeps_pair = false;
  Index first_origin = kInvalidIndex;
  bool has_against = false;

  bool keep(Index origin) noexcept {
    if (first_origin == kInvalidIndex) {
      first_origin = origin;
      return true;
    }
    if (!keeps_pair || has_against || origin == first_origin) return false;
    return has_against = true;
  }
};

bool drop_by_edges(const kernels::FaceColumns& faces, const PairOutput& paired,
                   const Policies& policies, std::vector<std::uint8_t>& keep) {
  std::vector<EdgeState> edges;
  std::vector<std::uint8_t> is_end(at(faces.vertex_count), 0);
  for (const Defect& d : paired.defects) {
    if (!d.halfedge.valid() || policies[d.kind] != Action::skip) continue;
    edges.push_back({{d.vertex.value, d.other.value}, d.kind == DefectKind::nonmanifold_edge});
    is_end[at(d.vertex.value)] = is_end[at(d.other.value)] = 1;
  }
  if (edges.empty()) return false;
  const auto by_ends = [](const EdgeState& a, const EdgeState& b) { return a.ends < b.ends; };
  std::sort(edges.begin(), edges.end(), by_ends);
  for (Index f = 0; f < faces.face_count; ++f) {
    const Index begin = faces.begin(f);
    const Index degree = faces.degree(f);
    for (Index k = 0; k < degree; ++k) {
      const Index a = faces.corners[begin + k];
      const Index b = faces.corners[begin + (k + 1 < degree ? k + 1 : 0)];
      if (is_end[at(a)] == 0 || is_end[at(b)] == 0) continue;
      const EdgeState key{std::minmax(a, b)};
      const auto edge = std::lower_bound(edges.begin(), edges.end(), key, by_ends);
      if (edge == edges.end() || edge->ends != key.ends || edge->keep(a)) continue;
      keep[at(f)] = 0;
    }
  }
  return true;
}

// Which fans of v hang together with the first one across shared edges.
std::vector<bool> fans_with_first(const Walker& walk, const std::vector<HalfedgeId>& starts) {
  std::map<Index, std::vector<std::size_t>> fans_at;  // by the neighbour at the end of an edge
  for (std::size_t i = 0; i < starts.size(); ++i) {
    walk.for_each_in_fan(starts[i], [&](Index h) {
      fans_at[walk.faces.corners[walk.next(h)]].push_back(i);
      fans_at[walk.faces.corners[walk.prev(h)]].push_back(i);
    });
  }
  std::vector<std::size_t> parent(starts.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& [neighbour, fans] : fans_at) {
    for (const std::size_t i : fans) {
      const std::size_t a = root(fans[0]);
      const std::size_t b = root(i);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<bool> together(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) together[i] = root(i) == 0;
  return together;
}

bool drop_by_vertices(const kernels::FaceColumns& faces, const PairOutput& paired,
                      const Policies& policies, std::vector<std::uint8_t>& keep) {
  if (policies[DefectKind::nonmanifold_vertex] != Action::skip) return false;
  const Walker walk{faces, paired};
  bool found = false;
  for (const Defect& d : paired.defects) {
    if (d.kind != DefectKind::nonmanifold_vertex) continue;
    found = true;
    const std::vector<HalfedgeId> starts = walk.fans_of(d.vertex);
    const std::vector<bool> stays = fans_with_first(walk, starts);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      if (stays[i]) continue;
      walk.for_each_in_fan(starts[i],
                           [&](Index h) { keep[at(face_of(faces, HalfedgeId(h)).value)] = 0; });
    }
  }
  return found;
}

bool is_split(const Defect& defect, const Policies& policies) noexcept {
  return policies[defect.kind] == Action::split && defect.kind >= DefectKind::nonmanifold_edge;
}

bool has_split_defect(const std::vector<Defect>& defects, const Policies& policies) noexcept {
  return std::any_of(defects.begin(), defects.end(),
                     [&](const Defect& d) { return is_split(d, policies); });
}

}  // namespace

std::vector<std::uint8_t> faces_to_drop(const kernels::FaceColumns& faces, const PairOutput& paired,
                                        const Policies& policies) {
  if (paired.defects.empty()) return {};
  std::vector<std::uint8_t> keep(at(faces.face_count), 1);
  if (drop_by_edges(faces, paired, policies, keep)) return keep;
  if (drop_by_vertices(faces, paired, policies, keep)) return keep;
  return {};
}

bool split_fans(InputFaces& input, const PairOutput& paired, const Policies& policies) {
  if (paired.fans.empty() || !has_split_defect(paired.defects, policies)) return false;
  const kernels::FaceColumns faces = input.columns();
  std::vector<std::uint8_t> splits(at(faces.vertex_count), 0);
  for (const Defect& d : paired.defects) {
    if (!is_split(d, policies)) continue;
    splits[at(d.vertex.value)] = 1;
    if (d.other.valid()) splits[at(d.other.value)] = 1;
  }
  const Walker walk{faces, paired};
  Buffer<Index> corners = Buffer<Index>::copy_of(input.corners.span());
  std::vector<Index> origins;
  for (const FanStart& fan : paired.fans) {
    if (splits[at(fan.vertex.value)] == 0) continue;
    const Index copy = faces.vertex_count + static_cast<Index>(origins.size());
    origins.push_back(fan.vertex.value);
    walk.for_each_in_fan(fan.start, [&](Index h) { corners[at(h)] = copy; });
  }
  if (origins.empty()) return false;
  replace_corners(input, std::move(corners), origins);
  return true;
}

}  // namespace hedgerow::detail
