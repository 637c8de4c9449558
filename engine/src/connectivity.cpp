#include "hedgerow/connectivity.h"

#include "kernels/materialise.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {
constexpr Index kMaterialiseGrain = 1 << 16;  // faces a task: 1.5 MB written
}

Connectivity::Connectivity(ConnectivityColumns&& columns) noexcept
    : columns_(std::move(columns)),
      face_count_(columns_.first.empty() ? columns_.origin.size() / 3 : columns_.first.size() - 1) {
}

TriangleView Connectivity::triangles() const noexcept {
  HEDGEROW_ASSERT(is_implicit());
  return {{columns_.origin.data(), columns_.origin.size()},
          {columns_.opposite.data(), columns_.opposite.size()},
          {columns_.outgoing.data(), columns_.outgoing.size()},
          fans()};
}

PolygonView Connectivity::polygons() const noexcept {
  HEDGEROW_ASSERT(is_explicit());
  return {{columns_.origin.data(), columns_.origin.size()},
          {columns_.opposite.data(), columns_.opposite.size()},
          {columns_.outgoing.data(), columns_.outgoing.size()},
          {columns_.next.data(), columns_.next.size()},
          {columns_.face.data(), columns_.face.size()},
          {columns_.first.data(), columns_.first.size()},
          fans()};
}

void Connectivity::materialise(const Execution& execution) {
  if (is_explicit()) return;
  const auto halfedges = static_cast<std::size_t>(halfedge_count());
  Buffer<Index> next(halfedges);
  Buffer<Index> face(halfedges);
  Buffer<Index> first(static_cast<std::size_t>(face_count_) + 1);
  par::for_each_range(execution, face_count_, kMaterialiseGrain, [&](IndexRange faces) {
    kernels::fill_triangle_columns(faces, next.data(), face.data(), first.data());
  });
  first[first.size() - 1] = halfedge_count();
  columns_.next = std::move(next);
  columns_.face = std::move(face);
  columns_.first = std::move(first);
}

std::size_t Connectivity::bytes() const noexcept {
  const auto indices = columns_.origin.span().size() + columns_.opposite.span().size() +
                       columns_.outgoing.span().size() + columns_.next.span().size() +
                       columns_.face.span().size() + columns_.first.span().size();
  return indices * sizeof(Index) + columns_.fans.size_bytes();
}

}  // namespace hedgerow
