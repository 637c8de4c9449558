#include "hedgerow/voronoi.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "hedgerow/build.h"
#include "hedgerow/triangulate.h"
#include "kernels/join_sets.h"
#include "kernels/voronoi_cells.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kCentreGrain = 1 << 14;  // triangles a task

/// The sites, each place once, and the images of those whose cells may reach the box.
class Mirror {
 public:
  Mirror(std::span<const Point2> sites, const Triangulation& triangulation, const Box2& box) {
    const auto count = static_cast<Index>(sites.size());
    const bool is_on_line = triangulation.mesh.face_count() == 0;
    std::vector<char> reaches(sites.size(), is_on_line ? 1 : 0);
    kernels::scatter_reaching(triangulation.mesh.triangles(), sites.data(), box, reaches.data());
    for (Index i = 0; i < count; ++i) {
      if (!triangulation.same_as.empty() && triangulation.same_as.data()[i] != i) continue;
      sites_.push_back(i);
      points_.push_back(sites[static_cast<std::size_t>(i)]);
    }
    owner_.resize(points_.size());
    side_.resize(points_.size(), 0);
    for (std::size_t i = 0; i < owner_.size(); ++i) owner_[i] = static_cast<Index>(i);
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (reaches[static_cast<std::size_t>(sites_[i])] == 0) continue;
      for (unsigned side = 0; side < kernels::kBoxSides; ++side) {
        points_.push_back(kernels::mirrored(points_[i], box, side));
        owner_.push_back(static_cast<Index>(i));
        side_.push_back(static_cast<std::uint8_t>(side));
      }
    }
  }

  [[nodiscard]] const std::vector<Index>& sites() const noexcept { return sites_; }
  [[nodiscard]] const std::vector<Point2>& points() const noexcept { return points_; }
  [[nodiscard]] kernels::MirroredSites view() const noexcept {
    return {points_.data(), owner_.data(), side_.data(), static_cast<Index>(sites_.size())};
  }

 private:
  std::vector<Index> sites_;
  std::vector<Point2> points_;
  std::vector<Index> owner_;
  std::vector<std::uint8_t> side_;
};

/// The phases from the triangulation of sites and images to the diagram.
class Dual {
 public:
  Dual(const Triangulation& triangulation, const Mirror& mirror, const Box2& box,
       const Execution& execution)
      : mesh_(triangulation.mesh.triangles()),
        mirror_(mirror),
        sites_(mirror.view()),
        box_(box),
        execution_(execution),
        centres_(static_cast<std::size_t>(mesh_.face_count())),
        parents_(static_cast<std::size_t>(mesh_.face_count())) {
    par::for_each_range(execution_, mesh_.face_count(), kCentreGrain, [&](IndexRange faces) {
      for (Index f = faces.begin; f < faces.end; ++f) {
        centres_.data()[f] = kernels::centre(corner(f, 0), corner(f, 1), corner(f, 2));
      }
    });
  }

  /// With rounded images, vertices that only rounding tells apart are joined.
  Result<Voronoi> diagram(bool is_rounded) {
    kernels::fill_singletons({0, mesh_.face_count()}, parents_.data());
    const double size = std::max(box_.high[0] - box_.low[0], box_.high[1] - box_.low[1]);
    kernels::join_centres(mesh_, sites_, centres_.data(), is_rounded, 1e-12 * size,
                          parents_.data());
    number_vertices();
    Buffer<Index> corners = Buffer<Index>::copy_of(corners_);
    Buffer<Index> offsets = Buffer<Index>::copy_of(offsets_);
    Result<BuildOutput> built = build(std::move(corners), std::move(offsets),
                                      static_cast<std::int64_t>(points_.size()), {}, execution_);
    if (!built) return fail(built.error());
    has_all_cells_ = built->defects.empty();
    return Voronoi{std::move(built->mesh), Buffer<Point2>::copy_of(points_),
                   Buffer<Index>::copy_of(mirror_.sites())};
  }
  /// Whether the last diagram has every cell, and no two of them meet where they should not.
  [[nodiscard]] bool has_all_cells() const noexcept { return has_all_cells_; }

 private:
  [[nodiscard]] const Point2& corner(Index f, Index k) const noexcept {
    return sites_.points[mesh_.origin[HalfedgeId(3 * f + k)].value];
  }

