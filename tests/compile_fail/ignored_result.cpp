// A result that may be an error is not dropped.
#include "hedgerow/face_list.h"

bool is_usable(const hedgerow::FaceList& faces) {
#ifdef HEDGEROW_WRONG
  hedgerow::check(faces);
  return true;
#else
  return hedgerow::check(faces).has_value();
#endif
}
