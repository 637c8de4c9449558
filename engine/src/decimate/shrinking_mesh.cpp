#include "decimate/shrinking_mesh.h"

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "hedgerow/circulate.h"
#include "kernels/plain_edit.h"
#include "kernels/scatter_edits.h"
#include "parallel/parallel.h"

namespace hedgerow::decimation {
namespace {

constexpr Index kQuadricGrain = 1 << 12;
constexpr double kPointWeight = 1e-3;  // of the distance to where a vertex was, beside the planes

void store(Double3 p, float* to) noexcept {
  to[0] = static_cast<float>(p.x);
  to[1] = static_cast<float>(p.y);
  to[2] = static_cast<float>(p.z);
}
// A place as it will be stored: later costs are of what is written, not of what was meant.
Double3 as_stored(Double3 p) noexcept {
  float stored[3];
  store(p, stored);
  return widen(stored);
}

}  // namespace

// Each vertex gathers what its faces and boundary edges give, in the order of rotation, so that no
// two threads write to one.
ShrinkingMesh::ShrinkingMesh(EditMesh&& mesh, const Positions& positions, double boundary_weight,
                             const Execution& execution)
    : mesh_(std::move(mesh)),
      view_(mesh_.view()),
      columns_(Edit::columns(mesh_)),
      boundary_weight_(boundary_weight),
      vertices_(static_cast<std::size_t>(view_.vertex_count())) {
  par::for_each_range(execution, view_.vertex_count(), kQuadricGrain, [&](IndexRange range) {
    for (Index v = range.begin; v < range.end; ++v) {
      at(VertexId(v)).position = widen(positions[v]);
    }
  });
  par::for_each_range(execution, view_.vertex_count(), kQuadricGrain, [&](IndexRange range) {
    for (Index v = range.begin; v < range.end; ++v) {
      at(VertexId(v)).quadric = gathered(VertexId(v));
    }
  });
}

Quadric ShrinkingMesh::gathered(VertexId v) const noexcept {
  Quadric sum;
  if (!view_.outgoing[v].valid()) return sum;
  double area = 0;
  for (const HalfedgeId h : outgoing_halfedges(view_, v)) {
    if (view_.face(h).valid()) {
      const Double3 twice = corner_vector(h);
      const double length = std::sqrt(dot(twice, twice));
      if (length > 0) {
        sum = sum + Quadric::of_plane(twice * (1 / length), of(v).position, length);
        area += length;
      }
    }
    sum = sum + on_boundary(h) + on_boundary(view_.prev(h));
  }
  return sum + Quadric::of_point(of(v).position, kPointWeight * area);
}
// Twice the area of the triangle at this corner.
Double3 ShrinkingMesh::corner_vector(HalfedgeId h) const noexcept {
  const Double3 here = of(view_.origin[h]).position;
  return cross(of(view_.target(h)).position - here,
               of(view_.origin[view_.prev(h)]).position - here);
}
// The plane that stands on the edge of a boundary half-edge.
Quadric ShrinkingMesh::on_boundary(HalfedgeId h) const noexcept {
  const HalfedgeId inner = view_.opposite[h];
  if (view_.face(h).valid() || !view_.face(inner).valid()) return {};
  const Double3 from = of(view_.origin[inner]).position;
  const Double3 along = of(view_.target(inner)).position - from;
  const Double3 side = cross(along, corner_vector(inner));
  const double length = std::sqrt(dot(side, side));
  if (!(length > 0)) return {};
  return Quadric::of_plane(side * (1 / length), from, boundary_weight_ * dot(along, along));
}

Evaluation ShrinkingMesh::evaluate(HalfedgeId h) const noexcept {
  const Quadric sum = of(view_.origin[h]).quadric + of(view_.target(h)).quadric;
  Double3 place = as_stored(sum.lowest());
  double cost = sum.at(place);
  if (!std::isfinite(cost)) {
    place = of(view_.target(h)).position;
    cost = sum.at(place);
  }
  // Below nothing by rounding only; not a number is not below.
  return {static_cast<float>(cost < 0 ? 0 : cost), place};
}
int ShrinkingMesh::collapse(HalfedgeId h, const Evaluation& evaluation) noexcept {
  const HalfedgeId o = view_.opposite[h];
  const VertexId a = view_.origin[h];
  const VertexId b = view_.origin[o];
  if (folds(a, b, evaluation.place) || folds(b, a, evaluation.place)) return -1;
  if (!mesh_.can_collapse(h)) return -1;
  const int gone = int{is_triangle(h)} + int{is_triangle(o)};
  const kernels::Collapse one = kernels::collapse_of(kernels::PlainEdit(columns_), h);
  kernels::scatter_collapses({0, 1}, &one, columns_);
  at(b) = {of(a).quadric + of(b).quadric, evaluation.place};
  return gone;
}

bool ShrinkingMesh::is_triangle(HalfedgeId h) const noexcept {
  return view_.face(h).valid() && view_.next(view_.next(h)) == view_.prev(h);
}
// Whether a corner at `v` that stays would be turned over if `v` came to `place`.
bool ShrinkingMesh::folds(VertexId v, VertexId other, Double3 place) const noexcept {
  const Double3 here = of(v).position;
  for (const HalfedgeId h : outgoing_halfedges(view_, v)) {
    if (!view_.face(h).valid()) continue;
    const VertexId next = view_.target(h);
    const VertexId prev = view_.origin[view_.prev(h)];
    if (next == other || prev == other) continue;
    const Double3 p = of(next).position;
    const Double3 q = of(prev).position;
    const Double3 before = cross(p - here, q - here);
    const Double3 after = cross(p - place, q - place);
    if (!(dot(before, after) > 0) && dot(before, before) > 0) return true;
  }
  return false;
}

PackedIds ShrinkingMesh::pack() {
  std::optional<PackedIds> first;
  if (!packed_) {
    first = PackedIds{Buffer<Index>(static_cast<std::size_t>(view_.vertex_count())),
                      Buffer<Index>(static_cast<std::size_t>(view_.halfedge_count())),
                      Buffer<Index>(static_cast<std::size_t>(view_.face_count()))};
    for (Buffer<Index>* numbers : {&first->vertices, &first->halfedges, &first->faces}) {
      std::iota(numbers->begin(), numbers->end(), Index{0});
    }
  }
  PackedIds ids = Edit::pack(mesh_);
  view_ = mesh_.view();
  columns_ = Edit::columns(mesh_);
  for (std::size_t v = 0; v < ids.vertices.size(); ++v) {
    if (ids.vertices[v] >= 0) {
      vertices_[static_cast<std::size_t>(ids.vertices[v])] = vertices_[v];
    }
  }
  vertices_.truncate(static_cast<std::size_t>(view_.vertex_count()));
  if (first) packed_ = std::move(first);
  const auto follow = [](Buffer<Index>& numbers, const Buffer<Index>& next) {
    for (Index& i : numbers) i = i < 0 ? i : next[static_cast<std::size_t>(i)];
  };
  follow(packed_->vertices, ids.vertices);
  follow(packed_->halfedges, ids.halfedges);
  follow(packed_->faces, ids.faces);
  return ids;
}

namespace {

// The map of a mesh that was packed, from one of the numbers that it had then.
template <class Id>
std::vector<Id> unpacked(const Buffer<Index>& packed, const std::vector<Id>& map) {
  std::vector<Id> all(packed.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (packed[i] >= 0) all[i] = map[static_cast<std::size_t>(packed[i])];
  }
  return all;
}

}  // namespace

Result<DecimateOutput> ShrinkingMesh::finish(DecimateOutput&& output) const {
  Result<Compacted> compacted = mesh_.compact();
  if (!compacted) return fail(compacted.error());
  output.mesh = std::move(compacted->mesh);
  output.maps = std::move(compacted->maps);
  const auto count = static_cast<std::size_t>(output.mesh.vertex_count());
  output.positions = Buffer<float>(3 * count);
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const VertexId to = output.maps.vertices[v];
    if (!to.valid()) continue;
    const double cost = vertices_[v].quadric.at(vertices_[v].position);
    if (cost > 0 && std::isfinite(cost)) output.total_cost += cost;
    store(vertices_[v].position, output.positions.data() + 3 * static_cast<std::size_t>(to.value));
  }
  if (packed_) {
    output.maps = {unpacked(packed_->vertices, output.maps.vertices),
                   unpacked(packed_->halfedges, output.maps.halfedges),
                   unpacked(packed_->faces, output.maps.faces)};
  }
  return std::move(output);
}

}  // namespace hedgerow::decimation
