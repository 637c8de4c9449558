#include <algorithm>
#include <utility>

#include "at.h"
#include "represent/number_halfedges.h"
#include "represent/winged_sides.h"

namespace hedgerow {

namespace {

using detail::WingedSides;

// ---- half-edges to tables

// A vertex record has one edge, from which no second fan is found.
Error describe_fans(FanTable fans) {
  Error error{ErrorCode::nonmanifold_vertex, fans.front().vertex.value, 1, 1, 0};
  for (std::size_t i = 0; i < fans.size(); ++i) {
    error.value += fans[i].vertex == fans.front().vertex;
    error.count += i == 0 || fans[i].vertex != fans[i - 1].vertex;
  }
  return error;
}

template <Topology Mesh>
Result<void> check_holdable(const Mesh& mesh) {
  if (!mesh.fans.empty()) return fail(describe_fans(mesh.fans));
  Index edge_count = 0;
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    const HalfedgeId h(i);
    if (mesh.origin[h] == mesh.target(h)) {
      return fail({ErrorCode::repeated_vertex, mesh.face(h).value, mesh.origin[h].value});
    }
    edge_count += !mesh.opposite[h].valid() || h < mesh.opposite[h];
  }
  if (edge_count > kMaxCount / 2) {
    return fail(
        {ErrorCode::too_many_elements, kInvalidIndex, 2 * std::int64_t{edge_count}, kMaxCount});
  }
  return {};
}

template <Topology Mesh>
WingedNumbering default_numbering(const Mesh& mesh) {
  std::size_t edge_count = 0;
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    const HalfedgeId h_opposite = mesh.opposite[HalfedgeId(i)];
    edge_count += !h_opposite.valid() || i < h_opposite.value;
  }
  WingedNumbering numbering{Buffer<HalfedgeId>(2 * edge_count),
                            Buffer<EdgeId>(at(mesh.vertex_count()))};
  Buffer<Index> edge_of(at(mesh.halfedge_count()));
  Index e = 0;
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    const HalfedgeId h_opposite = mesh.opposite[HalfedgeId(i)];
    if (h_opposite.valid() && h_opposite.value < i) continue;
    numbering.halfedge_of_side[at(2 * e)] = HalfedgeId(i);
    numbering.halfedge_of_side[at(2 * e + 1)] = h_opposite;
    edge_of[at(i)] = e;
    if (h_opposite.valid()) edge_of[at(h_opposite.value)] = e;
    ++e;
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const HalfedgeId h = mesh.outgoing[VertexId(v)];
    numbering.vertex_edge[at(v)] = h.valid() ? EdgeId(edge_of[at(h.value)]) : EdgeId();
  }
  return numbering;
}

template <Topology Mesh>
WingedEdgeTables fill_tables(const Mesh& mesh, const WingedNumbering& numbering) {
  const std::span<const HalfedgeId> halfedge = numbering.halfedge_of_side.span();
  Buffer<Index> edge_of(at(mesh.halfedge_count()));
  for (std::size_t s = 0; s < halfedge.size(); ++s) {
    if (halfedge[s].valid()) edge_of[at(halfedge[s].value)] = static_cast<Index>(s / 2);
  }
  const auto edge = [&](HalfedgeId h) { return EdgeId(edge_of[at(h.value)]); };
  WingedEdgeTables tables{{},
                          Buffer<EdgeId>::copy_of(numbering.vertex_edge.span()),
                          Buffer<EdgeId>(at(mesh.face_count())),
                          Buffer<WingedEdge>(halfedge.size() / 2)};
  for (std::size_t e = 0; e < tables.edges.size(); ++e) {
    WingedEdge row;
    if (const HalfedgeId h = halfedge[2 * e]; h.valid()) {
      row = {mesh.origin[h], mesh.target(h), edge(mesh.prev(h)), edge(mesh.next(h)),
             EdgeId(),       EdgeId(),       mesh.face(h),       FaceId()};
    }
    if (const HalfedgeId h = halfedge[2 * e + 1]; h.valid()) {
      row.start = mesh.target(h);
      row.end = mesh.origin[h];
      row.prev_ccw = edge(mesh.prev(h));
      row.next_ccw = edge(mesh.next(h));
      row.face_ccw = mesh.face(h);
    }
    tables.edges[e] = row;
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    tables.face_edge[at(f)] = edge(mesh.first(FaceId(f)));
  }
  return tables;
}

