// A query is not asked about the wrong kind of element.
#include "hedgerow/topology.h"

hedgerow::HalfedgeId start(const hedgerow::PolygonView& mesh, hedgerow::HalfedgeId h) {
#ifdef HEDGEROW_WRONG
  return mesh.first(h);
#else
  return mesh.first(mesh.face(h));
#endif
}
