// A column is not indexed by a plain integer.
#include "hedgerow/column.h"

hedgerow::FaceId face_of(hedgerow::Column<hedgerow::HalfedgeId, hedgerow::FaceId> face) {
#ifdef HEDGEROW_WRONG
  return face[0];
#else
  return face[hedgerow::HalfedgeId(0)];
#endif
}