Result<Buffer<float>> copy_positions(Positions positions, Index vertex_count) {
  if (positions.count == 0) return Buffer<float>();
  if (positions.count != vertex_count) {
    return fail({ErrorCode::count_mismatch, kInvalidIndex, positions.count, vertex_count});
  }
  if (positions.data == nullptr) return fail({ErrorCode::null_pointer});
  Buffer<float> xyz(3 * at(vertex_count));
  for (Index v = 0; v < vertex_count; ++v) std::copy_n(positions[v], 3, xyz.data() + 3 * at(v));
  return xyz;
}

Result<WingedEdgeTables> make_tables(const Connectivity& mesh, const WingedNumbering* numbering,
                                     Positions positions) {
  return mesh.visit([&](const auto& view) -> Result<WingedEdgeTables> {
    if (const Result<void> held = check_holdable(view); !held) return fail(held.error());
    Result<Buffer<float>> xyz = copy_positions(positions, mesh.vertex_count());
    if (!xyz) return fail(xyz.error());
    WingedEdgeTables tables = numbering != nullptr ? fill_tables(view, *numbering)
                                                   : fill_tables(view, default_numbering(view));
    tables.xyz = std::move(*xyz);
    return tables;
  });
}

// ---- tables to half-edges

class SideSource {
 public:
  explicit SideSource(const WingedEdgeTables& tables) noexcept : t_(tables), sides_(tables) {}

  [[nodiscard]] Index record_count() const noexcept { return sides_.count(); }
  [[nodiscard]] Index vertex_count() const noexcept { return t_.vertex_count(); }
  [[nodiscard]] Index face_count() const noexcept { return t_.face_count(); }
  [[nodiscard]] bool exists(Index s) const noexcept { return sides_.exists(s); }
  [[nodiscard]] Index origin(Index s) const noexcept { return sides_.origin(s); }
  [[nodiscard]] Index opposite(Index s) const noexcept {
    return exists(s ^ 1) ? s ^ 1 : kInvalidIndex;
  }
  [[nodiscard]] Index next(Index s) const noexcept { return sides_.next(s); }
  [[nodiscard]] Index face(Index s) const noexcept { return sides_.face(s); }
  [[nodiscard]] Index face_record(Index f) const noexcept {
    const Index e = t_.face_edge[at(f)].value;
    return e == kInvalidIndex ? e : sides_.face(2 * e) == f ? 2 * e : 2 * e + 1;
  }
  template <class Visit>
  void for_each_start(const Visit& visit) const {
    for (Index v = 0; v < t_.vertex_count(); ++v) {
      const EdgeId e = t_.vertex_edge[at(v)];
      if (e.valid()) visit(sides_.leaving(e.value, v));
    }
  }

 private:
  const WingedEdgeTables& t_;
  WingedSides sides_;
};

}  // namespace

Result<WingedEdgeTables> build_winged_edges(const Connectivity& mesh, Positions positions) {
  return make_tables(mesh, nullptr, positions);
}

Result<WingedEdgeTables> build_winged_edges(const Connectivity& mesh,
                                            const WingedNumbering& numbering, Positions positions) {
  HEDGEROW_ASSERT(numbering.vertex_edge.size() == at(mesh.vertex_count()));
  return make_tables(mesh, &numbering, positions);
}

Result<WingedHalfedges> build_connectivity(const WingedEdgeTables& tables) {
  if (const std::vector<WingedFault> faults = check_winged_edges(tables); !faults.empty()) {
    const WingedFault& fault = faults.front();
    return fail({ErrorCode::inconsistent_table, fault.row, fault.found, fault.expected,
                 static_cast<std::int64_t>(faults.size())});
  }
  auto numbered = detail::HalfedgeMaker(SideSource(tables)).run();
  if (!numbered) return fail(numbered.error());
  if (const FanTable fans = numbered->mesh.fans(); !fans.empty()) return fail(describe_fans(fans));
  return WingedHalfedges{std::move(numbered->mesh),
                         {std::move(numbered->halfedge_of_record),
                          Buffer<EdgeId>::copy_of(tables.vertex_edge.span())}};
}

HalfedgeId WingedEdgeView::Outgoing::operator[](VertexId v) const noexcept {
  const EdgeId e = tables->vertex_edge[at(v.value)];
  if (!e.valid()) return {};
  const WingedEdgeView view(*tables);
  HalfedgeId start = view.leaving(e, v);
  // A side that does not exist: its edge ends the fan, and the next one round the face leaves v.
  if (!view.has(start)) start = view.next(HalfedgeId(start.value ^ 1));
  HalfedgeId h = start;
  while (view.face(h).valid()) {
    const HalfedgeId counter_clockwise = view.opposite[view.prev(h)];
    if (!counter_clockwise.valid()) return h;
    h = counter_clockwise;
    if (h == start) break;
  }
  return h;
}

}  // namespace hedgerow
