#include <algorithm>
#include <utility>
#include <vector>

#include "at.h"
#include "hedgerow/nonmanifold_edge.h"
#include "represent/number_halfedges.h"

namespace hedgerow {

namespace {

// ---- half-edges to records

// Turns counts of rows, each one place behind its row's, into where the rows begin.
void sum_up(Buffer<Index>& first) noexcept {
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
}

// Fills rows in the order in which values are named: `for_each(visit)` calls visit(row, value), the
// same calls each time.
template <class Key, class Value, class ForEach>
RowTable<Key, Value> make_rows(Index row_count, const ForEach& for_each) {
  RowTable<Key, Value> rows{Buffer<Index>(at(row_count) + 1, Index{0}), {}};
  for_each([&](Index row, Value) { ++rows.first[at(row) + 1]; });
  sum_up(rows.first);
  rows.values = Buffer<Value>(at(rows.first[at(row_count)]));
  Buffer<Index> end = Buffer<Index>::copy_of(rows.first.span().first(at(row_count)));
  for_each([&](Index row, Value value) { rows.values[at(end[at(row)]++)] = value; });
  return rows;
}

template <Topology Mesh>
void fill_edges(const Mesh& mesh, const RadialCycles& cycles, NonmanifoldEdges& out) {
  const Index halfedge_count = mesh.halfedge_count();
  out.face_edges = Buffer<EdgeId>(at(halfedge_count), EdgeId());
  std::vector<EdgeEnds> ends;
  std::vector<Index> first;
  out.uses.values = Buffer<EdgeUse>(at(halfedge_count));
  Index use_count = 0;
  for (Index i = 0; i < halfedge_count; ++i) {
    if (out.face_edges[at(i)].valid()) continue;
    const EdgeId e(static_cast<Index>(ends.size()));
    const HalfedgeId start(i);
    const VertexId a = mesh.origin[start];
    const VertexId b = mesh.target(start);
    ends.push_back({std::min(a, b), std::max(a, b)});
    first.push_back(use_count);
    HalfedgeId h = start;
    do {
      out.face_edges[at(h.value)] = e;
      out.uses.values[at(use_count++)] = {mesh.face(h), h, mesh.opposite[h]};
      h = cycles.next(h);
    } while (h != start);
  }
  first.push_back(use_count);
  out.ends = Buffer<EdgeEnds>::copy_of(ends);
  out.uses.first = Buffer<Index>::copy_of(first);
}

template <Topology Mesh>
NonmanifoldEdges make_records(const Mesh& mesh, const RadialCycles& cycles) {
  NonmanifoldEdges out;
  fill_edges(mesh, cycles, out);
  out.vertex_edges = make_rows<VertexId, EdgeId>(mesh.vertex_count(), [&](const auto& visit) {
    for (Index e = 0; e < out.edge_count(); ++e) {
      visit(out.ends[at(e)].smaller.value, EdgeId(e));
      visit(out.ends[at(e)].larger.value, EdgeId(e));
    }
  });
  out.vertex_faces = make_rows<VertexId, FaceId>(mesh.vertex_count(), [&](const auto& visit) {
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      visit(mesh.origin[HalfedgeId(h)].value, mesh.face(HalfedgeId(h)));
    }
  });
  out.face_vertices = make_rows<FaceId, VertexId>(mesh.face_count(), [&](const auto& visit) {
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
      visit(mesh.face(HalfedgeId(h)).value, mesh.origin[HalfedgeId(h)]);
    }
  });
  return out;
}

// ---- records to half-edges

Result<void> check_face_table(const NonmanifoldEdges& edges) {
  const Buffer<Index>& first = edges.face_vertices.first;
  const auto corner_count = static_cast<Index>(edges.face_vertices.values.size());
  if (first.empty() || first[0] != 0 || first[first.size() - 1] != corner_count) {
    return fail({ErrorCode::bad_face_offsets, 0});
  }
  for (Index f = 0; f < edges.face_count(); ++f) {
    const Index degree = first[at(f) + 1] - first[at(f)];
    if (degree < 0 || first[at(f) + 1] > corner_count) {
      return fail({ErrorCode::bad_face_offsets, f});
    }
    if (degree < 3) return fail({ErrorCode::too_few_corners, f, degree, 3});
  }
  for (Index c = 0; c < corner_count; ++c) {
    const Index v = edges.face_vertices.values[at(c)].value;
    if (v < 0 || v >= edges.vertex_count()) {
      return fail({ErrorCode::index_out_of_range, c, v, edges.vertex_count()});
    }
  }
  return {};
}

