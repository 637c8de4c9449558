#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
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

/// An error about a file as a whole, without a place in it.
[[nodiscard]] inline tl::unexpected<IoError> refuse(const std::filesystem::path& path,
                                                    IoErrorCode code, std::string message) {
  IoError error;
  error.code = code;
  error.path = path.string();
  error.message = std::move(message);
  return tl::unexpected<IoError>(std::move(error));
}

}  // namespace hedgerow::io
