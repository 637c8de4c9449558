#include <algorithm>
#include <set>
#include <tuple>

#include "support/numbers.h"
#include "support/reference_mesh.h"

namespace hedgerow::test {

namespace {

struct WorkFace {
  Index input = 0;
  std::vector<Index> corners;
  bool cut = false;
};

class Build {
 public:
  Build(const PlainFaces& input, const Policies& policies)
      : input_(input), policies_(policies), vertex_count_(static_cast<Index>(input.vertex_count)) {
    for (Index v = 0; v < vertex_count_; ++v) input_vertex_.push_back(v);
  }

  Result<ReferenceBuild> run() {
    read_faces();
    if (const auto error = first_failure()) return fail(*error);
    treat_repeated_vertices();
    treat_duplicates();
    if (const auto error = first_failure()) return fail(*error);
    pair();
    const std::vector<Defect> found = edge_and_vertex_defects();
    defects_.insert(defects_.end(), found.begin(), found.end());
    if (const auto error = first_failure()) return fail(*error);
    while (skip_edges() || skip_groups()) pair();
    split_fans();
    skip_isolated();
    return output();
  }

 private:
  [[nodiscard]] Action policy(DefectKind kind) const { return policies_[kind]; }

  // Out of range, too few corners, repeated vertex: the first that applies to a face.
  [[nodiscard]] std::optional<Defect> single_defect(Index f) const {
    const auto& corners = input_.faces[at(f)];
    for (const std::int64_t v : corners) {
      if (v >= 0 && v < input_.vertex_count) continue;
      return Defect{DefectKind::out_of_range, FaceId(f), {}, {}, {}, v};
    }
    if (corners.size() < 3) {
      const auto count = static_cast<std::int64_t>(corners.size());
      return Defect{DefectKind::too_few_corners, FaceId(f), {}, {}, {}, count};
    }
    std::set<std::int64_t> seen;
    for (const std::int64_t v : corners) {
      if (seen.insert(v).second) continue;
      const VertexId vertex(static_cast<Index>(v));
      return Defect{DefectKind::repeated_vertex, FaceId(f), {}, vertex, {}, 0};
    }
    return std::nullopt;
  }

  void read_faces() {
    for (Index f = 0; f < static_cast<Index>(input_.faces.size()); ++f) {
      const auto defect = single_defect(f);
      if (defect) defects_.push_back(*defect);
      if (defect && policy(defect->kind) != Action::split) continue;
      WorkFace face{f, {}};
      for (const std::int64_t v : input_.faces[at(f)]) {
        face.corners.push_back(static_cast<Index>(v));
      }
      faces_.push_back(face);
    }
    sort_by_kind();
  }

  void treat_repeated_vertices() {
    for (WorkFace& face : faces_) {
      std::set<Index> seen;
      for (Index& v : face.corners) {
        if (!seen.insert(v).second) v = new_vertex(v);
      }
    }
  }

  Index new_vertex(Index old) {
    is_renumbered_ = true;
    input_vertex_.push_back(input_vertex_[at(old)]);
    return vertex_count_++;
  }

  void treat_duplicates() {
    const Action action = policy(DefectKind::duplicate_face);
    std::map<std::set<Index>, Index> first_with;
    std::vector<WorkFace> kept;
    for (WorkFace& face : faces_) {
      const auto [earlier, is_new] =
          first_with.insert({{face.corners.begin(), face.corners.end()}, face.input});
      if (!is_new) {
        defects_.push_back(
            {DefectKind::duplicate_face, FaceId(face.input), {}, {}, {}, earlier->second});
        if (action == Action::skip) continue;
        face.cut = action == Action::cut;
        if (action == Action::split) {
          for (Index& v : face.corners) v = new_vertex(v);
        }
      }
      kept.push_back(face);
    }
    faces_ = kept;
    sort_by_kind();
  }

  void sort_by_kind() {
    std::stable_sort(defects_.begin(), defects_.end(),
                     [](const Defect& a, const Defect& b) { return a.kind < b.kind; });
  }

