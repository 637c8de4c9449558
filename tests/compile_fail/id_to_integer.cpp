// An id does not become a plain integer unasked.
#include "hedgerow/index.h"

hedgerow::Index number_of(hedgerow::VertexId v) {
#ifdef HEDGEROW_WRONG
  return v;
#else
  return v.value;
#endif
}
