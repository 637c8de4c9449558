#pragma once

#include <cstdint>
#include <string>

#include "hedgerow/soup.h"

namespace hedgerow::bench {

/// A mesh of about `triangle_count` triangles. Besides the names of hedgerow/shapes.h:
///   scan        a gyroid, numbered along a Hilbert curve: irregular valences, a good order
///   shuffled    the grid with vertices and faces renumbered at random: no order
///   reordered   the same after `reorder` by fronts
///   moved-N     the grid with N of each thousand faces put at random places: some disorder
///   points      half as many points at random in a square, and their triangulation
///   fan         the closed one: its middle vertex has as many neighbours as there are triangles
/// Seeds are fixed. Throws std::runtime_error with the reason.
[[nodiscard]] Soup generate_soup(const std::string& shape, std::int64_t triangle_count);

/// Reads a mesh file of any format that the project reads.
/// Throws std::runtime_error with the reason if it cannot be read.
[[nodiscard]] Soup read_soup(const std::string& path);

}  // namespace hedgerow::bench
