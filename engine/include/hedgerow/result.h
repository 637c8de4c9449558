#pragma once

#include <cstdint>

#include <tl/expected.hpp>

#include "hedgerow/index.h"

namespace hedgerow {

/// What can go wrong with data. Bugs of the caller are asserts; no memory is `std::bad_alloc`.
enum class ErrorCode : std::uint8_t {
  index_out_of_range,  ///< element = face; value = the index; limit = the vertex count
  too_few_corners,     ///< element = face; value = its corner count; limit = 3
  repeated_vertex,     ///< element = face; value = the vertex
  duplicate_face,      ///< element = face; value = the earlier face with the same vertices
  nonmanifold_edge,    ///< element = smallest half-edge; value = half-edges on the edge; limit = 2
  inconsistent_edge,   ///< element = smallest half-edge; value = 2
  nonmanifold_vertex,  ///< element = vertex; value = number of fans; limit = 1
  isolated_vertex,     ///< element = vertex
  too_many_elements,   ///< value = the count asked for; limit = the largest that fits an `Index`
  bad_face_offsets,    ///< element = first face whose offsets decrease or leave the corner array
  null_pointer,        ///< an array with elements has no address
  bad_stride,          ///< value = the stride in bytes; limit = the smallest that is allowed
  count_mismatch,      ///< value = elements given; limit = elements needed
  unsupported_policy,  ///< element = DefectKind; value = Action: this pair has no meaning
  scratch_too_small,   ///< value = bytes given; limit = bytes needed
  already_closed,      ///< the mesh already has boundary half-edges
  already_open,        ///< the mesh has no boundary half-edges to remove
  not_canonical,       ///< the operation needs the half-edges of each face in one run (I8)
  inconsistent_table,  ///< element = row; value = the entry found; limit = what would be consistent
  not_triangles,       ///< element = smallest other face; value = its corner count; limit = 3
  needs_padding,       ///< value = readable bytes; limit = bytes that a ray tracer reads
  ray_library,         ///< value = the error code of the ray-tracing library
  coordinate_out_of_range,  ///< element = point; value = 0 for x, 1 for y; exact signs need it
                            ///< finite, and 0 or of a magnitude from 2^-limit to 2^limit
  crossing_edges,           ///< element = given edge; value = the earlier one that it crosses
  site_outside_box,         ///< element = site; value = 0 for x, 1 for y
};

/// Stable lower-case word-with-dashes for messages and JSON, e.g. "index-out-of-range".
[[nodiscard]] const char* name(ErrorCode code) noexcept;

/// What went wrong, where first, and how often. Cheap to copy; holds no text.
struct Error {
  ErrorCode code{};
  Index element = kInvalidIndex;  ///< smallest offending position in the *input*, see `ErrorCode`
  std::int64_t value = 0;         ///< the value found
  std::int64_t limit = 0;         ///< the value that would have been allowed
  std::int64_t count = 1;         ///< how many elements offend in the same way
};

/// A value, or the error that prevented it. On error nothing has changed.
template <class T>
using Result = tl::expected<T, Error>;

/// `return fail(...)` from a function that returns a `Result`.
[[nodiscard]] inline tl::unexpected<Error> fail(const Error& error) {
  return tl::unexpected<Error>(error);
}

}  // namespace hedgerow
