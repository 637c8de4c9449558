// A face list is not made of floats.
#include <span>

#include "hedgerow/face_list.h"

hedgerow::FaceList faces_of(std::span<const float> positions, std::span<const int> corners) {
#ifdef HEDGEROW_WRONG
  return hedgerow::FaceList::triangles<hedgerow::Index>(positions, 3);
#else
  return hedgerow::FaceList::triangles<int>(corners, positions.size() / 3);
#endif
}
