#pragma once

#include "hedgerow/index.h"

namespace hedgerow::kernels {

/// The columns of a mesh in the closed form that is being edited; `first` has one entry a face.
struct EditColumns {
  Index* origin;
  Index* opposite;
  Index* next;  ///< -1: removed
  Index* prev;
  Index* face;
  Index* outgoing;
  Index* is_gone;  ///< of a vertex
  Index* first;    ///< -1: removed
};

}  // namespace hedgerow::kernels
