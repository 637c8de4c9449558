// Half-edge columns are not indexed by a vertex.
#include "hedgerow/topology.h"

hedgerow::VertexId origin_of(const hedgerow::TriangleView& mesh, hedgerow::VertexId v,
                             hedgerow::HalfedgeId h) {
#ifdef HEDGEROW_WRONG
  return h.valid() ? mesh.origin[v] : v;
#else
  return v.valid() ? mesh.origin[h] : v;
#endif
}
