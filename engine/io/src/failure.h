#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "hedgerow/io/io_error.h"

namespace hedgerow::io {

/// How the place of a failure is told to people.
enum class Place : std::uint8_t { text, binary, none };

/// Why a parser stopped: an offset into its bytes, turned into line and column only when reported.
struct Failure {
  IoErrorCode code{};
  std::size_t offset = 0;
  Place place = Place::text;
  std::string message;
};

template <class T>
using Parsed = tl::expected<T, Failure>;

[[nodiscard]] inline tl::unexpected<Failure> failure(IoErrorCode code, std::size_t offset,
                                                     Place place, std::string message) {
  return tl::unexpected<Failure>(Failure{code, offset, place, std::move(message)});
}

}  // namespace hedgerow::io
