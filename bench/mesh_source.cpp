#include "mesh_source.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "hedgerow/shapes.h"
#if defined(HEDGEROW_BENCH_IO)
#include "hedgerow/io/read.h"
#endif

namespace hedgerow::bench {

namespace {

constexpr std::uint64_t kShuffleSeed = 1;

Soup value_or_throw(Result<Soup> soup, const std::string& shape) {
  if (!soup) throw std::runtime_error(shape + ": " + name(soup.error().code));
  return std::move(*soup);
}

}  // namespace

Soup generate_soup(const std::string& shape, std::int64_t triangle_count) {
  if (shape == "shuffled")
    return shapes::shuffled(generate_soup("grid", triangle_count), kShuffleSeed);
  // A closed fan: the vertex in the middle has as many neighbours as there are triangles.
  if (shape == "fan")
    return value_or_throw(shapes::fan(triangle_count, shapes::FanEnds::closed), shape);
  const std::optional<shapes::Shape> named = shapes::shape_named(shape);
  if (!named) throw std::runtime_error("no shape is called " + shape);
  return value_or_throw(shapes::generate(*named, triangle_count), shape);
}

Soup read_soup(const std::string& path) {
#if defined(HEDGEROW_BENCH_IO)
  io::IoResult<io::ReadOutput> read = io::read(path);
  if (!read) throw std::runtime_error(path + ": " + read.error().message);
  return std::move(read->soup);
#else
  throw std::runtime_error(path + ": this build reads no files");
#endif
}

}  // namespace hedgerow::bench
