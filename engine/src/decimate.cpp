#include "hedgerow/decimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "decimate/cost_buckets.h"
#include "decimate/quadric.h"
#include "float3_check.h"
#include "hedgerow/circulate.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

using decimation::CostBuckets;
using decimation::Double3;
using decimation::Quadric;
using decimation::widen;

constexpr Index kGrain = 1 << 12;
constexpr float kNoCost = std::numeric_limits<float>::infinity();
constexpr std::size_t kFetchHalfedges = 16;  // places ahead
constexpr std::size_t kFetchVertices = 8;
constexpr double kPointWeight = 1e-3;  // of the distance to where a vertex was, beside the planes

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

struct Vertex {
  Quadric quadric;
  Double3 position;
};

struct Collapse {
  float cost;
  Double3 place;
};

/// The mesh that shrinks, with the quadrics of its vertices.
class Decimator {
 public:
  Decimator(EditMesh&& mesh, const Positions& positions, const DecimateOptions& options,
            const Execution& execution)
      : mesh_(std::move(mesh)),
        view_(mesh_.view()),
        options_(options),
        vertices_(at(view_.vertex_count())),
        is_queued_(at(view_.halfedge_count()), 0) {
    mesh_.set_recording(false);
    fill_vertices(positions, execution);
  }

  Result<DecimateOutput> run(const Execution& execution) {
    enter_all(execution);
    DecimateOutput output;
    output.end = shrink(output);
    Result<Compacted> compacted = mesh_.compact();
    if (!compacted) return fail(compacted.error());
    output.mesh = std::move(compacted->mesh);
    output.maps = std::move(compacted->maps);
    output.positions = Buffer<float>(3 * at(output.mesh.vertex_count()));
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      const VertexId to = output.maps.vertices[v];
      if (to.valid()) store(vertices_[v].position, output.positions.data() + 3 * at(to.value));
    }
    return output;
  }

 private:
  static void store(Double3 p, float* to) noexcept {
    to[0] = static_cast<float>(p.x);
    to[1] = static_cast<float>(p.y);
    to[2] = static_cast<float>(p.z);
  }
  // A place as it will be stored: later costs are of what is written, not of what was meant.
  static Double3 as_stored(Double3 p) noexcept {
    float stored[3];
    store(p, stored);
    return widen(stored);
  }
  [[nodiscard]] Vertex& of(VertexId v) noexcept { return vertices_[at(v.value)]; }
  [[nodiscard]] const Vertex& of(VertexId v) const noexcept { return vertices_[at(v.value)]; }

  // Each vertex gathers what its faces and boundary edges give, in the order of rotation, so that
  // no two threads write to one.
  void fill_vertices(const Positions& positions, const Execution& execution) {
    par::for_each_range(execution, view_.vertex_count(), kGrain, [&](IndexRange range) {
      for (Index v = range.begin; v < range.end; ++v) {
        vertices_[at(v)].position = widen(positions[v]);
      }
    });
    par::for_each_range(execution, view_.vertex_count(), kGrain, [&](IndexRange range) {
      for (Index v = range.begin; v < range.end; ++v) {
        vertices_[at(v)].quadric = gathered(VertexId(v));
      }
    });
  }
  [[nodiscard]] Quadric gathered(VertexId v) const noexcept {
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
  [[nodiscard]] Double3 corner_vector(HalfedgeId h) const noexcept {
    const Double3 here = of(view_.origin[h]).position;
    return cross(of(view_.target(h)).position - here,
                 of(view_.origin[view_.prev(h)]).position - here);
  }
  // The plane that stands on the edge of a boundary half-edge.
  [[nodiscard]] Quadric on_boundary(HalfedgeId h) const noexcept {
    const HalfedgeId inner = view_.opposite[h];
    if (view_.face(h).valid() || !view_.face(inner).valid()) return {};
    const Double3 from = of(view_.origin[inner]).position;
    const Double3 along = of(view_.target(inner)).position - from;
    const Double3 side = cross(along, corner_vector(inner));
    const double length = std::sqrt(dot(side, side));
    if (!(length > 0)) return {};
    return Quadric::of_plane(side * (1 / length), from,
                             options_.boundary_weight * dot(along, along));
  }

  [[nodiscard]] Collapse evaluate(HalfedgeId h) const noexcept {
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
  void enter_all(const Execution& execution) {
    std::vector<float> costs(at(view_.halfedge_count()));
    par::for_each_range(execution, view_.halfedge_count(), kGrain, [&](IndexRange range) {
      for (Index h = range.begin; h < range.end; ++h) {
        const bool is_first = HalfedgeId(h) < view_.opposite[HalfedgeId(h)];
        costs[at(h)] = is_first ? evaluate(HalfedgeId(h)).cost : kNoCost;
      }
    });
    for (Index h = 0; h < view_.halfedge_count(); ++h) enter(HalfedgeId(h), costs[at(h)]);
  }
  void enter(HalfedgeId h, float cost) {
    if (!std::isfinite(cost)) return;
    queue_.push(cost, h.value);
    is_queued_[at(h.value)] = 1;
  }

  DecimateEnd shrink(DecimateOutput& output) {
    std::int64_t faces = view_.face_count();
    while (faces > options_.faces) {
      const HalfedgeId h(queue_.pop());
      if (!h.valid()) return DecimateEnd::refused;
      fetch_ahead();
      if (!mesh_.has(h)) continue;
      is_queued_[at(h.value)] = 0;
      const Collapse collapse = evaluate(h);
      if (!std::isfinite(collapse.cost)) continue;
      if (CostBuckets::bucket_of(collapse.cost) > queue_.current()) {
        enter(h, collapse.cost);
        continue;
      }
      const auto cost = static_cast<double>(collapse.cost);
      if (cost > options_.max_cost) return DecimateEnd::max_cost;
      const VertexId kept = view_.target(h);
      const std::int64_t gone = do_collapse(h, collapse);
      if (gone < 0) continue;
      enter_ring(kept);
      faces -= gone;
      ++output.collapses;
      output.largest_cost = std::max(output.largest_cost, cost);
    }
    return DecimateEnd::faces;
  }
  // Costs are evaluated at places far apart: most of the time would be spent waiting for them.
  void fetch_ahead() const noexcept {
    if (const Index far = queue_.ahead(kFetchHalfedges); far != kInvalidIndex) {
      __builtin_prefetch(view_.origin.data() + far);
      __builtin_prefetch(view_.opposite.data() + far);
      __builtin_prefetch(view_.next_of.data() + far);
    }
    if (const HalfedgeId near(queue_.ahead(kFetchVertices)); mesh_.has(near)) {
      for (const VertexId v : {view_.origin[near], view_.target(near)}) {
        __builtin_prefetch(&of(v));
        __builtin_prefetch(&of(v).position);
      }
    }
  }

  // How many faces went; -1: refused.
  std::int64_t do_collapse(HalfedgeId h, const Collapse& collapse) {
    const HalfedgeId o = view_.opposite[h];
    const VertexId a = view_.origin[h];
    const VertexId b = view_.origin[o];
    if (folds(a, b, collapse.place) || folds(b, a, collapse.place)) return -1;
    const std::int64_t gone = is_triangle(h) + is_triangle(o);
    if (!mesh_.collapse(h)) return -1;
    view_ = mesh_.view();
    of(b) = {of(a).quadric + of(b).quadric, collapse.place};
    return gone;
  }
  [[nodiscard]] bool is_triangle(HalfedgeId h) const noexcept {
    return view_.face(h).valid() && view_.next(view_.next(h)) == view_.prev(h);
  }
  // Whether a corner at `v` that stays would be turned over if `v` came to `place`.
  [[nodiscard]] bool folds(VertexId v, VertexId other, Double3 place) const noexcept {
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
  // What is not queued beside a vertex that moved: edges that were refused, and may be possible
  // now; and those that two edges of a triangle became, neither of them by its queued half-edge.
  void enter_ring(VertexId v) {
    for (const HalfedgeId h : outgoing_halfedges(view_, v)) {
      if ((is_queued_[at(h.value)] | is_queued_[at(view_.opposite[h].value)]) != 0) continue;
      enter(h, evaluate(h).cost);
    }
  }

  EditMesh mesh_;
  EditView view_;
  DecimateOptions options_;
  std::vector<Vertex> vertices_;
  CostBuckets queue_;
  std::vector<char> is_queued_;  // by half-edge: the queue has its edge under this name
};

}  // namespace

Result<DecimateOutput> decimate(const Connectivity& mesh, const Positions& positions,
                                const DecimateOptions& options, const Execution& execution) {
  if (const auto ok = detail::check_float3(positions, mesh.vertex_count()); !ok) {
    return fail(ok.error());
  }
  Result<EditMesh> edited = EditMesh::of(mesh, execution);
  if (!edited) return fail(edited.error());
  return Decimator(std::move(*edited), positions, options, execution).run(execution);
}

}  // namespace hedgerow
