// Corner tables and directed edges: triangle meshes whose records have the numbers of half-edges.
#include <algorithm>
#include <utility>

#include "at.h"
#include "hedgerow/corner_table.h"
#include "hedgerow/directed_edge.h"
#include "kernels/triangle_records.h"
#include "parallel/parallel.h"
#include "represent/forms.h"
#include "represent/record_ids.h"
#include "triangle_mesh.h"

namespace hedgerow {

namespace {

Result<void> check_threes(std::size_t count) {
  if (count % 3 == 0) return {};
  return fail({ErrorCode::count_mismatch, kInvalidIndex, static_cast<std::int64_t>(count),
               static_cast<std::int64_t>(count - count % 3)});
}

}  // namespace

Result<CornerTable> build_corner_table(const Connectivity& mesh, const Execution& execution) {
  if (const Result<void> all = detail::check_triangles(mesh); !all) return fail(all.error());
  return detail::in_open_form(
      mesh, execution, [&](const Connectivity& opened) -> Result<CornerTable> {
        const TriangleView view = detail::triangles_of(opened);
        const auto count = at(view.halfedge_count());
        CornerTable table{Buffer<VertexId>(count), Buffer<CornerId>(count),
                          detail::ids_of<CornerId>(opened.outgoing(), execution),
                          Buffer<FanStart>::copy_of(opened.fans()), mesh.form()};
        par::for_each_range(
            execution, view.halfedge_count(), detail::kRecordGrain, [&](IndexRange range) {
              kernels::gather_corners(range, view, table.vertex.data(), table.opposite.data());
            });
        return table;
      });
}

Result<Connectivity> build_connectivity(const CornerTable& table, const Execution& execution) {
  if (const Result<void> threes = check_threes(table.vertex.size()); !threes) {
    return fail(threes.error());
  }
  if (table.opposite.size() != table.vertex.size()) {
    return fail({ErrorCode::count_mismatch, kInvalidIndex,
                 static_cast<std::int64_t>(table.opposite.size()), table.corner_count()});
  }
  Buffer<Index> opposite(table.vertex.size());
  par::for_each_range(execution, table.corner_count(), detail::kRecordGrain, [&](IndexRange range) {
    kernels::gather_opposites(range, CornerTableView(table), opposite.data());
  });
  ConnectivityColumns columns;
  columns.all_triangles = true;
  columns.origin = detail::numbers_of(table.vertex, execution);
  columns.opposite = std::move(opposite);
  columns.outgoing = detail::numbers_of(table.corner, execution);
  columns.fans = Buffer<FanStart>::copy_of(table.fans.span());
  return detail::to_form(Connectivity(std::move(columns)), table.form, execution);
}

Result<DirectedEdges> build_directed_edges(const Connectivity& mesh, const Execution& execution) {
  if (const Result<void> all = detail::check_triangles(mesh); !all) return fail(all.error());
  return detail::in_open_form(
      mesh, execution, [&](const Connectivity& opened) -> Result<DirectedEdges> {
        const TriangleView view = detail::triangles_of(opened);
        DirectedEdges edges{Buffer<DirectedEdge>(at(view.halfedge_count())),
                            detail::ids_of<HalfedgeId>(opened.outgoing(), execution),
                            Buffer<FanStart>::copy_of(opened.fans()), mesh.form()};
        par::for_each_range(execution, view.halfedge_count(), detail::kRecordGrain,
                            [&](IndexRange range) {
                              kernels::gather_directed_edges(range, view, edges.edges.data());
                            });
        return edges;
      });
}

Result<Connectivity> build_connectivity(const DirectedEdges& edges, const Execution& execution) {
  if (const Result<void> threes = check_threes(edges.edges.size()); !threes) {
    return fail(threes.error());
  }
  Buffer<Index> origin(edges.edges.size());
  Buffer<Index> opposite(edges.edges.size());
  par::for_each_range(execution, edges.edge_count(), detail::kRecordGrain, [&](IndexRange range) {
    kernels::gather_columns(range, edges.edges.data(), origin.data(), opposite.data());
  });
  ConnectivityColumns columns;
  columns.all_triangles = true;
  columns.origin = std::move(origin);
  columns.opposite = std::move(opposite);
  columns.outgoing = detail::numbers_of(edges.vertex_edge, execution);
  columns.fans = Buffer<FanStart>::copy_of(edges.fans.span());
  return detail::to_form(Connectivity(std::move(columns)), edges.form, execution);
}

}  // namespace hedgerow
