// Ids of different kinds are not compared.
#include "hedgerow/index.h"

bool same(hedgerow::VertexId v, hedgerow::FaceId f) {
#ifdef HEDGEROW_WRONG
  return v == f;
#else
  return v == hedgerow::VertexId(f.value);
#endif
}
