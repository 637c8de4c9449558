#pragma once

#include <cstddef>
#include <span>

#include "hedgerow/buffer.h"
#include "hedgerow/index.h"
#include "parallel/parallel.h"

namespace hedgerow::detail {

inline constexpr Index kRecordGrain = 1 << 14;  // records a task

/// A column as ids.
template <class Value>
Buffer<Value> ids_of(std::span<const Index> column, const Execution& execution) {
  Buffer<Value> ids(column.size());
  const auto count = static_cast<Index>(column.size());
  par::for_each_range(execution, count, kRecordGrain, [&](IndexRange range) {
    for (Index i = range.begin; i < range.end; ++i) ids.data()[i] = Value(column.data()[i]);
  });
  return ids;
}

/// Ids as a column.
template <class Value>
Buffer<Index> numbers_of(const Buffer<Value>& ids, const Execution& execution) {
  Buffer<Index> column(ids.size());
  const auto count = static_cast<Index>(ids.size());
  par::for_each_range(execution, count, kRecordGrain, [&](IndexRange range) {
    for (Index i = range.begin; i < range.end; ++i) column.data()[i] = ids.data()[i].value;
  });
  return column;
}

}  // namespace hedgerow::detail
