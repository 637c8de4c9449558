// A column keyed by vertices is not indexed by a face.
#include "hedgerow/column.h"

hedgerow::VertexId merged(hedgerow::Column<hedgerow::VertexId, hedgerow::VertexId> target) {
#ifdef HEDGEROW_WRONG
  return target[hedgerow::FaceId(0)];
#else
  return target[hedgerow::VertexId(0)];
#endif
}
