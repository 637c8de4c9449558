#include "failure.h"

#include <fmt/format.h>

#include "hedgerow/defect.h"
#include "terminal.h"

namespace hedgerow::tool {
namespace {

ExitStatus status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::too_many_elements:
    case ErrorCode::scratch_too_small:
      return ExitStatus::limit;
    case ErrorCode::unsupported_policy:
      return ExitStatus::usage;
    default:
      return ExitStatus::input;
  }
}

std::string message_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::index_out_of_range:
      return fmt::format("face {} refers to vertex {}, but there are {} vertices", error.element,
                         error.value, error.limit);
    case ErrorCode::too_few_corners:
      return fmt::format("face {} has {} corners; a face needs {}", error.element, error.value,
                         error.limit);
    case ErrorCode::repeated_vertex:
      return fmt::format("face {} has vertex {} more than once", error.element, error.value);
    case ErrorCode::duplicate_face:
      return fmt::format("face {} has the same vertices as face {}", error.element, error.value);
    case ErrorCode::nonmanifold_edge:
      return fmt::format("half-edge {} is on an edge with {} half-edges; at most {} are manifold",
                         error.element, error.value, error.limit);
    case ErrorCode::inconsistent_edge:
      return fmt::format("half-edge {} and the other on its edge run the same way", error.element);
    case ErrorCode::nonmanifold_vertex:
      return fmt::format("the faces at vertex {} form {} groups instead of {}", error.element,
                         error.value, error.limit);
    case ErrorCode::isolated_vertex:
      return fmt::format("vertex {} is on no face", error.element);
    case ErrorCode::too_many_elements:
      return fmt::format("{} elements were asked for; an index of this build counts to {}",
                         error.value, error.limit);
    case ErrorCode::not_triangles:
      return fmt::format("face {} has {} corners; this is for triangles only", error.element,
                         error.value);
    case ErrorCode::bad_face_offsets:
      return fmt::format("the corners of face {} are not inside the corner array", error.element);
    case ErrorCode::coordinate_out_of_range:
      return fmt::format("{} of point {} is neither 0 nor of a size from 2^-{} to 2^{}",
                         error.value == 0 ? 'x' : 'y', error.element, error.limit, error.limit);
    default:
      return fmt::format("element {}, value {}, limit {}", error.element, error.value, error.limit);
  }
}

}  // namespace

std::string text(const Failure& failure, bool colour) {
  std::string out =
      fmt::format("{}: {} {}: {}\n", failure.where, styled("error:", Style::error, colour),
                  failure.code, failure.message);
  for (const std::string& detail : failure.details) out += fmt::format("  {}\n", detail);
  return out;
}

Failure describe(const Error& error, const std::string& where) {
  Failure failure{status_of(error.code), where, name(error.code), message_of(error), {}};
  if (error.count > 1) failure.details.push_back(fmt::format("{} in all", error.count));
  return failure;
}

}  // namespace hedgerow::tool
