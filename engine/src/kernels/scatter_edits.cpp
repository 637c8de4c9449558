#include "kernels/scatter_edits.h"

#include "kernels/plain_edit.h"

namespace hedgerow::kernels {

void scatter_collapses(IndexRange range, const Collapse* collapses,
                       const EditColumns& columns) noexcept {
  PlainEdit edit(columns);
  for (Index i = range.begin; i < range.end; ++i) collapse_edge(edit, collapses[i]);
}

void scatter_splits(IndexRange range, const Split* splits, const EditColumns& columns) noexcept {
  for (Index i = range.begin; i < range.end; ++i) {
    PlainEdit edit(columns, splits[i].vertex, splits[i].new_halfedge, splits[i].face);
    split_edge(edit, splits[i]);
  }
}

}  // namespace hedgerow::kernels
