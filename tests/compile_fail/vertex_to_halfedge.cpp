// A vertex id is not assigned to a half-edge id.
#include "hedgerow/index.h"

hedgerow::HalfedgeId copied(hedgerow::VertexId v) {
  hedgerow::HalfedgeId h;
#ifdef HEDGEROW_WRONG
  h = v;
#else
  h = hedgerow::HalfedgeId(v.value);
#endif
  return h;
}
