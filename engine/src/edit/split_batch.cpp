#include "at.h"
#include "edit/batch.h"
#include "kernels/plain_edit.h"
#include "kernels/scatter_edits.h"

namespace hedgerow {
namespace {

/// Splits meet in triangles, which are cut. In other faces and in holes each writes what belongs to
/// its own side alone, and leaves the others their answer: no face becomes a triangle, and a vertex
/// across a triangle stays where it is.
class SplitKind {
 public:
  using Plan = kernels::Split;

  explicit SplitKind(EditMesh& mesh)
      : mesh_(mesh),
        view_(mesh.view()),
        edit_(Edit::columns(mesh)),
        vertices_(mesh.vertex_count()),
        halfedges_(mesh.halfedge_count()),
        faces_(mesh.face_count()),
        is_cut_(at(faces_)),
        is_split_(at(halfedges_)) {}

  [[nodiscard]] EditCheck check(HalfedgeId h) const { return mesh_.can_split_edge(h); }
  [[nodiscard]] Plan plan(HalfedgeId h) const noexcept { return kernels::split_of(edit_, h); }
  // Claims the place, and takes the next numbers.
  [[nodiscard]] bool claim(Plan& plan) {
    const HalfedgeId h = plan.halfedge;
    const HalfedgeId o = view_.opposite[h];
    if (is_split_[at(h.value)] || !has_room(plan)) return false;
    if (plan.cuts_left && is_cut_[at(view_.face(h).value)]) return false;
    if (plan.cuts_right && is_cut_[at(view_.face(o).value)]) return false;
    is_split_[at(h.value)] = is_split_[at(o.value)] = true;
    if (plan.cuts_left) is_cut_[at(view_.face(h).value)] = true;
    if (plan.cuts_right) is_cut_[at(view_.face(o).value)] = true;
    plan.vertex = VertexId(vertices_++);
    plan.new_halfedge = HalfedgeId(halfedges_);
    plan.face = FaceId(faces_);
    halfedges_ += plan.new_halfedges();
    faces_ += plan.new_faces();
    return true;
  }
  [[nodiscard]] BatchRoom room() const noexcept {
    const Index made = vertices_ - view_.vertex_count();
    return {made, halfedges_ - view_.halfedge_count(), faces_ - view_.face_count(),
            kWrites * at(made)};
  }
  static void record(Edit& edit, const Plan& plan) { kernels::split_edge(edit, plan); }
  static void scatter(IndexRange range, const Plan* plans,
                      const kernels::EditColumns& columns) noexcept {
    kernels::scatter_splits(range, plans, columns);
  }

 private:
  // 17 to insert a vertex; 21 for each triangle that is cut.
  static constexpr std::size_t kWrites = 60;

  [[nodiscard]] bool has_room(const Plan& plan) const noexcept {
    return vertices_ < kMaxCount && plan.new_halfedges() <= kMaxCount - halfedges_ &&
           plan.new_faces() <= kMaxCount - faces_;
  }

  const EditMesh& mesh_;
  EditView view_;
  kernels::PlainEdit edit_;
  Index vertices_;  // counted with what the batch makes
  Index halfedges_;
  Index faces_;
  std::vector<bool> is_cut_;    // triangles
  std::vector<bool> is_split_;  // half-edges
};

}  // namespace

EditBatch EditMesh::split_batch(std::span<const HalfedgeId> wanted, const Execution& execution) {
  return run_batch(*this, SplitKind(*this), wanted, execution);
}

}  // namespace hedgerow
