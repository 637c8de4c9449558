#include "stored_form.h"

#include <utility>

namespace hedgerow::bench {

namespace {

ConnectivityColumns shared_columns(const Connectivity& mesh) {
  ConnectivityColumns columns;
  columns.origin = ColumnStorage::borrow(mesh.origin());
  columns.opposite = ColumnStorage::borrow(mesh.opposite());
  columns.outgoing = ColumnStorage::borrow(mesh.outgoing());
  columns.fans = Buffer<FanStart>::copy_of(mesh.fans());
  columns.all_triangles = mesh.is_triangle_mesh();
  return columns;
}

template <class Key, class Value>
Buffer<Index> copy_of(const Column<Key, Value>& column) {
  return Buffer<Index>::copy_of({column.data(), static_cast<std::size_t>(column.size())});
}

}  // namespace

std::shared_ptr<const Connectivity> stored_form(const Dataset& data) {
  Connectivity both(shared_columns(data.mesh));
  both.materialise(Execution::serial());
  const PolygonView view = both.polygons();
  ConnectivityColumns columns = shared_columns(data.mesh);
  columns.all_triangles = false;
  columns.next = copy_of(view.next_of);
  columns.face = copy_of(view.face_of);
  columns.first = copy_of(view.first_of);
  return std::make_shared<const Connectivity>(std::move(columns));
}

}  // namespace hedgerow::bench
