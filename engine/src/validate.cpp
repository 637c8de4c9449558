#include "hedgerow/validate.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <tuple>

#include "kernels/check_relations.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

using kernels::MeshColumns;
using kernels::Relation;

constexpr Index kCheckGrain = 1 << 14;  // elements a task

struct RelationText {
  std::uint8_t invariant;
  ElementKind kind;
  const char* text;
};

// Indexed by `Relation`. Where a value has to be in range, `expected` is the count it must stay
// below.
constexpr RelationText kRelations[] = {
    {1, ElementKind::halfedge, "opposite[h] != h"},
    {1, ElementKind::halfedge, "opposite[opposite[h]] == h"},
    {1, ElementKind::halfedge, "opposite[h] != -1 in the closed form"},
    {2, ElementKind::halfedge, "origin[opposite[h]] == origin[next[h]]"},
    {2, ElementKind::halfedge, "origin[next[opposite[h]]] == origin[h]"},
    {3, ElementKind::halfedge, "face[next[h]] == face[h]"},
    {3, ElementKind::halfedge, "h is the next of exactly one half-edge"},
    {4, ElementKind::face, "face[first[f]] == f"},
    {4, ElementKind::face, "f has at least three half-edges"},
    {5, ElementKind::vertex, "origin[outgoing[v]] == v"},
    {5, ElementKind::vertex, "origin[fan start] == v"},
    {5, ElementKind::vertex, "the rotations of v meet a half-edge at most once"},
    {5, ElementKind::halfedge, "a rotation of origin[h] meets h"},
    {5, ElementKind::vertex, "outgoing[v] != -1 where v has fans"},
    {5, ElementKind::mesh, "fans[i - 1].vertex <= fans[i].vertex"},
    {5, ElementKind::vertex, "the fans of v ascend by their smallest half-edge"},
    {6, ElementKind::vertex, "an open fan starts where opposite[prev[start]] == -1"},
    {6, ElementKind::vertex, "a fan on the boundary starts where face[start] == -1"},
    {7, ElementKind::halfedge, "origin[h] is a vertex"},
    {7, ElementKind::halfedge, "opposite[h] is a half-edge or -1"},
    {7, ElementKind::halfedge, "next[h] is a half-edge"},
    {7, ElementKind::halfedge, "face[h] is a face, or -1 in the closed form"},
    {7, ElementKind::vertex, "outgoing[v] is a half-edge or -1"},
    {7, ElementKind::face, "first[f] is a half-edge"},
    {7, ElementKind::mesh, "fans[i].vertex is a vertex"},
    {7, ElementKind::mesh, "fans[i].start is a half-edge"},
    {8, ElementKind::face, "first[f] <= first[f + 1]"},
    {8, ElementKind::face, "first[f] == 3 f in a triangle mesh"},
    {8, ElementKind::mesh, "first begins at 0 and ends behind the half-edges of faces"},
    {8, ElementKind::halfedge, "first[face[h]] <= h < first[face[h] + 1]"},
    {8, ElementKind::halfedge, "next[h] == h + 1, or first[face[h]] at the end"}};
static_assert(std::size(kRelations) == static_cast<std::size_t>(Relation::next_in_a_row) + 1);

class Validator {
 public:
  Validator(const MeshColumns& mesh, const Execution& execution)
      : mesh_(mesh), execution_(execution) {}

  std::vector<Violation> run() {
    const auto halfedges = static_cast<std::size_t>(mesh_.halfedge_count);
    check_all(mesh_.halfedge_count,
              [&](Index h, const auto& report) { kernels::check_halfedge(h, mesh_, report); });
    if (mesh_.is_explicit()) {
      check_ends_of_first();
      check_all(mesh_.face_count,
                [&](Index f, const auto& report) { kernels::check_face(f, mesh_, report); });
      // In the default form, rows of half-edges without a fault are a permutation by themselves.
      if (mesh_.is_closed_form || !found_.empty()) check_permutation();
    }
    check_all(static_cast<Index>(mesh_.fans.size()),
              [&](Index i, const auto& report) { kernels::check_fan(i, mesh_, report); });
    Buffer<std::uint8_t> met(halfedges, std::uint8_t{0});
    check_all(mesh_.vertex_count, [&](Index v, const auto& report) {
      kernels::check_vertex(v, mesh_, met.data(), report);
    });
    check_all(mesh_.halfedge_count, [&](Index h, const auto& report) {
      kernels::check_met(h, mesh_, met.data(), report);
    });
    sort_found();
    return std::move(found_);
  }

 private:
  static Violation violation(Relation relation, Index element, std::int64_t expected,
                             std::int64_t got) noexcept {
    const RelationText& r = kRelations[static_cast<std::size_t>(relation)];
    return {r.invariant, r.kind, element, r.text, expected, got};
  }

