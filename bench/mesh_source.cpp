#include "mesh_source.h"

#include <algorithm>
#include <optional>
#include <random>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "hedgerow/build.h"
#include "hedgerow/reorder.h"
#include "hedgerow/shapes.h"
#include "hedgerow/triangulate.h"
#if defined(HEDGEROW_BENCH_IO)
#include "hedgerow/io/read.h"
#endif

namespace hedgerow::bench {

namespace {

constexpr std::uint64_t kShuffleSeed = 1;
constexpr std::string_view kMoved = "moved-";

Soup value_or_throw(Result<Soup> soup, const std::string& shape) {
  if (!soup) throw std::runtime_error(shape + ": " + name(soup.error().code));
  return std::move(*soup);
}

/// Renumbered by the engine. \pre triangles only
Soup reordered(const Soup& soup, ReorderMethod method, const std::string& shape) {
  BuildOptions options;
  options.borrow_corners = true;
  const Result<BuildOutput> built = build(soup.face_list(), options, Execution::serial());
  if (!built) throw std::runtime_error(shape + ": " + name(built.error().code));
  const Result<ReorderOutput> output =
      reorder(built->mesh, soup.positions(), method, Execution::serial());
  if (!output) throw std::runtime_error(shape + ": " + name(output.error().code));
  Soup result;
  result.corners = Buffer<Index>::copy_of(output->mesh.origin());
  result.xyz = Buffer<float>(soup.xyz.size());
  fill_permuted<float>(output->reordering.vertices_new_to_old.span(), soup.xyz.span(),
                       result.xyz.span(), 3);
  return result;
}

/// `per_mille` of the faces, chosen at random, take each other's places.
Soup moved(Soup soup, std::int64_t per_mille) {
  std::mt19937_64 random(kShuffleSeed);
  const auto count = static_cast<std::uint64_t>(soup.face_count());
  // A swap moves two faces.
  for (std::uint64_t swap = 0; swap < count * static_cast<std::uint64_t>(per_mille) / 2000;
       ++swap) {
    Index* a = soup.corners.data() + 3 * (random() % count);
    Index* b = soup.corners.data() + 3 * (random() % count);
    if (a != b) std::swap_ranges(a, a + 3, b);
  }
  return soup;
}

Soup triangulated_points(std::int64_t count) {
  std::mt19937_64 random(kShuffleSeed);
  std::vector<Point2> points(static_cast<std::size_t>(count));
  Soup soup;
  soup.xyz = Buffer<float>(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      // The bits that a float holds, so that the soup has the points that were triangulated.
      const float value = static_cast<float>(random() >> 40U) * 0x1p-24F;
      points[i][axis] = double{value};
      soup.xyz[3 * i + axis] = value;
    }
    soup.xyz[3 * i + 2] = 0;
  }
  const Result<Triangulation> made = triangulate(points, Execution::serial());
  if (!made) throw std::runtime_error(std::string("points: ") + name(made.error().code));
  soup.corners = Buffer<Index>::copy_of(made->mesh.origin());
  return soup;
}

}  // namespace

Soup generate_soup(const std::string& shape, std::int64_t triangle_count) {
  if (shape == "shuffled")
    return shapes::shuffled(generate_soup("grid", triangle_count), kShuffleSeed);
  if (shape == "reordered") {
    return reordered(generate_soup("shuffled", triangle_count), ReorderMethod::fronts, shape);
  }
  if (shape == "scan") {
    return reordered(generate_soup("gyroid", triangle_count), ReorderMethod::hilbert, shape);
  }
  if (shape.starts_with(kMoved)) {
    return moved(generate_soup("grid", triangle_count), std::stoll(shape.substr(kMoved.size())));
  }
  if (shape == "points") return triangulated_points(triangle_count / 2);
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