  // Cell by cell, counter-clockwise; new vertices in the order in which they are met.
  void number_vertices() {
    vertex_of_.assign(parents_.size(), kInvalidIndex);
    points_.clear();
    corners_.clear();
    offsets_.assign(1, 0);
    for (Index site = 0; site < sites_.site_count; ++site) {
      const std::size_t begin = corners_.size();
      const HalfedgeId start = mesh_.outgoing[VertexId(site)];
      HalfedgeId h = start;
      do {
        const Index v = vertex_at(mesh_.face(h).value);
        if (corners_.size() == begin || corners_.back() != v) corners_.push_back(v);
        snap(v, mesh_.face(h).value);
        h = mesh_.opposite[mesh_.prev(h)];
      } while (h != start && h.valid());
      while (corners_.size() > begin + 1 && corners_.back() == corners_[begin]) corners_.pop_back();
      offsets_.push_back(static_cast<Index>(corners_.size()));
    }
  }

  Index vertex_at(Index f) {
    const Index root = kernels::find_root(parents_.data(), f);
    Index& v = vertex_of_[static_cast<std::size_t>(root)];
    if (v == kInvalidIndex) {
      v = static_cast<Index>(points_.size());
      Point2 point = centres_.data()[root];
      for (std::size_t axis = 0; axis < 2; ++axis) {
        point[axis] = std::clamp(point[axis], box_.low[axis], box_.high[axis]);
      }
      points_.push_back(point);
    }
    return v;
  }

  // A site and an image meet on the side at which that is.
  void snap(Index v, Index f) noexcept {
    for (Index k = 0; k < 3; ++k) {
      const VertexId image = mesh_.origin[HalfedgeId(3 * f + k)];
      if (sites_.is_site(image)) continue;
      const unsigned side = sites_.side[image.value];
      const unsigned axis = side / 2;
      points_[static_cast<std::size_t>(v)][axis] = side % 2 == 0 ? box_.low[axis] : box_.high[axis];
    }
  }

  TriangleView mesh_;
  const Mirror& mirror_;
  kernels::MirroredSites sites_;
  const Box2& box_;
  const Execution& execution_;
  Buffer<Point2> centres_;
  Buffer<Index> parents_;
  std::vector<Index> vertex_of_;
  std::vector<Point2> points_;
  std::vector<Index> corners_;
  std::vector<Index> offsets_;
  bool has_all_cells_ = false;
};

Result<void> check_sites(std::span<const Point2> sites, const Box2& box) {
  Error error{ErrorCode::site_outside_box};
  error.count = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const unsigned axis = kernels::axis_outside(sites[i], box);
    if (axis == 2) continue;
    if (error.count++ > 0) continue;
    error.element = static_cast<Index>(i);
    error.value = axis;
  }
  if (error.count > 0) return fail(error);
  return {};
}

}  // namespace

Box2 box_round(std::span<const Point2> sites) noexcept {
  if (sites.empty()) return {{-1, -1}, {1, 1}};
  Box2 box{sites[0], sites[0]};
  for (const Point2& site : sites) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      box.low[axis] = std::min(box.low[axis], site[axis]);
      box.high[axis] = std::max(box.high[axis], site[axis]);
    }
  }
  const double length = std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  double size = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    size = std::max({size, std::abs(box.low[axis]), std::abs(box.high[axis])});
  }
  // Sites so near each other that a tenth would round away: a millionth of where they are.
  const double margin = length == 0 && size <= 1e6 ? 1 : std::max(length / 10, size * 1e-6);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    box.low[axis] -= margin;
    box.high[axis] += margin;
  }
  return box;
}

Result<Voronoi> voronoi(std::span<const Point2> sites, const Box2& box,
                        const Execution& execution) {
  const Result<Triangulation> first = triangulate(sites, execution);
  if (!first) return fail(first.error());
  if (const Result<void> inside = check_sites(sites, box); !inside) return fail(inside.error());
  const Mirror mirror(sites, *first, box);
  const Result<Triangulation> all = triangulate(mirror.points(), execution);
  if (!all) {
    Error error = all.error();
    if (error.code == ErrorCode::coordinate_out_of_range) {
      const Index owner = mirror.view().owner[error.element];
      error.element = mirror.sites()[static_cast<std::size_t>(owner)];
    }
    return fail(error);
  }
  Dual dual(*all, mirror, box, execution);
  Result<Voronoi> diagram = dual.diagram(true);
  // A cell so small that it was joined away: rather vertices that lie on each other.
  if (diagram && !dual.has_all_cells()) diagram = dual.diagram(false);
  return diagram;
}

double cell_area(const Voronoi& diagram, FaceId cell) noexcept {
  return diagram.mesh.visit([&](const auto& mesh) {
    const Point2* points = diagram.points.data();
    const HalfedgeId start = mesh.first(cell);
    const Point2& o = points[mesh.origin[start].value];
    double twice = 0;
    for (HalfedgeId h = mesh.next(start); mesh.next(h) != start; h = mesh.next(h)) {
      const Point2& p = points[mesh.origin[h].value];
      const Point2& q = points[mesh.target(h).value];
      twice += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    }
    return twice / 2;
  });
}

}  // namespace hedgerow
