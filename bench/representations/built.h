#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "hedgerow/build.h"

namespace hedgerow::bench {

/// The value, or an exception with the name of the error: input of a benchmark has none.
template <class T>
T value_of(Result<T>&& result) {
  if (!result) throw std::runtime_error(std::string("no mesh: ") + name(result.error().code));
  return std::move(*result);
}

/// What every conversion starts from; the corners are the caller's.
inline Connectivity built_core(const FaceList& faces) {
  BuildOptions options;
  options.borrow_corners = true;
  return value_of(build(faces, options, Execution::serial())).mesh;
}

}  // namespace hedgerow::bench
