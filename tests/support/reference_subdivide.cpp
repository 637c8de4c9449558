#include "support/reference_subdivide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "support/meshes.h"
#include "support/numbers.h"

namespace hedgerow::test {
namespace {

using Vector = std::array<double, 3>;
using Weights = std::map<Index, double>;  // of old vertices

void add(Weights& sum, const Weights& part, double factor) {
  for (const auto& [v, weight] : part) sum[v] += factor * weight;
}

// Every new point is a weighted sum of old ones, so that is what each rule gives.
class Refinement {
 public:
  Refinement(const PlainFaces& list, const std::vector<float>& xyz,
             const std::vector<float>& sharpness)
      : mesh_(reference_of(list)), xyz_(xyz), sharpness_(sharpness) {
    for (Index v = 0; v < mesh_.vertex_count(); ++v) points_.push_back({{v, 1.0}});
  }

  void catmull_clark();
  void loop();
  void sqrt3(bool cuts_boundary);
  [[nodiscard]] ReferenceSubdivision result() const;

 private:
  [[nodiscard]] Index origin(Index h) const { return mesh_.origin[at(h)]; }
  [[nodiscard]] Index next(Index h) const { return mesh_.next[at(h)]; }
  [[nodiscard]] Index prev(Index h) const { return mesh_.prev[at(h)]; }
  [[nodiscard]] Index opposite(Index h) const { return mesh_.opposite[at(h)]; }
  [[nodiscard]] Index target(Index h) const { return origin(next(h)); }
  [[nodiscard]] bool is_boundary(Index h) const { return opposite(h) < 0; }
  [[nodiscard]] Index edge(Index h) const { return is_boundary(h) ? h : std::min(h, opposite(h)); }

  [[nodiscard]] double sharp(Index h) const {
    if (is_boundary(h)) return std::numeric_limits<double>::infinity();
    return sharpness_.empty()
               ? 0.0
               : std::max({0.0, double{sharpness_[at(h)]}, double{sharpness_[at(opposite(h))]}});
  }
  [[nodiscard]] Weights centre(Index f) const {
    Weights sum;
    const auto corners = mesh_.faces()[at(f)];
    for (const Index v : corners) sum[v] += 1.0 / static_cast<double>(corners.size());
    return sum;
  }
  [[nodiscard]] Weights middle(Index h) const { return {{origin(h), 0.5}, {target(h), 0.5}}; }
  [[nodiscard]] static Weights blend(const Weights& a, const Weights& b, double t) {
    Weights sum;
    add(sum, a, 1 - t);
    add(sum, b, t);
    return sum;
  }

  // Each edge at v once, as the number of one of its half-edges and the other end.
  [[nodiscard]] std::map<Index, Index> edges_at(Index v) const {
    std::map<Index, Index> found;
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      if (origin(h) == v) found[edge(h)] = target(h);
      if (target(h) == v) found[edge(h)] = origin(h);
    }
    return found;
  }

  // `smooth` and `crease` weigh the neighbours; the vertex itself has the rest.
  template <class Smooth>
  [[nodiscard]] Weights moved(Index v, const Smooth& smooth, double crease) const {
    const Weights old = {{v, 1.0}};
    if (mesh_.outgoing[at(v)] < 0 || mesh_.fan_starts(v).size() > 1) return old;
    Weights on_curve = {{v, 1 - 2 * crease}};
    double total = 0;
    int count = 0;
    for (const auto& [e, neighbour] : edges_at(v)) {
      if (sharp(e) <= 0) continue;
      on_curve[neighbour] += crease;
      total += sharp(e);
      ++count;
    }
    if (count < 2) return smooth(v);
    const double t = total / count;
    const Weights& fixed = count == 2 ? on_curve : old;
    return t >= 1 ? fixed : blend(smooth(v), fixed, t);
  }
  template <class Smooth>
  [[nodiscard]] Weights edge_point(Index h, const Smooth& smooth) const {
    const double t = sharp(h);
    if (t >= 1) return middle(h);
    return t > 0 ? blend(smooth(h), middle(h), t) : smooth(h);
  }
  Index append(const Weights& point) {
    points_.push_back(point);
    return static_cast<Index>(points_.size()) - 1;
  }
  void keep_sharpness(std::vector<std::array<Index, 2>> halves);

  ReferenceMesh mesh_;
  std::vector<float> xyz_;
  std::vector<float> sharpness_;
  std::vector<Weights> points_;
  std::vector<std::vector<std::int64_t>> faces_;
  std::vector<float> left_;
};

void Refinement::keep_sharpness(std::vector<std::array<Index, 2>> halves) {
  if (sharpness_.empty()) return;
  left_.assign(4 * sharpness_.size(), 0.0F);
  for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
    float s = sharpness_[at(h)];
    if (!is_boundary(h)) s = std::max(s, sharpness_[at(opposite(h))]);
    for (const Index half : halves[at(h)]) left_[at(half)] = std::max(0.0F, s - 1);
  }
}

