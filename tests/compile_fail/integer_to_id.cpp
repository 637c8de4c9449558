// A plain integer does not become an id unasked.
#include "hedgerow/index.h"

hedgerow::FaceId first_face() {
#ifdef HEDGEROW_WRONG
  return 0;
#else
  return hedgerow::FaceId(0);
#endif
}
