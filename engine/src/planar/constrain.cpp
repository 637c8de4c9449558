// Edges that a triangulation must have: S. Sloan, "A fast algorithm for generating constrained
// Delaunay triangulations", 1993. Crossing edges are flipped until none crosses.
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "at.h"
#include "hedgerow/assert.h"
#include "hedgerow/circulate.h"
#include "hedgerow/edit.h"
#include "hedgerow/triangulate.h"
#include "kernels/predicates.h"

namespace hedgerow {

namespace {

class Constrainer {
 public:
  Constrainer(EditMesh& mesh, std::span<const Point2> points)
      : mesh_(mesh),
        points_(points),
        constraint_of_(static_cast<std::size_t>(mesh.halfedge_count()), kInvalidIndex) {}

  /// Makes the edges from `a` to `b` part of the mesh: several if points lie on the way. Returns
  /// the earlier constraint that is in the way, if there is one.
  std::optional<Index> insert(VertexId a, VertexId b, Index constraint) {
    while (a != b) {
      const Step step = first_step(a, b);
      VertexId reached = step.reached;
      if (step.crossed.valid()) {
        if (const std::optional<Index> met = find_crossed(step.crossed, a, b, reached)) return met;
        clear_way(a, reached);
      }
      mark(mesh_.find(a, reached), constraint);
      a = reached;
    }
    return std::nullopt;
  }

  /// Flips what the insertions have left not Delaunay, but for the constraints.
  void restore() {
    while (!changed_.empty()) {
      const HalfedgeId h = edge_of(changed_.back());
      changed_.pop_back();
      if (is_constrained(h) || !is_illegal(h) || !mesh_.flip(h)) continue;
      push_round(h);
    }
  }

  [[nodiscard]] bool is_constrained(HalfedgeId h) const {
    return constraint_of_[at(edge_of(h).value)] != kInvalidIndex;
  }

 private:
  // How a line leaves a vertex: along an edge to `reached`, or across the edge `crossed`.
  struct Step {
    VertexId reached;
    HalfedgeId crossed;
  };

  [[nodiscard]] EditView view() const noexcept { return mesh_.view(); }
  [[nodiscard]] const Point2& point(VertexId v) const noexcept { return points_[at(v.value)]; }
  [[nodiscard]] int turn(VertexId a, VertexId b, VertexId c) const noexcept {
    return kernels::orient2d(point(a), point(b), point(c));
  }
  // An edge has the number of its first half-edge.
  [[nodiscard]] HalfedgeId edge_of(HalfedgeId h) const noexcept {
    return std::min(h, view().opposite[h]);
  }
  void mark(HalfedgeId h, Index constraint) {
    HEDGEROW_ASSERT(h.valid());
    Index& entry = constraint_of_[at(edge_of(h).value)];
    if (entry == kInvalidIndex) entry = constraint;
  }
  // Of c on the line through a and b.
  [[nodiscard]] bool is_ahead(VertexId a, VertexId b, VertexId c) const noexcept {
    const auto lies = [](double from, double to, double p) {
      return from < to ? p > from : from > to ? p < from : false;
    };
    return lies(point(a)[0], point(b)[0], point(c)[0]) ||
           lies(point(a)[1], point(b)[1], point(c)[1]);
  }

  // \pre a and b differ; the triangulation is convex, so that there is a way.
  [[nodiscard]] Step first_step(VertexId a, VertexId b) const {
    const EditView mesh = view();
    Step step;
    for (const HalfedgeId h : outgoing_halfedges(mesh, a)) {
      const VertexId v = mesh.target(h);
      const int side = turn(a, b, v);
      if (side == 0 && is_ahead(a, b, v)) return {v, {}};
      if (!mesh.face(h).valid()) continue;
      const HalfedgeId across = mesh.next(h);
      if (side < 0 && turn(a, b, mesh.target(across)) > 0) step = {{}, across};
    }
    return step;
  }

  // The edges that the line crosses until it comes to a vertex, which is `reached` then.
  std::optional<Index> find_crossed(HalfedgeId crossed, VertexId a, VertexId b, VertexId& reached) {
    crossed_.clear();
    const EditView mesh = view();
    for (HalfedgeId h = crossed;;) {
      const Index met = constraint_of_[at(edge_of(h).value)];
      if (met != kInvalidIndex) return met;
      crossed_.push_back(h);
      const HalfedgeId o = mesh.opposite[h];
      const VertexId across = mesh.origin[mesh.prev(o)];
      const int side = turn(a, b, across);
      if (side == 0) {
        reached = across;
        return std::nullopt;
      }
      // o runs from the left of the line to its right; h always from the right to the left.
      h = side > 0 ? mesh.next(o) : mesh.prev(o);
    }
  }

