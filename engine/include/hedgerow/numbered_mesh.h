#pragma once

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/index.h"

namespace hedgerow {

/// A mesh made from records that had numbers of their own.
struct NumberedMesh {
  Connectivity mesh;
  /// Of each record; invalid: the mesh has none for it, as the default form has none outside of the
  /// faces.
  Buffer<HalfedgeId> halfedge_of_record;
};

}  // namespace hedgerow
