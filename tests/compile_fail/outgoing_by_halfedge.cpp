// Vertex columns are not indexed by a half-edge.
#include "hedgerow/topology.h"

hedgerow::HalfedgeId outgoing_of(const hedgerow::PolygonView& mesh, hedgerow::HalfedgeId h) {
#ifdef HEDGEROW_WRONG
  return mesh.outgoing[h];
#else
  return mesh.outgoing[mesh.origin[h]];
#endif
}