Result<void> check_uses(const NonmanifoldEdges& edges) {
  const auto corner_count = static_cast<Index>(edges.face_vertices.values.size());
  const Buffer<EdgeUse>& uses = edges.uses.values;
  const Buffer<Index>& first = edges.uses.first;
  if (uses.size() != at(corner_count)) {
    return fail({ErrorCode::count_mismatch, kInvalidIndex, static_cast<std::int64_t>(uses.size()),
                 corner_count});
  }
  const bool has_rows = !first.empty() && first[0] == 0 && first[first.size() - 1] == corner_count;
  if (!has_rows || !std::is_sorted(first.begin(), first.end())) {
    return fail({ErrorCode::count_mismatch, kInvalidIndex, has_rows ? 0 : -1, corner_count});
  }
  std::vector<Index> times_used(at(corner_count), 0);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    for (const Index c : {uses[i].corner.value, uses[i].joined.value}) {
      const bool is_none = c == kInvalidIndex && c != uses[i].corner.value;
      if (!is_none && (c < 0 || c >= corner_count)) {
        return fail({ErrorCode::index_out_of_range, static_cast<Index>(i), c, corner_count});
      }
    }
    ++times_used[at(uses[i].corner.value)];
  }
  for (Index c = 0; c < corner_count; ++c) {
    if (times_used[at(c)] != 1) {
      return fail({ErrorCode::inconsistent_table, c, times_used[at(c)], 1});
    }
  }
  return {};
}

// The face table with what is across each of its edges, as half-edges in the default form.
class FaceTableSource {
 public:
  explicit FaceTableSource(const NonmanifoldEdges& edges)
      : edges_(edges),
        opposite_(edges.face_vertices.values.size()),
        face_(edges.face_vertices.values.size()) {
    for (const EdgeUse& use : edges.uses.values) opposite_[at(use.corner.value)] = use.joined.value;
    for (Index f = 0; f < face_count(); ++f) {
      for (Index c = begin(f); c < begin(f + 1); ++c) face_[at(c)] = f;
    }
  }

  [[nodiscard]] Index record_count() const noexcept { return static_cast<Index>(face_.size()); }
  [[nodiscard]] Index vertex_count() const noexcept { return edges_.vertex_count(); }
  [[nodiscard]] Index face_count() const noexcept { return edges_.face_count(); }
  [[nodiscard]] bool exists(Index) const noexcept { return true; }
  [[nodiscard]] Index origin(Index c) const noexcept {
    return edges_.face_vertices.values[at(c)].value;
  }
  [[nodiscard]] Index opposite(Index c) const noexcept { return opposite_[at(c)]; }
  [[nodiscard]] Index face(Index c) const noexcept { return face_[at(c)]; }
  [[nodiscard]] Index next(Index c) const noexcept {
    return c + 1 < begin(face(c) + 1) ? c + 1 : begin(face(c));
  }
  [[nodiscard]] Index face_record(Index f) const noexcept { return begin(f); }
  template <class Visit>
  void for_each_start(const Visit&) const {}

 private:
  [[nodiscard]] Index begin(Index f) const noexcept { return edges_.face_vertices.first[at(f)]; }

  const NonmanifoldEdges& edges_;
  std::vector<Index> opposite_;
  std::vector<Index> face_;
};

// Joined both ways, and along the same two vertices.
Result<void> check_joins(const FaceTableSource& source) {
  for (Index c = 0; c < source.record_count(); ++c) {
    const Index across = source.opposite(c);
    if (across == kInvalidIndex) continue;
    const bool is_mutual = source.opposite(across) == c && across != c;
    const bool has_same_ends = source.origin(across) == source.origin(source.next(c)) &&
                               source.origin(c) == source.origin(source.next(across));
    if (!is_mutual || !has_same_ends) {
      return fail({ErrorCode::inconsistent_table, across, source.opposite(across), c});
    }
  }
  return {};
}

Buffer<Index> radial_next(const NonmanifoldEdges& edges) {
  Buffer<Index> next(edges.uses.values.size());
  for (Index e = 0; e < edges.uses.row_count(); ++e) {
    const std::span<const EdgeUse> uses = edges.uses[EdgeId(e)];
    for (std::size_t i = 0; i < uses.size(); ++i) {
      next[at(uses[i].corner.value)] = uses[i + 1 < uses.size() ? i + 1 : 0].corner.value;
    }
  }
  return next;
}

}  // namespace

std::size_t NonmanifoldEdges::bytes() const noexcept {
  return ends.size_bytes() + uses.bytes() + vertex_edges.bytes() + vertex_faces.bytes() +
         face_vertices.bytes() + face_edges.size_bytes();
}

Result<NonmanifoldEdges> build_nonmanifold_edges(const Connectivity& mesh,
                                                 const RadialCycles& cycles) {
  if (mesh.form() == Form::closed) return fail({ErrorCode::already_closed});
  return mesh.visit(
      [&](const auto& view) -> Result<NonmanifoldEdges> { return make_records(view, cycles); });
}

Result<RadialMesh> build_connectivity(const NonmanifoldEdges& edges) {
  if (const Result<void> good = check_face_table(edges); !good) return fail(good.error());
  if (const Result<void> good = check_uses(edges); !good) return fail(good.error());
  const FaceTableSource source(edges);
  if (const Result<void> good = check_joins(source); !good) return fail(good.error());
  auto numbered = detail::HalfedgeMaker(source).run();
  if (!numbered) return fail(numbered.error());
  return RadialMesh{std::move(numbered->mesh), RadialCycles(radial_next(edges))};
}

}  // namespace hedgerow
