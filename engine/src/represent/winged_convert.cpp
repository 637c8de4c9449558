#include <algorithm>
#include <utility>

#include "represent/winged_sides.h"

namespace hedgerow {

namespace {

using detail::WingedSides;

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

// ---- half-edges to tables

template <Topology Mesh>
Result<void> check_holdable(const Mesh& mesh) {
  if (const FanTable fans = mesh.fans; !fans.empty()) {
    Error error{ErrorCode::nonmanifold_vertex, fans.front().vertex.value, 1, 1, 0};
    for (std::size_t i = 0; i < fans.size(); ++i) {
      error.value += fans[i].vertex == fans.front().vertex;
      error.count += i == 0 || fans[i].vertex != fans[i - 1].vertex;
    }
    return fail(error);
  }
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

// Numbers half-edges and fills the columns of consistent tables.
class HalfedgeMaker {
 public:
  explicit HalfedgeMaker(const WingedEdgeTables& tables)
      : t_(tables), sides_(tables), halfedge_(at(sides_.count()), HalfedgeId()) {}

  Result<WingedHalfedges> run() {
    if (Result<void> numbered = number_faces(); !numbered) return fail(numbered.error());
    number_loops();
    fill_columns();
    if (Result<void> fans = fill_outgoing(); !fans) return fail(fans.error());
    ConnectivityColumns columns;
    columns.form = form_;
    columns.all_triangles = all_triangles_;
    columns.origin = std::move(origin_);
    columns.opposite = std::move(opposite_);
    columns.outgoing = std::move(outgoing_);
    if (!all_triangles_ || form_ == Form::closed) {
      columns.next = std::move(next_);
      columns.face = std::move(face_);
      columns.first = std::move(first_);
    }
    return WingedHalfedges{Connectivity(std::move(columns)),
                           {std::move(halfedge_), Buffer<EdgeId>::copy_of(t_.vertex_edge.span())}};
  }

 private:
  // Numbers the sides of a cycle in a row. Returns how many there are.
  Index number_cycle(Index start) {
    const auto before = static_cast<Index>(side_.size());
    Index s = start;
    do {
      halfedge_[at(s)] = HalfedgeId(static_cast<Index>(side_.size()));
      side_.push_back(s);
      s = sides_.next(s);
    } while (s != start);
    return static_cast<Index>(side_.size()) - before;
  }

  Result<void> number_faces() {
    first_ = Buffer<Index>(at(t_.face_count()) + 1);
    side_.reserve(at(sides_.count()));
    for (Index f = 0; f < t_.face_count(); ++f) {
      first_[at(f)] = static_cast<Index>(side_.size());
      const Index e = t_.face_edge[at(f)].value;
      Index degree = 0;
      if (e != kInvalidIndex) degree = number_cycle(sides_.face(2 * e) == f ? 2 * e : 2 * e + 1);
      if (degree < 3) return fail({ErrorCode::too_few_corners, f, degree, 3});
      all_triangles_ &= degree == 3;
    }
    first_[at(t_.face_count())] = static_cast<Index>(side_.size());
    return {};
  }

  void number_loops() {
    const auto in_faces = static_cast<Index>(side_.size());
    const auto add_loop = [&](Index s) {
      if (!sides_.exists(s) || halfedge_[at(s)].valid()) return;
      form_ = Form::closed;
      number_cycle(s);
    };
    for (Index h = 0; h < in_faces; ++h) add_loop(side_[at(h)] ^ 1);
    for (Index s = 0; s < sides_.count(); ++s) add_loop(s);  // of dangling edges alone
    // A surface without boundary is the same in both forms; the default one is meant.
  }

  void fill_columns() {
    const std::size_t count = side_.size();
    origin_ = Buffer<Index>(count);
    opposite_ = Buffer<Index>(count);
    next_ = Buffer<Index>(count);
    face_ = Buffer<Index>(count);
    for (std::size_t h = 0; h < count; ++h) {
      const Index s = side_[h];
      origin_[h] = sides_.origin(s);
      opposite_[h] = halfedge_[at(s ^ 1)].value;
      next_[h] = halfedge_[at(sides_.next(s))].value;
      face_[h] = sides_.face(s);
    }
  }

  Result<void> fill_outgoing() {
    const WingedEdgeView view(t_);
    outgoing_ = Buffer<Index>(at(t_.vertex_count()));
    std::vector<std::uint8_t> is_met(side_.size(), 0);
    for (Index v = 0; v < t_.vertex_count(); ++v) {
      const HalfedgeId start = view.outgoing[VertexId(v)];
      outgoing_[at(v)] = start.valid() ? halfedge_[at(start.value)].value : kInvalidIndex;
      if (start.valid()) meet_fan(outgoing_[at(v)], is_met);
    }
    const auto missed = std::find(is_met.begin(), is_met.end(), 0);
    if (missed == is_met.end()) return {};
    return fail(describe_fans(is_met));
  }

  // From the end of the fan: clockwise, until the fan ends or comes round.
  void meet_fan(Index start, std::vector<std::uint8_t>& is_met) const {
    Index h = start;
    do {
      is_met[at(h)] = 1;
      const Index h_opposite = opposite_[at(h)];
      h = h_opposite == kInvalidIndex ? start : next_[at(h_opposite)];
    } while (h != start);
  }

  [[nodiscard]] Error describe_fans(std::vector<std::uint8_t>& is_met) const {
    std::vector<Index> fans(at(t_.vertex_count()), 1);
    std::vector<Index> prev(side_.size());
    for (std::size_t h = 0; h < side_.size(); ++h) prev[at(next_[h])] = static_cast<Index>(h);
    for (Index i = 0; i < static_cast<Index>(side_.size()); ++i) {
      if (is_met[at(i)] != 0) continue;
      ++fans[at(origin_[at(i)])];
      Index start = i;
      for (Index h = opposite_[at(prev[at(i)])]; h != kInvalidIndex && h != i;
           h = opposite_[at(prev[at(h)])]) {
        start = h;
      }
      meet_fan(start, is_met);
    }
    Error error{ErrorCode::nonmanifold_vertex, kInvalidIndex, 0, 1, 0};
    for (Index v = t_.vertex_count(); v-- > 0;) {
      if (fans[at(v)] == 1) continue;
      error.element = v;
      error.value = fans[at(v)];
      ++error.count;
    }
    return error;
  }

  const WingedEdgeTables& t_;
  WingedSides sides_;
  Buffer<HalfedgeId> halfedge_;  // by side
  std::vector<Index> side_;      // by half-edge
  Buffer<Index> origin_;
  Buffer<Index> opposite_;
  Buffer<Index> next_;
  Buffer<Index> face_;
  Buffer<Index> first_;
  Buffer<Index> outgoing_;
  Form form_ = Form::open;
  bool all_triangles_ = true;
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
  return HalfedgeMaker(tables).run();
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
