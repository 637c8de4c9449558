#pragma once

#include <cstdint>
#include <vector>

#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"

namespace hedgerow {

/// What a violation is about.
enum class ElementKind : std::uint8_t { mesh, vertex, halfedge, face };

/// One relation that does not hold.
struct Violation {
  std::uint8_t invariant = 0;  ///< 1 to 8, as numbered in engine/DESIGN.md
  ElementKind kind{};
  Index element = kInvalidIndex;
  const char* relation = "";  ///< e.g. "opposite[opposite[h]] == h"; static text
  std::int64_t expected = 0;  ///< where a value is out of range: the count to stay below
  std::int64_t got = 0;
};

/// Checks I1 to I8 on every element and returns all violations, sorted by invariant, element kind,
/// element and relation; empty if the mesh is sound.
///
/// A mesh whose columns hold any values at all may be passed: nothing is followed before it is
/// known to be in range, and no walk is longer than the mesh. I6 holds for each fan of a vertex by
/// itself. Columns of lengths that disagree are all that is reported of such a mesh.
///
/// Pre        None. Throws std::bad_alloc.
/// Complexity O(V + H + F), no cap on valence or degree; reads every column about three times.
/// Threads    Those of `execution`; the same list for all of them.
[[nodiscard]] std::vector<Violation> validate(const Connectivity& mesh, const Execution& execution);

}  // namespace hedgerow
