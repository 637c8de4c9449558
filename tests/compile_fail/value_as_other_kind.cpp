// What a column holds is not stored as another kind of id.
#include "hedgerow/topology.h"

bool is_boundary(const hedgerow::TriangleView& mesh, hedgerow::HalfedgeId h) {
#ifdef HEDGEROW_WRONG
  const hedgerow::FaceId other = mesh.opposite[h];
#else
  const hedgerow::HalfedgeId other = mesh.opposite[h];
#endif
  return !other.valid();
}