  void pair() {
    std::vector<std::vector<Index>> corners;
    std::vector<bool> is_cut;
    for (const WorkFace& face : faces_) {
      corners.push_back(face.corners);
      is_cut.push_back(face.cut);
    }
    mesh_ = reference_mesh(corners, vertex_count_, is_cut);
    edges_ = edges_of(mesh_);
  }

  [[nodiscard]] Index origin(Index h) const { return mesh_.origin[at(h)]; }

  // nonmanifold_edge, inconsistent_edge, or neither.
  [[nodiscard]] std::optional<DefectKind> kind_of(const std::vector<Index>& halfedges) const {
    if (halfedges.size() > 2) return DefectKind::nonmanifold_edge;
    if (halfedges.size() == 2 && origin(halfedges[0]) == origin(halfedges[1])) {
      return DefectKind::inconsistent_edge;
    }
    return std::nullopt;
  }

  [[nodiscard]] static std::int64_t count_groups(const std::map<Index, Index>& group_of) {
    std::set<Index> groups;
    for (const auto& [face, group] : group_of) groups.insert(group);
    return static_cast<std::int64_t>(groups.size());
  }

  [[nodiscard]] std::vector<Defect> edge_and_vertex_defects() const {
    std::vector<Defect> found;
    for (const auto& [ends, halfedges] : edges_) {
      const auto kind = kind_of(halfedges);
      if (!kind) continue;
      const Index face = faces_[at(mesh_.face[at(halfedges[0])])].input;
      found.push_back({*kind, FaceId(face), HalfedgeId(halfedges[0]), VertexId(ends.first),
                       VertexId(ends.second), static_cast<std::int64_t>(halfedges.size())});
    }
    for (Index v = 0; v < vertex_count_; ++v) {
      if (mesh_.outgoing[at(v)] == kInvalidIndex) {
        found.push_back({DefectKind::isolated_vertex, {}, {}, VertexId(v), {}, 0});
      }
      // One fan is one group, so only the others need the slow count.
      if (mesh_.fan_starts(v).size() < 2) continue;
      const std::int64_t groups = count_groups(groups_at(mesh_, edges_, v));
      if (groups < 2) continue;
      found.push_back({DefectKind::nonmanifold_vertex, {}, {}, VertexId(v), {}, groups});
    }
    std::stable_sort(found.begin(), found.end(), [](const Defect& a, const Defect& b) {
      return std::tuple(a.kind, a.halfedge, a.vertex) < std::tuple(b.kind, b.halfedge, b.vertex);
    });
    return found;
  }

  [[nodiscard]] std::optional<Error> first_failure() const {
    for (const Defect& d : defects_) {
      if (policy(d.kind) != Action::fail) continue;
      Error error;
      error.code = static_cast<ErrorCode>(d.kind);  // both enumerations begin with the defects
      error.element = d.face.valid() ? d.face.value : d.vertex.value;
      if (d.halfedge.valid()) error.element = d.halfedge.value;
      error.value = d.kind == DefectKind::repeated_vertex ? d.vertex.value : d.value;
      if (d.kind == DefectKind::out_of_range) error.limit = vertex_count_;
      if (d.kind == DefectKind::too_few_corners) error.limit = 3;
      if (d.kind == DefectKind::nonmanifold_edge) error.limit = 2;
      if (d.kind == DefectKind::nonmanifold_vertex) error.limit = 1;
      error.count = std::count_if(defects_.begin(), defects_.end(),
                                  [&](const Defect& other) { return other.kind == d.kind; });
      return error;
    }
    return std::nullopt;
  }

  bool drop(const std::set<Index>& dropped) {
    std::vector<WorkFace> kept;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (dropped.count(static_cast<Index>(f)) == 0) kept.push_back(faces_[f]);
    }
    faces_ = kept;
    return !dropped.empty();
  }