void Refinement::catmull_clark() {
  std::vector<Index> of_face;
  for (Index f = 0; f < mesh_.face_count(); ++f) of_face.push_back(append(centre(f)));
  std::map<Index, Index> of_edge;
  const auto smooth_edge = [&](Index h) {
    Weights sum;
    add(sum, middle(h), 0.5);
    add(sum, centre(mesh_.face[at(h)]), 0.25);
    add(sum, centre(mesh_.face[at(opposite(h))]), 0.25);
    return sum;
  };
  std::vector<std::array<Index, 2>> halves;
  for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
    if (edge(h) == h) of_edge[h] = append(edge_point(h, smooth_edge));
    halves.push_back({4 * h, 4 * next(h) + 3});
  }
  for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
    faces_.push_back(
        {origin(h), of_edge[edge(h)], of_face[at(mesh_.face[at(h)])], of_edge[edge(prev(h))]});
  }
  const auto smooth = [&](Index v) {
    const auto edges = edges_at(v);
    const auto n = static_cast<double>(edges.size());
    Weights sum = {{v, (n - 3) / n}};
    for (const auto& [e, neighbour] : edges) add(sum, middle(e), 2 / (n * n));
    for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
      if (origin(h) == v) add(sum, centre(mesh_.face[at(h)]), 1 / (n * n));
    }
    return sum;
  };
  for (Index v = 0; v < mesh_.vertex_count(); ++v) points_[at(v)] = moved(v, smooth, 0.125);
  keep_sharpness(halves);
}

void Refinement::loop() {
  std::map<Index, std::int64_t> of_edge;
  const auto smooth_edge = [&](Index h) {
    Weights sum;
    add(sum, {{origin(h), 0.375}, {target(h), 0.375}}, 1);
    add(sum, {{origin(prev(h)), 0.125}}, 1);
    add(sum, {{origin(prev(opposite(h))), 0.125}}, 1);
    return sum;
  };
  std::vector<std::array<Index, 2>> halves;
  for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
    if (edge(h) == h) of_edge[h] = append(edge_point(h, smooth_edge));
    const Index first = 12 * (h / 3);
    halves.push_back({first + 3 * (h % 3), first + 3 * (next(h) % 3) + 2});
  }
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      faces_.push_back({origin(h), of_edge[edge(h)], of_edge[edge(prev(h))]});
    }
    faces_.push_back({of_edge[edge(3 * f)], of_edge[edge(3 * f + 1)], of_edge[edge(3 * f + 2)]});
  }
  const auto smooth = [&](Index v) {
    const auto edges = edges_at(v);
    const auto n = static_cast<double>(edges.size());
    const double share = (0.625 - std::pow(0.375 + std::cos(2 * std::acos(-1.0) / n) / 4, 2)) / n;
    Weights sum = {{v, 1 - n * share}};
    for (const auto& [e, neighbour] : edges) sum[neighbour] += share;
    return sum;
  };
  for (Index v = 0; v < mesh_.vertex_count(); ++v) points_[at(v)] = moved(v, smooth, 0.125);
  keep_sharpness(halves);
}

void Refinement::sqrt3(bool cuts_boundary) {
  std::vector<std::int64_t> apex(at(mesh_.halfedge_count()));
  faces_.resize(apex.size());
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    Index cut = kInvalidIndex;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      if (cuts_boundary && is_boundary(h)) cut = h;
    }
    if (cut < 0) {
      const std::int64_t middle_of_face = append(centre(f));
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        apex[at(h)] = middle_of_face;
        faces_[at(h)] = {origin(h), target(h), middle_of_face};
      }
      continue;
    }
    // The boundary edges before and after, round the fans at both ends.
    Index before = prev(cut);
    while (!is_boundary(before)) before = prev(opposite(before));
    Index after = next(cut);
    while (!is_boundary(after)) after = next(opposite(after));
    Weights p = {{origin(cut), 16.0 / 27}};
    add(p, {{target(cut), 10.0 / 27}}, 1);
    add(p, {{origin(before), 1.0 / 27}}, 1);
    Weights q = {{target(cut), 16.0 / 27}};
    add(q, {{origin(cut), 10.0 / 27}}, 1);
    add(q, {{target(after), 1.0 / 27}}, 1);
    const std::int64_t near = append(p);
    const std::int64_t far = append(q);
    apex[at(next(cut))] = far;
    apex[at(prev(cut))] = near;
    faces_[at(cut)] = {near, far, origin(prev(cut))};
  }
  for (Index h = 0; h < mesh_.halfedge_count(); ++h) {  // the flips
    if (is_boundary(h)) continue;
    faces_[at(h)] = {origin(h), apex[at(opposite(h))], apex[at(h)]};
  }
  const auto smooth = [&](Index v) {
    const auto edges = edges_at(v);
    const auto n = static_cast<double>(edges.size());
    const double share = (4 - 2 * std::cos(2 * std::acos(-1.0) / n)) / 9;
    Weights sum = {{v, 1 - share}};
    for (const auto& [e, neighbour] : edges) sum[neighbour] += share / n;
    return sum;
  };
  const double crease = cuts_boundary ? 4.0 / 27 : 0.0;
  for (Index v = 0; v < mesh_.vertex_count(); ++v) points_[at(v)] = moved(v, smooth, crease);
}

ReferenceSubdivision Refinement::result() const {
  ReferenceSubdivision result{{faces_, static_cast<std::int64_t>(points_.size())}, {}, left_};
  for (const Weights& point : points_) {
    Vector sum{};
    for (const auto& [v, weight] : point) {
      for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * double{xyz_[3 * at(v) + k]};
    }
    for (const double x : sum) result.xyz.push_back(static_cast<float>(x));
  }
  return result;
}

}  // namespace

ReferenceSubdivision reference_subdivide(const PlainFaces& list, const std::vector<float>& xyz,
                                         const std::vector<float>& sharpness,
                                         SubdivisionScheme scheme, int level) {
  Refinement refinement(list, xyz, sharpness);
  if (scheme == SubdivisionScheme::catmull_clark) refinement.catmull_clark();
  if (scheme == SubdivisionScheme::loop) refinement.loop();
  if (scheme == SubdivisionScheme::sqrt3) refinement.sqrt3(level % 2 == 1);
  return refinement.result();
}

}  // namespace hedgerow::test
