#include "hedgerow/dcel.h"

#include <utility>

#include "at.h"
#include "kernels/halfedge_records.h"
#include "parallel/parallel.h"
#include "represent/check_records.h"
#include "represent/forms.h"
#include "represent/number_halfedges.h"
#include "represent/record_ids.h"

namespace hedgerow {

namespace {

class DcelSource {
 public:
  explicit DcelSource(const Dcel& dcel) noexcept : dcel_(dcel) {}

  [[nodiscard]] Index record_count() const noexcept { return dcel_.halfedge_count(); }
  [[nodiscard]] Index vertex_count() const noexcept { return dcel_.vertex_count(); }
  [[nodiscard]] Index face_count() const noexcept { return dcel_.face_count(); }
  [[nodiscard]] bool exists(Index) const noexcept { return true; }
  [[nodiscard]] Index origin(Index r) const noexcept { return record(r).origin.value; }
  [[nodiscard]] Index opposite(Index r) const noexcept { return record(r).opposite.value; }
  [[nodiscard]] Index face(Index r) const noexcept { return record(r).face.value; }
  [[nodiscard]] Index next(Index r) const noexcept { return record(r).next.value; }
  [[nodiscard]] Index prev(Index r) const noexcept { return record(r).prev.value; }
  [[nodiscard]] Index face_record(Index f) const noexcept {
    return dcel_.face_halfedge[at(f)].value;
  }
  template <class Visit>
  void for_each_entry(Index r, const Visit& visit) const {
    for (const Index entry : {opposite(r), next(r), prev(r)}) visit(entry);
  }
  template <class Visit>
  void for_each_start(const Visit& visit) const {
    for (const HalfedgeId start : dcel_.vertex_halfedge) visit(start.value);
    for (const FanStart& fan : dcel_.fans) visit(fan.start.value);
  }

 private:
  [[nodiscard]] const DcelHalfedge& record(Index r) const noexcept {
    return dcel_.halfedges[at(r)];
  }

  const Dcel& dcel_;
};

}  // namespace

Result<Dcel> build_dcel(const Connectivity& mesh, const Execution& execution) {
  return detail::in_closed_form(mesh, execution, [&](const Connectivity& closed) -> Result<Dcel> {
    const PolygonView view = closed.polygons();
    Dcel dcel{Buffer<DcelHalfedge>(at(view.halfedge_count())),
              detail::ids_of<HalfedgeId>(closed.outgoing(), execution),
              detail::ids_of<HalfedgeId>({view.first_of.data(), at(view.face_count())}, execution),
              Buffer<FanStart>::copy_of(closed.fans()), mesh.form()};
    par::for_each_range(
        execution, view.halfedge_count(), detail::kRecordGrain,
        [&](IndexRange range) { kernels::scatter_dcel(range, view, dcel.halfedges.data()); });
    return dcel;
  });
}

Result<NumberedMesh> build_connectivity(const Dcel& dcel) {
  const DcelSource source(dcel);
  if (const Result<void> good = detail::RecordCheck(source).run(); !good) {
    return fail(good.error());
  }
  auto numbered = detail::HalfedgeMaker(source).run();
  if (!numbered) return fail(numbered.error());
  return detail::to_form(std::move(*numbered), dcel.form, Execution::serial());
}

}  // namespace hedgerow
