#pragma once

#include <cstdint>
#include <string>

#include "hedgerow/soup.h"

namespace hedgerow::bench {

/// A mesh of about `triangle_count` triangles: "shuffled" (the grid renumbered at random), "fan" (a
/// closed one), or any other name of hedgerow/shapes.h. Seeds are fixed.
/// Throws std::runtime_error with the reason.
[[nodiscard]] Soup generate_soup(const std::string& shape, std::int64_t triangle_count);

/// Reads a mesh file of any format that the project reads.
/// Throws std::runtime_error with the reason if it cannot be read.
[[nodiscard]] Soup read_soup(const std::string& path);

}  // namespace hedgerow::bench
