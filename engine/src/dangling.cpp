#include "hedgerow/dangling.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "at.h"
#include "closed_columns.h"
#include "hedgerow/boundary.h"

namespace hedgerow {

namespace {

bool is_dangling(const PolygonView& mesh, HalfedgeId h) noexcept {
  return !mesh.face(h).valid() && !mesh.face(mesh.opposite[h]).valid();
}

Result<void> check_edges(std::span<const EdgeVertices> edges, Index vertex_count) {
  Error error{ErrorCode::index_out_of_range, kInvalidIndex, 0, vertex_count, 0};
  Error loop{ErrorCode::repeated_vertex, kInvalidIndex, 0, 0, 0};
  for (std::size_t i = edges.size(); i-- > 0;) {
    for (const VertexId v : {edges[i].to, edges[i].from}) {
      if (v.value >= 0 && v.value < vertex_count) continue;
      error.element = static_cast<Index>(i);
      error.value = v.value;
      ++error.count;
    }
    if (edges[i].from == edges[i].to) {
      loop.element = static_cast<Index>(i);
      loop.value = edges[i].from.value;
      ++loop.count;
    }
  }
  if (error.count > 0) return fail(error);
  if (loop.count > 0) return fail(loop);
  return {};
}

// A half-edge, or an edge given, under the smaller and the larger of its vertices.
struct Keyed {
  VertexId smaller;
  VertexId larger;
  Index number;

  friend auto operator<=>(const Keyed&, const Keyed&) noexcept = default;
  [[nodiscard]] bool has_ends_of(const Keyed& other) const noexcept {
    return smaller == other.smaller && larger == other.larger;
  }
};
Keyed keyed(VertexId a, VertexId b, Index number) noexcept {
  return {std::min(a, b), std::max(a, b), number};
}

// The half-edges between vertices that an edge given has, sorted.
std::vector<Keyed> halfedges_between_ends(const PolygonView& mesh,
                                          std::span<const EdgeVertices> edges) {
  std::vector<bool> is_end(at(mesh.vertex_count()), false);
  for (const auto [from, to] : edges) is_end[at(from.value)] = is_end[at(to.value)] = true;
  std::vector<Keyed> found;
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    const HalfedgeId h(i);
    const VertexId a = mesh.origin[h];
    const VertexId b = mesh.target(h);
    if (is_end[at(a.value)] && is_end[at(b.value)]) found.push_back(keyed(a, b, i));
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Finds or numbers the half-edge of each edge. Returns those edges that have to be made, in order.
std::vector<EdgeVertices> name_halfedges(const PolygonView& mesh,
                                         std::span<const EdgeVertices> edges,
                                         Buffer<HalfedgeId>& halfedge_of_edge) {
  const std::vector<Keyed> there = halfedges_between_ends(mesh, edges);
  std::vector<Keyed> missing;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Keyed key = keyed(edges[i].from, edges[i].to, static_cast<Index>(i));
    const auto found =
        std::lower_bound(there.begin(), there.end(), Keyed{key.smaller, key.larger, 0});
    if (found == there.end() || !found->has_ends_of(key)) {
      missing.push_back(key);
      continue;
    }
    const HalfedgeId h(found->number);
    halfedge_of_edge[i] = mesh.origin[h] == edges[i].from ? h : mesh.opposite[h];
  }
  std::sort(missing.begin(), missing.end());
  // Of edges with the same ends the first is made, and stands for the others.
  std::vector<Index> made_by(edges.size(), kInvalidIndex);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const bool is_first = i == 0 || !missing[i].has_ends_of(missing[i - 1]);
    const Index self = missing[i].number;
    made_by[at(self)] = is_first ? self : made_by[at(missing[i - 1].number)];
  }
  std::vector<EdgeVertices> made;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Index maker = made_by[i];
    if (maker == kInvalidIndex) continue;
    if (maker == static_cast<Index>(i)) {
      halfedge_of_edge[i] = HalfedgeId(mesh.halfedge_count() + 2 * static_cast<Index>(made.size()));
      made.push_back(edges[i]);
    } else {
      const Index first = halfedge_of_edge[at(maker)].value;
      halfedge_of_edge[i] = HalfedgeId(edges[i] == edges[at(maker)] ? first : first + 1);
    }
  }
  return made;
}

template <class Key, class Value>
std::span<const Index> span_of(const Column<Key, Value>& column) noexcept {
  return {column.data(), at(column.size())};
}

