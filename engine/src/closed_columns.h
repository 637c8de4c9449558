#pragma once

#include <cstddef>
#include <span>

#include "hedgerow/buffer.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/result.h"

namespace hedgerow::detail {

/// The columns of a mesh in the closed form, all of them stored: `first` has F + 1 entries.
struct ClosedColumns {
  Buffer<Index> origin;
  Buffer<Index> opposite;
  Buffer<Index> outgoing;
  Buffer<Index> next;
  Buffer<Index> face;
  Buffer<Index> first;
  Buffer<FanStart> fans;
};

/// Those of a mesh in either form, fresh. Errors: too_many_elements. Throws std::bad_alloc.
[[nodiscard]] Result<ClosedColumns> closed_columns(const Connectivity& mesh,
                                                   const Execution& execution);

/// A copy of a column with room for `size` entries; those behind its own are not set.
[[nodiscard]] Buffer<Index> extended(std::span<const Index> column, std::size_t size);

}  // namespace hedgerow::detail
