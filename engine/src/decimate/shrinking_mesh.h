#pragma once

#include <cstdint>
#include <optional>

#include "decimate/quadric.h"
#include "edit/edit.h"
#include "hedgerow/buffer.h"
#include "hedgerow/decimate.h"

namespace hedgerow::decimation {

struct ShrinkingVertex {
  Quadric quadric;
  Double3 position;
};

/// What a collapse costs, and where it would put the vertex that stays.
struct Evaluation {
  float cost;  ///< not finite: never to be done
  Double3 place;
};

/// A mesh whose edges are collapsed, with the quadrics of its vertices.
///
/// Threads    `collapse` writes vertices, half-edges and faces with a corner in the ring of its
///            edge, and all questions about an edge read no others: rings that do not meet may be
///            worked on at once. The ring: vertices with a face or an edge in common with an end.
class ShrinkingMesh {
 public:
  /// Throws std::bad_alloc; nothing else does.
  ShrinkingMesh(EditMesh&& mesh, const Positions& positions, double boundary_weight,
                const Execution& execution);

  [[nodiscard]] const EditMesh& mesh() const noexcept { return mesh_; }
  /// Of this mesh for good: renewed when it is packed.
  [[nodiscard]] const EditView& view() const noexcept { return view_; }
  [[nodiscard]] const ShrinkingVertex& of(VertexId v) const noexcept {
    return vertices_[static_cast<std::size_t>(v.value)];
  }

  [[nodiscard]] Evaluation evaluate(HalfedgeId h) const noexcept;
  /// How many faces went, or -1: it would turn a face over, or `EditMesh::can_collapse` says no.
  int collapse(HalfedgeId h, const Evaluation& evaluation) noexcept;
  /// Numbers what is left anew, in its order, and tells how. Between edits; throws std::bad_alloc.
  [[nodiscard]] PackedIds pack();
  /// The counts, and what is left with new numbers.
  [[nodiscard]] Result<DecimateOutput> finish(DecimateOutput&& output) const;

 private:
  [[nodiscard]] ShrinkingVertex& at(VertexId v) noexcept {
    return vertices_[static_cast<std::size_t>(v.value)];
  }
  [[nodiscard]] Quadric gathered(VertexId v) const noexcept;
  [[nodiscard]] Double3 corner_vector(HalfedgeId h) const noexcept;
  [[nodiscard]] Quadric on_boundary(HalfedgeId h) const noexcept;
  [[nodiscard]] bool is_triangle(HalfedgeId h) const noexcept;
  [[nodiscard]] bool folds(VertexId v, VertexId other, Double3 place) const noexcept;

  EditMesh mesh_;
  EditView view_;
  kernels::EditColumns columns_;
  double boundary_weight_;
  Buffer<ShrinkingVertex> vertices_;
  std::optional<PackedIds> packed_;  // from the numbers at first to those of now
};

}  // namespace hedgerow::decimation