// The half-edges to be made that leave each vertex, ascending: rows of one array.
struct Stars {
  std::vector<Index> first;
  std::vector<Index> halfedges;

  Stars(Index vertex_count, std::span<const EdgeVertices> made, Index begin)
      : first(at(vertex_count) + 1, 0), halfedges(2 * made.size()) {
    for (const auto [from, to] : made) {
      ++first[at(from.value) + 1];
      ++first[at(to.value) + 1];
    }
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    std::vector<Index> end(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < made.size(); ++i) {
      const Index h = begin + 2 * static_cast<Index>(i);
      halfedges[at(end[at(made[i].from.value)]++)] = h;
      halfedges[at(end[at(made[i].to.value)]++)] = h + 1;
    }
  }
  [[nodiscard]] std::span<const Index> of(Index v) const noexcept {
    return std::span(halfedges).subspan(at(first[at(v)]), at(first[at(v) + 1] - first[at(v)]));
  }
};

// The boundary half-edge that starts the first open fan of v; invalid if it has none.
HalfedgeId first_gap(const PolygonView& mesh, VertexId v) noexcept {
  const HalfedgeId start = mesh.outgoing[v];
  if (!start.valid() || !mesh.face(start).valid()) return start;
  for (const FanStart& fan : extra_fans(mesh.fans, v)) {
    if (!mesh.face(fan.start).valid()) return fan.start;
  }
  return {};
}

// Puts a star between the two half-edges of a gap, or makes it a fan of its own.
void link_star(const PolygonView& mesh, VertexId v, std::span<const Index> star, Index* next,
               Index* outgoing, std::vector<FanStart>& fans) {
  const auto opposite = [&](Index h) {
    return (h - mesh.halfedge_count()) % 2 == 0 ? h + 1 : h - 1;
  };
  for (std::size_t i = 1; i < star.size(); ++i) next[opposite(star[i - 1])] = star[i];
  const HalfedgeId gap = first_gap(mesh, v);
  if (gap.valid()) {
    next[mesh.prev(gap).value] = star.front();
    next[opposite(star.back())] = gap.value;
    return;
  }
  next[opposite(star.back())] = star.front();
  if (mesh.outgoing[v].valid()) {
    fans.push_back({v, HalfedgeId(star.front())});
  } else {
    outgoing[v.value] = star.front();
  }
}

ConnectivityColumns add_edges(const PolygonView& mesh, bool all_triangles,
                              std::span<const EdgeVertices> made) {
  const std::size_t size = at(mesh.halfedge_count()) + 2 * made.size();
  Buffer<Index> origin = detail::extended(span_of(mesh.origin), size);
  Buffer<Index> opposite = detail::extended(span_of(mesh.opposite), size);
  Buffer<Index> next = detail::extended(span_of(mesh.next_of), size);
  Buffer<Index> face = detail::extended(span_of(mesh.face_of), size);
  Buffer<Index> outgoing = Buffer<Index>::copy_of(span_of(mesh.outgoing));
  std::vector<FanStart> fans(mesh.fans.begin(), mesh.fans.end());
  for (std::size_t i = 0; i < made.size(); ++i) {
    const std::size_t h = at(mesh.halfedge_count()) + 2 * i;
    origin[h] = made[i].from.value;
    origin[h + 1] = made[i].to.value;
    opposite[h] = static_cast<Index>(h + 1);
    opposite[h + 1] = static_cast<Index>(h);
    face[h] = face[h + 1] = kInvalidIndex;
  }
  const Stars stars(mesh.vertex_count(), made, mesh.halfedge_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (stars.of(v).empty()) continue;
    link_star(mesh, VertexId(v), stars.of(v), next.data(), outgoing.data(), fans);
  }
  std::stable_sort(fans.begin(), fans.end(),
                   [](FanStart a, FanStart b) { return a.vertex < b.vertex; });
  ConnectivityColumns columns;
  columns.form = Form::closed;
  columns.all_triangles = all_triangles;
  columns.origin = std::move(origin);
  columns.opposite = std::move(opposite);
  columns.outgoing = std::move(outgoing);
  columns.next = std::move(next);
  columns.face = std::move(face);
  columns.first = Buffer<Index>::copy_of(span_of(mesh.first_of));
  columns.fans = Buffer<FanStart>::copy_of(fans);
  return columns;
}

// ---- the way back

// From h on, clockwise, the first half-edge that stays; invalid if none of the rotation does.
HalfedgeId first_staying(const PolygonView& mesh, HalfedgeId h) noexcept {
  if (!h.valid()) return h;
  HalfedgeId g = h;
  while (is_dangling(mesh, g)) {
    g = mesh.next(mesh.opposite[g]);
    if (g == h) return {};
  }
  return g;
}

