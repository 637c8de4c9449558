#pragma once

#include "peers/measured_mesh.h"

namespace hedgerow::bench {

// One function per library, each in a source file of its own; present only if CMake found it.
extern const Peer kPointerPeer;
extern const Peer kStructPeer;
extern const Peer kOpenMeshPeer;
extern const Peer kCgalPeer;

}  // namespace hedgerow::bench
