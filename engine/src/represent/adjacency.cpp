#include "hedgerow/adjacency.h"

#include <utility>
#include <vector>

#include "at.h"
#include "hedgerow/boundary.h"
#include "hedgerow/circulate.h"
#include "kernels/halfedge_records.h"
#include "kernels/join_sets.h"
#include "represent/number_halfedges.h"
#include "represent/record_ids.h"

namespace hedgerow {

namespace {

// Calls visit(orbit, h) for all half-edges, orbit by orbit of the rotation, in the order of the
// smallest half-edge of each. Returns how many orbits there are.
template <class Visit>
Index for_each_orbit(const AdjacencyView& mesh, const Visit& visit) {
  std::vector<bool> is_met(at(mesh.halfedge_count()), false);
  Index count = 0;
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    if (is_met[at(i)]) continue;
    const auto meet = [&](HalfedgeId h) {
      is_met[at(h.value)] = true;
      visit(count, h);
    };
    HalfedgeId h(i);
    do {
      meet(h);
      const HalfedgeId across = mesh.opposite[h];
      h = across.valid() ? mesh.next(across) : across;
    } while (h.valid() && h.value != i);
    // What ended on the boundary goes on the other way.
    if (!h.valid()) {
      for (h = mesh.opposite[mesh.prev(HalfedgeId(i))]; h.valid();
           h = mesh.opposite[mesh.prev(h)]) {
        meet(h);
      }
    }
    ++count;
  }
  return count;
}

// Records as half-edges, with orbits for vertices.
class AdjacencySource {
 public:
  explicit AdjacencySource(const Adjacency& adjacency)
      : adjacency_(adjacency), origin_(adjacency.halfedges.size()) {}
  /// \pre the links are good
  void find_vertices() {
    vertex_count_ = for_each_orbit(AdjacencyView(adjacency_), [&](Index orbit, HalfedgeId h) {
      origin_[at(h.value)] = orbit;
    });
  }

  [[nodiscard]] Index record_count() const noexcept { return adjacency_.halfedge_count(); }
  [[nodiscard]] Index vertex_count() const noexcept { return vertex_count_; }
  [[nodiscard]] Index face_count() const noexcept { return adjacency_.face_count(); }
  [[nodiscard]] bool exists(Index) const noexcept { return true; }
  [[nodiscard]] Index origin(Index r) const noexcept { return origin_[at(r)]; }
  [[nodiscard]] Index opposite(Index r) const noexcept { return record(r).opposite.value; }
  [[nodiscard]] Index face(Index r) const noexcept { return record(r).face.value; }
  [[nodiscard]] Index next(Index r) const noexcept { return record(r).next.value; }
  [[nodiscard]] Index prev(Index r) const noexcept { return record(r).prev.value; }
  [[nodiscard]] Index face_record(Index f) const noexcept {
    return adjacency_.face_halfedge[at(f)].value;
  }
  template <class Visit>
  void for_each_start(const Visit&) const {}

 private:
  [[nodiscard]] const AdjacencyRecord& record(Index r) const noexcept {
    return adjacency_.halfedges[at(r)];
  }

