#pragma once

#include <utility>

#include "hedgerow/boundary.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/execution.h"
#include "hedgerow/numbered_mesh.h"
#include "hedgerow/result.h"

namespace hedgerow::detail {

/// What `make(mesh)` returns for the mesh in the closed form, made for the call if it is not.
template <class Function>
auto in_closed_form(const Connectivity& mesh, const Execution& execution, const Function& make)
    -> decltype(make(mesh)) {
  if (mesh.form() == Form::closed) return make(mesh);
  const Result<Connectivity> closed = close_boundary(mesh, execution);
  if (!closed) return fail(closed.error());
  return make(*closed);
}

/// The same in the default form.
template <class Function>
auto in_open_form(const Connectivity& mesh, const Execution& execution, const Function& make)
    -> decltype(make(mesh)) {
  if (mesh.form() == Form::open) return make(mesh);
  const Result<Connectivity> opened = open_boundary(mesh, execution);
  if (!opened) return fail(opened.error());
  return make(*opened);
}

/// The mesh in the form asked for.
inline Result<Connectivity> to_form(Connectivity&& mesh, Form form, const Execution& execution) {
  if (mesh.form() == form) return std::move(mesh);
  return form == Form::closed ? close_boundary(mesh, execution) : open_boundary(mesh, execution);
}

/// The same; records whose half-edges go have none.
inline Result<NumberedMesh> to_form(NumberedMesh&& numbered, Form form,
                                    const Execution& execution) {
  Result<Connectivity> mesh = to_form(std::move(numbered.mesh), form, execution);
  if (!mesh) return fail(mesh.error());
  for (HalfedgeId& h : numbered.halfedge_of_record) {
    if (h.value >= mesh->halfedge_count()) h = HalfedgeId();
  }
  return NumberedMesh{std::move(*mesh), std::move(numbered.halfedge_of_record)};
}

}  // namespace hedgerow::detail
