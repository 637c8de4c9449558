#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"

namespace hedgerow {

/// 64-bit hash of origin, next, opposite, face, outgoing, first and the fan table: equal meshes
/// have equal digests whether the columns are stored or implicit, for 32- and 64-bit indices, and
/// for every thread count. Not cryptographic.
///
/// Complexity O(V + H + F); reads the stored columns once. Throws std::bad_alloc: eight bytes for
///            every 16,384 elements.
/// Threads    Those of `execution`.
[[nodiscard]] std::uint64_t digest(const Connectivity& mesh, const Execution& execution);

/// The same hash over raw bytes, for results such as normals: the same number on all machines with
/// one byte order. O(bytes), on the calling thread.
[[nodiscard]] std::uint64_t digest(std::span<const std::byte> bytes) noexcept;

}  // namespace hedgerow