  // Flips the crossed edges until none crosses the line from a to b.
  void clear_way(VertexId a, VertexId b) {
    while (!crossed_.empty()) {
      const HalfedgeId h = crossed_.front();
      crossed_.pop_front();
      if (!is_convex(h) || !mesh_.flip(h)) {
        crossed_.push_back(h);
        continue;
      }
      push_round(h);
      const VertexId c = view().origin[h];
      const VertexId d = view().target(h);
      const bool crosses =
          c != a && c != b && d != a && d != b && turn(a, b, c) * turn(a, b, d) < 0;
      if (crosses) {
        crossed_.push_back(h);
      } else {
        changed_.push_back(h);
      }
    }
  }

  // The other edges of both triangles.
  void push_round(HalfedgeId h) {
    const EditView mesh = view();
    for (const HalfedgeId side : {h, mesh.opposite[h]}) {
      changed_.push_back(mesh.next(side));
      changed_.push_back(mesh.prev(side));
    }
  }

  struct Across {
    VertexId left;
    VertexId right;
  };
  [[nodiscard]] Across across(HalfedgeId h) const noexcept {
    return {view().origin[view().prev(h)], view().origin[view().prev(view().opposite[h])]};
  }
  [[nodiscard]] bool is_convex(HalfedgeId h) const noexcept {
    const auto [left, right] = across(h);
    return turn(right, left, view().origin[h]) > 0 && turn(left, right, view().target(h)) > 0;
  }
  [[nodiscard]] bool is_illegal(HalfedgeId h) const noexcept {
    const EditView mesh = view();
    if (!mesh.face(h).valid() || !mesh.face(mesh.opposite[h]).valid()) return false;
    const auto [left, right] = across(h);
    return kernels::incircle(point(mesh.origin[h]), point(mesh.target(h)), point(left),
                             point(right)) > 0;
  }

  EditMesh& mesh_;
  std::span<const Point2> points_;
  std::vector<Index> constraint_of_;  // by edge
  std::deque<HalfedgeId> crossed_;
  std::vector<HalfedgeId> changed_;
};

Result<void> check_edges(std::span<const std::array<Index, 2>> edges, Index point_count,
                         std::span<const Index> same_as) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto element = static_cast<Index>(i);
    for (const Index end : edges[i]) {
      if (end < 0 || end >= point_count) {
        return fail({ErrorCode::index_out_of_range, element, end, point_count});
      }
    }
    const auto first = [&](Index p) {
      return same_as.empty() ? p : same_as[static_cast<std::size_t>(p)];
    };
    if (first(edges[i][0]) == first(edges[i][1])) {
      return fail({ErrorCode::repeated_vertex, element, edges[i][1]});
    }
  }
  return {};
}

}  // namespace

Result<ConstrainedTriangulation> triangulate_constrained(
    std::span<const Point2> points, std::span<const std::array<Index, 2>> edges,
    const Execution& execution) {
  Result<Triangulation> made = triangulate(points, execution);
  if (!made) return fail(made.error());
  const std::span<const Index> same_as = made->same_as.span();
  if (const Result<void> checked = check_edges(edges, made->mesh.vertex_count(), same_as);
      !checked) {
    return fail(checked.error());
  }
  if (made->mesh.face_count() == 0) {
    return ConstrainedTriangulation{std::move(made->mesh), std::move(made->same_as), {}};
  }
  Result<EditMesh> mesh = EditMesh::of(made->mesh, execution);
  if (!mesh) return fail(mesh.error());
  mesh->set_recording(false);
  Constrainer constrainer(*mesh, points);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto vertex = [&](Index p) {
      return VertexId(same_as.empty() ? p : same_as[static_cast<std::size_t>(p)]);
    };
    const auto constraint = static_cast<Index>(i);
    const std::optional<Index> met =
        constrainer.insert(vertex(edges[i][0]), vertex(edges[i][1]), constraint);
    if (met) return fail({ErrorCode::crossing_edges, constraint, *met});
  }
  constrainer.restore();
  Result<Compacted> compact = mesh->compact();
  if (!compact) return fail(compact.error());
  std::vector<Index> constrained;
  for (HalfedgeId h(0); h.value < mesh->halfedge_count(); ++h.value) {
    const HalfedgeId now = compact->maps.halfedges[static_cast<std::size_t>(h.value)];
    if (now.valid() && constrainer.is_constrained(h)) constrained.push_back(now.value);
  }
  std::sort(constrained.begin(), constrained.end());
  return ConstrainedTriangulation{std::move(compact->mesh), std::move(made->same_as),
                                  Buffer<Index>::copy_of(constrained)};
}

}  // namespace hedgerow