  const Adjacency& adjacency_;
  std::vector<Index> origin_;
  Index vertex_count_ = 0;
};

Result<void> check_ranges(const AdjacencySource& source, Form form) {
  const Index count = source.record_count();
  const auto check = [&](Index r, Index entry, Index limit, bool may_lack) -> Result<void> {
    const bool is_good = (entry >= 0 && entry < limit) || (may_lack && entry == kInvalidIndex);
    if (is_good) return {};
    return fail({ErrorCode::index_out_of_range, r, entry, limit});
  };
  const bool is_open = form == Form::open;
  for (Index r = 0; r < count; ++r) {
    if (auto ok = check(r, source.opposite(r), count, is_open); !ok) return ok;
    if (auto ok = check(r, source.face(r), source.face_count(), !is_open); !ok) return ok;
    if (auto ok = check(r, source.next(r), count, false); !ok) return ok;
    if (auto ok = check(r, source.prev(r), count, false); !ok) return ok;
  }
  for (Index f = 0; f < source.face_count(); ++f) {
    if (auto ok = check(f, source.face_record(f), count, false); !ok) return ok;
  }
  return {};
}

Result<void> check_links(const AdjacencySource& source) {
  const auto expect = [](Index element, Index found, Index wanted) -> Result<void> {
    if (found == wanted) return {};
    return fail({ErrorCode::inconsistent_table, element, found, wanted});
  };
  for (Index r = 0; r < source.record_count(); ++r) {
    const Index next = source.next(r);
    const Index across = source.opposite(r);
    if (auto ok = expect(next, source.prev(next), r); !ok) return ok;
    if (auto ok = expect(next, source.face(next), source.face(r)); !ok) return ok;
    if (across == kInvalidIndex) continue;
    if (auto ok = expect(across, source.opposite(across), r); !ok) return ok;
    if (across == r) return fail({ErrorCode::inconsistent_table, r, r, kInvalidIndex});
  }
  for (Index f = 0; f < source.face_count(); ++f) {
    const Index r = source.face_record(f);
    if (auto ok = expect(r, source.face(r), f); !ok) return ok;
  }
  return {};
}

}  // namespace

Adjacency build_adjacency(const Connectivity& mesh, const Execution& execution) {
  return mesh.visit([&](const auto& view) {
    Adjacency adjacency{Buffer<AdjacencyRecord>(at(view.halfedge_count())),
                        Buffer<HalfedgeId>(at(view.face_count())), mesh.form()};
    par::for_each_range(execution, view.halfedge_count(), detail::kRecordGrain,
                        [&](IndexRange range) {
                          kernels::scatter_adjacency(range, view, adjacency.halfedges.data());
                        });
    for (Index f = 0; f < view.face_count(); ++f) {
      adjacency.face_halfedge[at(f)] = view.first(FaceId(f));
    }
    return adjacency;
  });
}

Result<Connectivity> build_connectivity(const Adjacency& adjacency) {
  AdjacencySource source(adjacency);
  if (const Result<void> good = check_ranges(source, adjacency.form); !good) {
    return fail(good.error());
  }
  if (const Result<void> good = check_links(source); !good) return fail(good.error());
  source.find_vertices();
  auto numbered = detail::HalfedgeMaker(source).run();
  if (!numbered) return fail(numbered.error());
  // Without boundary half-edges the maker takes the default form; the other has the same numbers.
  if (numbered->mesh.form() == adjacency.form) return std::move(numbered->mesh);
  return close_boundary(numbered->mesh, Execution::serial());
}

AdjacencySummary summarise(const Adjacency& adjacency) {
  const AdjacencyView mesh(adjacency);
  AdjacencySummary summary;
  summary.faces = mesh.face_count();
  summary.vertices = for_each_orbit(mesh, [](Index, HalfedgeId) {});
  std::vector<Index> parent(at(mesh.halfedge_count()));
  kernels::fill_singletons({0, mesh.halfedge_count()}, parent.data());
  std::vector<bool> is_in_loop(at(mesh.halfedge_count()), false);
  for (Index i = 0; i < mesh.halfedge_count(); ++i) {
    const HalfedgeId h(i);
    const HalfedgeId across = mesh.opposite[h];
    summary.edges += !across.valid() || h < across;
    kernels::join_sets(parent.data(), i, mesh.next(h).value);
    if (across.valid()) kernels::join_sets(parent.data(), i, across.value);
    const bool is_boundary = !across.valid() || !mesh.face(h).valid();
    if (!is_boundary || is_in_loop[at(i)]) continue;
    ++summary.boundary_loops;
    for (const HalfedgeId g : boundary_loop(mesh, h)) is_in_loop[at(g.value)] = true;
  }
  for (Index i = 0; i < mesh.halfedge_count(); ++i) summary.components += parent[at(i)] == i;
  return summary;
}

}  // namespace hedgerow