ConnectivityColumns drop_dangling(const PolygonView& mesh, bool all_triangles) {
  std::vector<Index> number(at(mesh.halfedge_count()), kInvalidIndex);
  std::vector<HalfedgeId> kept;
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    if (is_dangling(mesh, HalfedgeId(i))) continue;
    number[at(i)] = static_cast<Index>(kept.size());
    kept.push_back(HalfedgeId(i));
  }
  const auto numbered = [&](HalfedgeId h) { return h.valid() ? number[at(h.value)] : h.value; };
  Buffer<Index> origin(kept.size());
  Buffer<Index> opposite(kept.size());
  Buffer<Index> next(kept.size());
  Buffer<Index> face(kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    origin[i] = mesh.origin[kept[i]].value;
    opposite[i] = numbered(mesh.opposite[kept[i]]);
    next[i] = numbered(first_staying(mesh, mesh.next(kept[i])));
    face[i] = mesh.face(kept[i]).value;
  }
  Buffer<Index> outgoing(at(mesh.vertex_count()));
  std::vector<FanStart> fans;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    outgoing[at(v)] = numbered(first_staying(mesh, mesh.outgoing[VertexId(v)]));
    for (const FanStart& fan : extra_fans(mesh.fans, VertexId(v))) {
      const HalfedgeId start(numbered(first_staying(mesh, fan.start)));
      if (!start.valid()) continue;
      if (outgoing[at(v)] == kInvalidIndex) {
        outgoing[at(v)] = start.value;
      } else {
        fans.push_back({VertexId(v), start});
      }
    }
  }
  ConnectivityColumns columns;
  columns.form = Form::closed;
  columns.all_triangles = all_triangles;
  columns.origin = std::move(origin);
  columns.opposite = std::move(opposite);
  columns.outgoing = std::move(outgoing);
  columns.next = std::move(next);
  columns.face = std::move(face);
  columns.first = Buffer<Index>::copy_of(span_of(mesh.first_of));
  columns.fans = Buffer<FanStart>::copy_of(fans);
  return columns;
}

}  // namespace

Result<DanglingOutput> add_dangling_edges(const Connectivity& mesh,
                                          std::span<const EdgeVertices> edges,
                                          const Execution& execution) {
  if (const Result<void> good = check_edges(edges, mesh.vertex_count()); !good) {
    return fail(good.error());
  }
  if (mesh.form() == Form::open) {
    const Result<Connectivity> closed = close_boundary(mesh, execution);
    if (!closed) return fail(closed.error());
    return add_dangling_edges(*closed, edges, execution);
  }
  const PolygonView view = mesh.polygons();
  Buffer<HalfedgeId> halfedge_of_edge(edges.size());
  const auto most = view.halfedge_count() + 2 * static_cast<std::int64_t>(edges.size());
  if (most > kMaxCount) {
    return fail({ErrorCode::too_many_elements, kInvalidIndex, most, kMaxCount});
  }
  const std::vector<EdgeVertices> made = name_halfedges(view, edges, halfedge_of_edge);
  return DanglingOutput{Connectivity(add_edges(view, mesh.is_triangle_mesh(), made)),
                        std::move(halfedge_of_edge), static_cast<Index>(made.size())};
}

std::vector<EdgeVertices> dangling_edges(const Connectivity& mesh) {
  std::vector<EdgeVertices> edges;
  if (mesh.form() == Form::open) return edges;
  const PolygonView view = mesh.polygons();
  for (Index i = 0; i < view.halfedge_count(); ++i) {
    const HalfedgeId h(i);
    if (h < view.opposite[h] && is_dangling(view, h)) {
      edges.push_back({view.origin[h], view.target(h)});
    }
  }
  return edges;
}

Result<Connectivity> remove_dangling_edges(const Connectivity& mesh) {
  if (mesh.form() == Form::open) {
    return close_boundary(mesh, Execution::serial());
  }
  const PolygonView view = mesh.polygons();
  const Index side_count = view.first_of[FaceId(view.face_count())].value;
  for (Index i = 0; i < side_count; ++i) {
    if (!view.face(HalfedgeId(i)).valid()) return fail({ErrorCode::not_canonical, i});
  }
  return Connectivity(drop_dangling(view, mesh.is_triangle_mesh()));
}

}  // namespace hedgerow
