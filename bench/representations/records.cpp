// The arrays of records that the core is converted to.
#include "hedgerow/corner_table.h"
#include "hedgerow/dcel.h"
#include "hedgerow/directed_edge.h"
#include "hedgerow/split_edge.h"
#include "hedgerow/winged_edge.h"
#include "representations/built.h"
#include "representations/topology_walk.h"

namespace hedgerow::bench {

namespace {

const Execution kSerial = Execution::serial();

}  // namespace

std::unique_ptr<Representation> build_directed_edge(const FaceList& faces, Positions positions) {
  DirectedEdges edges = value_of(build_directed_edges(built_core(faces), kSerial));
  const std::size_t bytes = edges.bytes();
  return viewed<DirectedEdgeView, false>(std::move(edges), bytes, positions);
}

std::unique_ptr<Representation> build_corner_tables(const FaceList& faces, Positions positions) {
  CornerTable table = value_of(build_corner_table(built_core(faces), kSerial));
  const std::size_t bytes = table.bytes();
  return viewed<CornerTableView, false>(std::move(table), bytes, positions);
}

std::unique_ptr<Representation> build_dcel_records(const FaceList& faces, Positions positions) {
  Dcel dcel = value_of(build_dcel(built_core(faces), kSerial));
  const std::size_t bytes = dcel.bytes();
  return viewed<DcelView, true>(std::move(dcel), bytes, positions);
}

std::unique_ptr<Representation> build_split_edge(const FaceList& faces, Positions positions) {
  SplitEdges edges = value_of(build_split_edges(built_core(faces), kSerial));
  const std::size_t bytes = edges.bytes();
  return viewed<SplitEdgeView, true>(std::move(edges), bytes, positions);
}

std::unique_ptr<Representation> build_winged_tables(const FaceList& faces, Positions positions) {
  WingedEdgeTables tables = value_of(build_winged_edges(built_core(faces)));
  const std::size_t bytes =
      tables.vertex_edge.size_bytes() + tables.face_edge.size_bytes() + tables.edges.size_bytes();
  return viewed<WingedEdgeView, false>(std::move(tables), bytes, positions);
}

}  // namespace hedgerow::bench
