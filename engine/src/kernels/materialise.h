#pragma once

#include "hedgerow/index.h"

/// Kernels that store what is arithmetic. Ranges that partition the faces write disjoint elements:
/// those of their own faces.
namespace hedgerow::kernels {

/// `next`, `face` and `first` of the triangles in `faces`.
void fill_triangle_columns(IndexRange faces, Index* next, Index* face, Index* first) noexcept;

/// `next` and `face` of the polygons in `faces`, whose half-edges are first[f] .. first[f + 1] - 1.
void fill_polygon_columns(IndexRange faces, const Index* first, Index* next, Index* face) noexcept;

}  // namespace hedgerow::kernels
