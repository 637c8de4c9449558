#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hedgerow/connectivity.h"
#include "hedgerow/point2.h"
#include "kernels/predicates.h"

/// What a triangulation of points in the plane has to be, in the plainest form.
namespace hedgerow::test {

/// The distinct coordinates, each with the first point that has them.
inline std::map<Point2, Index> first_points(const std::vector<Point2>& points) {
  std::map<Point2, Index> first;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2 p{points[i][0] + 0.0, points[i][1] + 0.0};  // -0 is 0
    first.emplace(p, static_cast<Index>(i));
  }
  return first;
}

class PlanarCheck {
 public:
  PlanarCheck(const std::vector<Point2>& points, const Connectivity& mesh)
      : points_(points), mesh_(mesh.triangles()) {}

  /// Empty, or what is wrong. O(n F).
  std::string every_circle_is_empty() const {
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const auto [a, b, c] = corners(f);
      if (kernels::orient2d(a, b, c) <= 0)
        return "face " + std::to_string(f) + " does not turn left";
      for (const Point2& d : points_) {
        if (kernels::incircle(a, b, c, d) > 0) return "a point within face " + std::to_string(f);
      }
    }
    return "";
  }

  /// The same where all faces turn left and the hull is convex. O(F).
  std::string every_edge_is_legal() const {
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      const auto [a, b, c] = corners(h / 3);
      if (kernels::orient2d(a, b, c) <= 0) return "face " + std::to_string(h / 3);
      const HalfedgeId o = mesh_.opposite[HalfedgeId(h)];
      if (!o.valid()) continue;
      if (kernels::incircle(a, b, c, at(mesh_.origin[mesh_.prev(o)])) > 0) {
        return "half-edge " + std::to_string(h);
      }
    }
    return "";
  }

  /// Every point is on a face and the outside is convex, so that with the right number of faces
  /// these cover the hull once.
  std::string covers_the_hull() const {
    const std::map<Point2, Index> first = first_points(points_);
    std::map<Index, Index> after;  // along the boundary
    std::set<Index> used;
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      const Index v = mesh_.origin[HalfedgeId(h)].value;
      used.insert(v);
      if (mesh_.opposite[HalfedgeId(h)].valid()) continue;
      if (!after.emplace(v, mesh_.target(HalfedgeId(h)).value).second) return "a pinched outside";
    }
    if (used.empty()) return are_on_a_line(first) ? "" : "no face";
    for (const auto& [p, i] : first) {
      if (used.count(i) == 0) return "point " + std::to_string(i) + " is on no face";
    }
    if (used.size() != first.size()) return "a repeated point is on a face";
    Index v = after.begin()->first;
    std::size_t length = 0;
    do {
      const Index w = after.at(v);
      if (turn(v, w, after.at(w)) < 0) return "the outside turns right";
      v = w;
      ++length;
    } while (v != after.begin()->first && length <= after.size());
    if (length != after.size()) return "an outside in parts";
    // Euler: V - E + F = 1 with 3 F = 2 E - boundary.
    const auto faces = static_cast<std::size_t>(mesh_.face_count());
    return faces == 2 * used.size() - 2 - after.size() ? "" : "faces are missing";
  }

 private:
  const Point2& at(VertexId v) const { return points_[static_cast<std::size_t>(v.value)]; }
  struct Corners {
    const Point2& a;
    const Point2& b;
    const Point2& c;
  };
  Corners corners(Index f) const {
    return {at(mesh_.origin[HalfedgeId(3 * f)]), at(mesh_.origin[HalfedgeId(3 * f + 1)]),
            at(mesh_.origin[HalfedgeId(3 * f + 2)])};
  }
  int turn(Index a, Index b, Index c) const {
    return kernels::orient2d(at(VertexId(a)), at(VertexId(b)), at(VertexId(c)));
  }
  static bool are_on_a_line(const std::map<Point2, Index>& first) {
    if (first.size() < 3) return true;
    const Point2& a = first.begin()->first;
    const Point2& b = first.rbegin()->first;
    return std::all_of(first.begin(), first.end(), [&](const auto& entry) {
      return kernels::orient2d(a, b, entry.first) == 0;
    });
  }

  const std::vector<Point2>& points_;
  TriangleView mesh_;
};

}  // namespace hedgerow::test
