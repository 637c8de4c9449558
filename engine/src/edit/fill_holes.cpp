#include "hedgerow/fill_holes.h"

#include <cmath>
#include <limits>
#include <vector>

#include "float3_check.h"
#include "kernels/normals_math.h"

namespace hedgerow {

namespace {

using Double3 = kernels::Vec3<double>;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// The triangulation of least area of one loop of corners.
class HoleTriangulation {
 public:
  HoleTriangulation(const EditMesh& mesh, const Positions& positions,
                    const std::vector<VertexId>& corners)
      : size_(corners.size()), area_(size_ * size_, kNever), apex_(size_ * size_, 0) {
    std::vector<Double3> points;
    points.reserve(size_);
    for (const VertexId v : corners) {
      const float* p = positions[v.value];
      points.push_back({p[0], p[1], p[2]});
    }
    for (std::size_t i = 0; i + 1 < size_; ++i) area_[at(i, i + 1)] = 0;
    for (std::size_t length = 2; length < size_; ++length) {
      for (std::size_t i = 0; i + length < size_; ++i) {
        const std::size_t j = i + length;
        const bool is_side = length + 1 == size_;
        if (is_side || !mesh.find(corners[i], corners[j]).valid()) choose(points, i, j);
      }
    }
  }

  [[nodiscard]] bool exists() const noexcept { return area_[size_ - 1] < kNever; }
  /// The third corner of the triangle on the side from corner j back to corner i.
  [[nodiscard]] std::size_t apex(std::size_t i, std::size_t j) const noexcept {
    return apex_[at(i, j)];
  }

 private:
  [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const noexcept {
    return i * size_ + j;
  }
  void choose(const std::vector<Double3>& points, std::size_t i, std::size_t j) {
    for (std::size_t k = i + 1; k < j; ++k) {
      const Double3 normal = cross(points[k] - points[i], points[j] - points[i]);
      const double area = area_[at(i, k)] + area_[at(k, j)] + std::sqrt(dot(normal, normal));
      if (!(area < area_[at(i, j)])) continue;
      area_[at(i, j)] = area;
      apex_[at(i, j)] = k;
    }
  }

  std::size_t size_;
  std::vector<double> area_;  // twice it, of corners i to j
  std::vector<std::size_t> apex_;
};

/// Corners `begin` to `end` of a hole, in one face; `closing` runs from the last to the first.
struct Part {
  std::size_t begin;
  std::size_t end;
  HalfedgeId closing;
};

// Takes the face apart, from its closing side on. What `HoleTriangulation` has left out is all that
// `connect` would refuse.
void cut_face(EditMesh& mesh, const HoleTriangulation& triangles, const Part& whole) {
  std::vector<Part> parts = {whole};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    if (part.end - part.begin < 3) continue;
    const std::size_t apex = triangles.apex(part.begin, part.end);
    const HalfedgeId at_begin = mesh.view().next(part.closing);
    HalfedgeId at_apex = at_begin;
    for (std::size_t k = part.begin; k < apex; ++k) at_apex = mesh.view().next(at_apex);
    if (apex - part.begin > 1 && mesh.connect(at_begin, at_apex)) {
      parts.push_back({part.begin, apex, mesh.view().prev(at_begin)});
    }
    if (part.end - apex > 1 && mesh.connect(at_apex, part.closing)) {
      parts.push_back({apex, part.end, mesh.view().prev(at_apex)});
    }
  }
}

bool fill(EditMesh& mesh, const Positions& positions, const std::vector<VertexId>& corners,
          HalfedgeId last) {
  if (!mesh.can_add_face(corners)) return false;
  const HoleTriangulation triangles(mesh, positions, corners);
  if (!triangles.exists() || !mesh.add_face(corners)) return false;
  cut_face(mesh, triangles, {0, corners.size() - 1, last});
  return true;
}

}  // namespace

Result<FillReport> fill_holes(EditMesh& mesh, const Positions& positions,
                              const FillOptions& options) {
  if (const auto ok = detail::check_float3(positions, mesh.vertex_count()); !ok) {
    return fail(ok.error());
  }
  FillReport report;
  const Index count = mesh.halfedge_count();  // what is added bounds no hole
  std::vector<bool> is_seen(static_cast<std::size_t>(count), false);
  std::vector<VertexId> corners;
  for (HalfedgeId start(0); start.value < count; ++start.value) {
    if (is_seen[static_cast<std::size_t>(start.value)] || !mesh.has(start)) continue;
    const EditView view = mesh.view();
    if (view.face(start).valid()) continue;
    corners.clear();
    for (HalfedgeId h = start; !is_seen[static_cast<std::size_t>(h.value)]; h = view.next(h)) {
      is_seen[static_cast<std::size_t>(h.value)] = true;
      corners.push_back(view.origin[h]);
    }
    ++report.found;
    const auto edges = static_cast<Index>(corners.size());
    if (edges > options.max_edges) {
      ++report.too_long;
    } else if (fill(mesh, positions, corners, view.prev(start))) {
      ++report.filled;
      report.triangles += edges - 2;
    } else {
      ++report.refused;
    }
  }
  return report;
}

}  // namespace hedgerow