  bool skip_edges() {
    std::set<Index> dropped;
    for (const auto& [ends, halfedges] : edges_) {
      const auto kind = kind_of(halfedges);
      if (!kind || policy(*kind) != Action::skip) continue;
      bool has_against = *kind == DefectKind::inconsistent_edge;
      for (const Index h : halfedges) {
        if (h == halfedges[0]) continue;
        if (!has_against && origin(h) != origin(halfedges[0])) {
          has_against = true;
          continue;
        }
        dropped.insert(mesh_.face[at(h)]);
      }
    }
    return drop(dropped);
  }

  bool skip_groups() {
    if (policy(DefectKind::nonmanifold_vertex) != Action::skip) return false;
    std::set<Index> dropped;
    for (Index v = 0; v < vertex_count_; ++v) {
      if (mesh_.fan_starts(v).size() < 2) continue;
      const auto group_of = groups_at(mesh_, edges_, v);
      Index smallest = mesh_.halfedge_count();
      for (const auto& [face, group] : group_of) smallest = std::min(smallest, group);
      for (const auto& [face, group] : group_of) {
        if (group != smallest) dropped.insert(face);
      }
    }
    return drop(dropped);
  }

  void split_fans() {
    std::set<Index> vertices;
    for (const Defect& d : edge_and_vertex_defects()) {
      if (policy(d.kind) != Action::split) continue;
      vertices.insert(d.vertex.value);
      if (d.other.valid()) vertices.insert(d.other.value);
    }
    bool any = false;
    for (const FanStart& fan : mesh_.fans) {
      if (vertices.count(fan.vertex.value) == 0) continue;
      any = true;
      const Index copy = new_vertex(fan.vertex.value);
      Index h = fan.start.value;
      do {
        WorkFace& face = faces_[at(mesh_.face[at(h)])];
        face.corners[at(h - mesh_.first[at(mesh_.face[at(h)])])] = copy;
        const Index opposite = mesh_.opposite[at(h)];
        h = opposite == kInvalidIndex ? fan.start.value : mesh_.next[at(opposite)];
      } while (h != fan.start.value);
    }
    if (any) pair();
  }

  void skip_isolated() {
    if (policy(DefectKind::isolated_vertex) != Action::skip) return;
    std::vector<Index> kept;
    std::map<Index, Index> new_number;
    for (Index v = 0; v < vertex_count_; ++v) {
      if (mesh_.outgoing[at(v)] == kInvalidIndex) continue;
      new_number[v] = static_cast<Index>(kept.size());
      kept.push_back(input_vertex_[at(v)]);
    }
    is_renumbered_ |= kept.size() != input_vertex_.size();
    input_vertex_ = kept;
    vertex_count_ = static_cast<Index>(kept.size());
    for (WorkFace& face : faces_) {
      for (Index& v : face.corners) v = new_number[v];
    }
    pair();
  }

  [[nodiscard]] ReferenceBuild output() const {
    ReferenceBuild result{mesh_, defects_, {}, {}, 0, 0};
    if (faces_.size() != input_.faces.size()) {
      for (const WorkFace& face : faces_) result.faces_new_to_old.push_back(face.input);
    }
    if (is_renumbered_) result.vertices_new_to_old = input_vertex_;
    result.edge_count = static_cast<std::int64_t>(edges_.size());
    for (const auto& [ends, halfedges] : edges_)
      result.boundary_edge_count += halfedges.size() == 1;
    return result;
  }

  const PlainFaces& input_;
  const Policies& policies_;
  Index vertex_count_;
  std::vector<Index> input_vertex_;
  bool is_renumbered_ = false;  // some vertex was added or dropped
  std::vector<WorkFace> faces_;
  std::vector<Defect> defects_;
  ReferenceMesh mesh_;
  EdgeMap edges_;
};

}  // namespace

Result<ReferenceBuild> reference_build(const PlainFaces& input, const Policies& policies) {
  return Build(input, policies).run();
}

}  // namespace hedgerow::test
