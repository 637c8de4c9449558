// A mesh is not copied by accident.
#include <utility>

#include "hedgerow/connectivity.h"

hedgerow::Connectivity kept(hedgerow::Connectivity& mesh) {
#ifdef HEDGEROW_WRONG
  return mesh;
#else
  return std::move(mesh);
#endif
}