  template <class Check>
  void check_all(Index count, const Check& check) {
    const Index chunk_count = count / kCheckGrain + (count % kCheckGrain != 0);
    std::vector<std::vector<Violation>> parts(static_cast<std::size_t>(chunk_count));
    par::for_each_task(execution_, chunk_count, [&](Index chunk, Index) {
      auto& part = parts[static_cast<std::size_t>(chunk)];
      const auto report = [&](Relation relation, Index element, std::int64_t expected,
                              std::int64_t got) {
        part.push_back(violation(relation, element, expected, got));
      };
      const Index end = chunk + 1 < chunk_count ? (chunk + 1) * kCheckGrain : count;
      for (Index i = chunk * kCheckGrain; i < end; ++i) check(i, report);
    });
    for (const auto& part : parts) found_.insert(found_.end(), part.begin(), part.end());
  }

  void check_ends_of_first() {
    const Index end = mesh_.first_of[mesh_.face_count];
    const bool is_good_end = mesh_.is_closed_form ? end >= 0 && end <= mesh_.halfedge_count
                                                  : end == mesh_.halfedge_count;
    if (mesh_.first_of[0] != 0) {
      found_.push_back(violation(Relation::last_first, 0, 0, mesh_.first_of[0]));
    }
    if (!is_good_end) {
      found_.push_back(
          violation(Relation::last_first, mesh_.face_count, mesh_.halfedge_count, end));
    }
  }

  void check_permutation() {
    Buffer<Index> count(static_cast<std::size_t>(mesh_.halfedge_count), Index{0});
    for (Index h = 0; h < mesh_.halfedge_count; ++h) {
      const Index next = mesh_.next_of[h];
      if (mesh_.has_halfedge(next)) ++count[static_cast<std::size_t>(next)];
    }
    check_all(mesh_.halfedge_count, [&](Index h, const auto& report) {
      const Index got = count.data()[h];
      if (got != 1) report(Relation::one_predecessor, h, 1, got);
    });
  }

  void sort_found() {
    std::sort(found_.begin(), found_.end(), [](const Violation& a, const Violation& b) {
      const auto key = [](const Violation& v) {
        return std::tuple(v.invariant, v.kind, v.element);
      };
      if (key(a) != key(b)) return key(a) < key(b);
      if (const int order = std::strcmp(a.relation, b.relation); order != 0) return order < 0;
      return std::tuple(a.expected, a.got) < std::tuple(b.expected, b.got);
    });
  }

  const MeshColumns& mesh_;
  const Execution& execution_;
  std::vector<Violation> found_;
};

void check_length(const char* relation, std::int64_t expected, std::int64_t got,
                  std::vector<Violation>& found) {
  if (expected != got) {
    found.push_back({7, ElementKind::mesh, kInvalidIndex, relation, expected, got});
  }
}

// Columns of other lengths than these cannot be read side by side at all.
std::vector<Violation> check_lengths(const Connectivity& mesh) {
  std::vector<Violation> found;
  const auto halfedges = static_cast<std::int64_t>(mesh.origin().size());
  check_length("length of opposite", halfedges, static_cast<std::int64_t>(mesh.opposite().size()),
               found);
  if (mesh.is_explicit()) {
    const PolygonView view = mesh.polygons();
    check_length("length of next", halfedges, view.next_of.size(), found);
    check_length("length of face", halfedges, view.face_of.size(), found);
  } else if (halfedges > 0 || mesh.form() == Form::closed) {
    check_length("next, face and first are stored or arithmetic", 1, mesh.is_implicit(), found);
    check_length("length of origin is a multiple of 3", 0, halfedges % 3, found);
  }
  return found;
}

MeshColumns columns_of(const Connectivity& mesh) noexcept {
  MeshColumns columns;
  columns.origin = mesh.origin().data();
  columns.opposite = mesh.opposite().data();
  columns.outgoing = mesh.outgoing().data();
  columns.fans = mesh.fans();
  columns.vertex_count = mesh.vertex_count();
  columns.halfedge_count = mesh.halfedge_count();
  columns.face_count = mesh.face_count();
  columns.is_closed_form = mesh.form() == Form::closed;
  columns.is_triangle_mesh = mesh.is_triangle_mesh();
  if (mesh.is_explicit()) {
    const PolygonView view = mesh.polygons();
    columns.next_of = view.next_of.data();
    columns.face_of = view.face_of.data();
    columns.first_of = view.first_of.data();
  }
  return columns;
}

}  // namespace

std::vector<Violation> validate(const Connectivity& mesh, const Execution& execution) {
  std::vector<Violation> found = check_lengths(mesh);
  if (!found.empty()) return found;
  const MeshColumns columns = columns_of(mesh);
  return Validator(columns, execution).run();
}

}  // namespace hedgerow
