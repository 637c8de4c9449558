#pragma once

#include <cstdint>

#include "hedgerow/buffer.h"
#include "hedgerow/execution.h"
#include "hedgerow/index.h"
#include "kernels/radix.h"

namespace hedgerow::detail {

/// The items in ascending order of their keys, equal keys as they came: which makes the order the
/// same however the work is cut.
///
/// Complexity O(n) for each 11 bits in which the keys differ; scratch as large as `items`.
template <class Key>
[[nodiscard]] Buffer<Index> sorted_items(Buffer<kernels::Keyed<Key>>&& items,
                                         const Execution& execution);
extern template Buffer<Index> sorted_items(Buffer<kernels::Keyed<std::uint32_t>>&&,
                                           const Execution&);
extern template Buffer<Index> sorted_items(Buffer<kernels::Keyed<std::uint64_t>>&&,
                                           const Execution&);

}  // namespace hedgerow::detail
