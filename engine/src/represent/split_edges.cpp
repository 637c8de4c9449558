#include <utility>

#include "at.h"
#include "hedgerow/split_edge.h"
#include "kernels/halfedge_records.h"
#include "parallel/parallel.h"
#include "represent/check_records.h"
#include "represent/forms.h"
#include "represent/number_halfedges.h"
#include "represent/record_ids.h"

namespace hedgerow {

namespace {

class SplitEdgeSource {
 public:
  explicit SplitEdgeSource(const SplitEdges& edges) noexcept : edges_(edges) {}

  [[nodiscard]] Index record_count() const noexcept { return edges_.end_count(); }
  [[nodiscard]] Index vertex_count() const noexcept { return edges_.vertex_count(); }
  [[nodiscard]] Index face_count() const noexcept { return edges_.face_count(); }
  [[nodiscard]] bool exists(Index) const noexcept { return true; }
  [[nodiscard]] Index origin(Index r) const noexcept { return end(r).vertex.value; }
  [[nodiscard]] Index opposite(Index r) const noexcept { return end(r).opposite.value; }
  [[nodiscard]] Index face(Index r) const noexcept { return end(r).face.value; }
  [[nodiscard]] Index next(Index r) const noexcept { return end(opposite(r)).clockwise.value; }
  [[nodiscard]] Index prev(Index r) const noexcept {
    return opposite(end(r).counter_clockwise.value);
  }
  [[nodiscard]] Index face_record(Index f) const noexcept { return edges_.face_edge[at(f)].value; }
  template <class Visit>
  void for_each_entry(Index r, const Visit& visit) const {
    const SplitEdge& e = end(r);
    for (const HalfedgeId entry : {e.opposite, e.clockwise, e.counter_clockwise}) {
      visit(entry.value);
    }
  }
  template <class Visit>
  void for_each_start(const Visit& visit) const {
    for (const HalfedgeId start : edges_.vertex_edge) visit(start.value);
    for (const FanStart& fan : edges_.fans) visit(fan.start.value);
  }

 private:
  [[nodiscard]] const SplitEdge& end(Index r) const noexcept { return edges_.ends[at(r)]; }

  const SplitEdges& edges_;
};

}  // namespace

Result<SplitEdges> build_split_edges(const Connectivity& mesh, const Execution& execution) {
  return detail::in_closed_form(
      mesh, execution, [&](const Connectivity& closed) -> Result<SplitEdges> {
        const PolygonView view = closed.polygons();
        SplitEdges edges{
            Buffer<SplitEdge>(at(view.halfedge_count())),
            detail::ids_of<HalfedgeId>(closed.outgoing(), execution),
            detail::ids_of<HalfedgeId>({view.first_of.data(), at(view.face_count())}, execution),
            Buffer<FanStart>::copy_of(closed.fans()), mesh.form()};
        par::for_each_range(execution, view.halfedge_count(), detail::kRecordGrain,
                            [&](IndexRange range) {
                              kernels::scatter_split_edges(range, view, edges.ends.data());
                            });
        return edges;
      });
}

Result<NumberedMesh> build_connectivity(const SplitEdges& edges) {
  const SplitEdgeSource source(edges);
  if (const Result<void> good = detail::RecordCheck(source).run(); !good) {
    return fail(good.error());
  }
  auto numbered = detail::HalfedgeMaker(source).run();
  if (!numbered) return fail(numbered.error());
  return detail::to_form(std::move(*numbered), edges.form, Execution::serial());
}

}  // namespace hedgerow
