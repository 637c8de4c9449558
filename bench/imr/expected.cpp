// The six answers the slow way: from lists of neighbours, in double.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "imr/suite.h"

namespace hedgerow::bench {

namespace {

using Point = std::array<double, 3>;
using Triangle = std::array<Index, 3>;

/// Of the largest coordinate: single precision, over the sums of a ring.
constexpr double kTolerance = 4e-6;

std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }

const Index* corners_of(const ImrInput& input) {
  return static_cast<const Index*>(input.faces.corners);
}
Index target_of(const ImrInput& input, Index h) {
  return corners_of(input)[h % 3 == 2 ? h - 2 : h + 1];
}

std::vector<Point> points_of(const ImrInput& input) {
  std::vector<Point> points;
  for (Index v = 0; v < input.faces.vertex_count; ++v) {
    const float* p = input.positions[v];
    points.push_back({double{p[0]}, double{p[1]}, double{p[2]}});
  }
  return points;
}

/// The neighbours of each vertex, none for those on the boundary: they stay where they are.
std::vector<std::vector<Index>> inner_rings(const ImrInput& input) {
  std::vector<std::vector<Index>> rings(at(static_cast<Index>(input.faces.vertex_count)));
  std::vector<bool> is_inner(rings.size(), true);
  for (Index h = 0; h < input.faces.corner_count(); ++h) {
    const Index origin = corners_of(input)[h];
    const Index target = target_of(input, h);
    rings[at(origin)].push_back(target);
    if (input.opposite[at(h)] == kInvalidIndex) is_inner[at(origin)] = is_inner[at(target)] = false;
  }
  for (std::size_t v = 0; v < rings.size(); ++v) {
    if (!is_inner[v]) rings[v].clear();
  }
  return rings;
}

Point mean_of(const std::vector<Index>& ring, const std::vector<Point>& points) {
  Point mean{};
  for (const Index u : ring) {
    for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += points[at(u)][axis];
  }
  for (double& x : mean) x /= static_cast<double>(ring.size());
  return mean;
}

std::string compare_points(const std::vector<float>& xyz, const std::vector<Point>& expected) {
  if (xyz.size() != 3 * expected.size()) return "another number of vertices; not measured";
  double largest = 0;
  for (const Point& p : expected) {
    for (const double x : p) largest = std::max(largest, std::abs(x));
  }
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    const double difference = std::abs(double{xyz[i]} - expected[i / 3][i % 3]);
    // Written so that a difference that is not a number counts as one.
    if (difference <= kTolerance * largest) continue;
    return "vertex " + std::to_string(i / 3) + " is at " + std::to_string(xyz[i]) + " in axis " +
           std::to_string(i % 3) + ", not " + std::to_string(expected[i / 3][i % 3]) +
           "; not measured";
  }
  return "";
}

/// Each triangle from its smallest corner on, all of them sorted.
std::vector<Triangle> sorted_triangles(std::span<const Index> corners) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    Triangle triangle = {corners[i], corners[i + 1], corners[i + 2]};
    std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    triangles.push_back(triangle);
  }
  std::ranges::sort(triangles);
  return triangles;
}

std::string compare_triangles(std::span<const Index> corners, std::span<const Index> expected) {
  if (corners.size() != expected.size()) {
    return std::to_string(corners.size() / 3) + " faces, not " +
           std::to_string(expected.size() / 3) + "; not measured";
  }
  const bool is_equal = sorted_triangles(corners) == sorted_triangles(expected);
  return is_equal ? "" : "other faces than expected; not measured";
}

}  // namespace

const char* name(ImrRow row) noexcept {
  constexpr std::array kNames = {"circulator", "barycenter",  "normals",
                                 "smoothing",  "subdivision", "collapse"};
  return kNames[static_cast<std::size_t>(row)];
}

std::string check_rings(const ImrInput& input, const RingSums& sums) {
  RingSums expected;
  for (Index h = 0; h < input.faces.corner_count(); ++h) {
    // Each corner is a face at a vertex and a vertex of a face.
    ++expected.faces;
    expected.face_ids += static_cast<std::uint64_t>(h / 3);
    ++expected.vertices;
    expected.vertex_ids += static_cast<std::uint64_t>(corners_of(input)[h]);
  }
  return sums == expected ? "" : "other faces and vertices than there are; not measured";
}

std::string check_centered(const ImrInput& input, const ImrSurface& surface) {
  std::vector<Point> points = points_of(input);
  Point mean{};
  for (const Point& p : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += p[axis];
  }
  for (double& x : mean) x /= static_cast<double>(points.size());
  for (Point& p : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] -= mean[axis];
  }
  return compare_points(surface.xyz, points);
}

std::string check_smoothed(const ImrInput& input, const ImrSurface& surface, bool is_in_place) {
  std::vector<Point> points = points_of(input);
  const std::vector<Point> before = points;
  const auto rings = inner_rings(input);
  for (std::size_t v = 0; v < rings.size(); ++v) {
    if (!rings[v].empty()) points[v] = mean_of(rings[v], is_in_place ? points : before);
  }
  return compare_points(surface.xyz, points);
}

std::string check_subdivided(const ImrInput& input, const ImrSurface& surface) {
  const std::vector<Point> before = points_of(input);
  const auto rings = inner_rings(input);
  std::vector<Point> points = before;
  for (std::size_t v = 0; v < rings.size(); ++v) {
    if (rings[v].empty()) continue;
    const double share = sqrt3_share(static_cast<int>(rings[v].size()));
    const Point mean = mean_of(rings[v], before);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      points[v][axis] = (1 - share) * before[v][axis] + share * mean[axis];
    }
  }
  const Index* corners = corners_of(input);
  const auto center_of = [&](Index h) {
    return static_cast<Index>(input.faces.vertex_count) + h / 3;
  };
  std::vector<Index> expected;
  for (Index h = 0; h < input.faces.corner_count(); ++h) {
    if (h % 3 == 0) points.push_back(mean_of({corners[h], corners[h + 1], corners[h + 2]}, before));
    // The flipped edge runs between the two centres; on the boundary the edge is still there.
    const Index opposite = input.opposite[at(h)];
    const Index second = opposite == kInvalidIndex ? target_of(input, h) : center_of(opposite);
    expected.insert(expected.end(), {corners[h], second, center_of(h)});
  }
  const std::string fault = compare_triangles(surface.corners, expected);
  return fault.empty() ? compare_points(surface.xyz, points) : fault;
}

std::string check_unchanged(const ImrInput& input, const ImrSurface& surface) {
  const std::string fault = compare_triangles(
      surface.corners, {corners_of(input), static_cast<std::size_t>(input.faces.corner_count())});
  return fault.empty() ? compare_points(surface.xyz, points_of(input)) : fault;
}

}  // namespace hedgerow::bench
