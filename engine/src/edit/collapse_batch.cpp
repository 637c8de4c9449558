#include "edit/batch.h"
#include "kernels/plain_edit.h"
#include "kernels/scatter_edits.h"

namespace hedgerow {
namespace {

/// The ring of a collapse are the vertices that have a face or an edge in common with one of its
/// ends. Two collapses meet if an end of one is in the ring of the other, which goes both ways.
///
/// If they do not meet, one leaves the answer of `can_collapse` for the other as it is. That answer
/// depends on the faces and edges at the ends, by their vertices, and on whether a hole beside the
/// edge has three sides. A collapse changes no faces or edges but those at its own ends, and these
/// have no corner at an end of the other. And along a hole there are two sides or more between
/// edges that do not meet, so a hole of which k > 1 edges are collapsed keeps 2 k sides. What they
/// write is disjoint for the same reason.
class CollapseKind {
 public:
  using Plan = kernels::Collapse;

  explicit CollapseKind(EditMesh& mesh)
      : mesh_(mesh),
        view_(mesh.view()),
        edit_(Edit::columns(mesh)),
        is_in_ring_(static_cast<std::size_t>(view_.vertex_count())) {}

  [[nodiscard]] EditCheck check(HalfedgeId h) const { return mesh_.can_collapse(h); }
  [[nodiscard]] Plan plan(HalfedgeId h) const noexcept { return kernels::collapse_of(edit_, h); }
  [[nodiscard]] bool claim(const Plan& plan) {
    const VertexId a = view_.origin[plan.halfedge];
    const VertexId b = view_.target(plan.halfedge);
    if (is_in_ring_[at(a)] || is_in_ring_[at(b)]) return false;
    writes_ += kWrites;
    mark_ring(a);
    mark_ring(b);
    return true;
  }
  [[nodiscard]] BatchRoom room() const noexcept { return {.writes = writes_}; }
  static void record(Edit& edit, const Plan& plan) { kernels::collapse_edge(edit, plan); }
  static void scatter(IndexRange range, const Plan* plans,
                      const kernels::EditColumns& columns) noexcept {
    kernels::scatter_collapses(range, plans, columns);
  }

 private:
  // Besides the origins: 15 links, 30 entries of half-edges that go, 7 of vertices, 4 of faces.
  static constexpr std::size_t kWrites = 60;

  static std::size_t at(VertexId v) noexcept { return static_cast<std::size_t>(v.value); }
  void mark_ring(VertexId v) {
    for (const HalfedgeId h : outgoing_halfedges(view_, v)) {
      ++writes_;
      is_in_ring_[at(view_.target(h))] = true;
      if (!view_.face(h).valid()) continue;
      for (const HalfedgeId side : halfedges_from(view_, h)) {
        is_in_ring_[at(view_.origin[side])] = true;
      }
    }
  }

  const EditMesh& mesh_;
  EditView view_;
  kernels::PlainEdit edit_;
  std::vector<bool> is_in_ring_;
  std::size_t writes_ = 0;
};

}  // namespace

EditBatch EditMesh::collapse_batch(std::span<const HalfedgeId> wanted, const Execution& execution) {
  return run_batch(*this, CollapseKind(*this), wanted, execution);
}

}  // namespace hedgerow
