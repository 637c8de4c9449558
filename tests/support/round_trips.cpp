#include "support/round_trips.h"

#include <algorithm>
#include <span>

#include "hedgerow/adjacency.h"
#include "hedgerow/boundary.h"
#include "hedgerow/corner_table.h"
#include "hedgerow/dcel.h"
#include "hedgerow/directed_edge.h"
#include "hedgerow/nonmanifold_edge.h"
#include "hedgerow/radial.h"
#include "hedgerow/split_edge.h"
#include "hedgerow/winged_edge.h"
#include "support/serial.h"

namespace hedgerow::test {

namespace {

template <class T>
bool is_same(std::span<T> a, std::span<T> b) {
  return std::ranges::equal(a, b);
}

bool is_same(const Connectivity& a, const Connectivity& b) {
  if (a.form() != b.form() || a.is_triangle_mesh() != b.is_triangle_mesh()) return false;
  if (!is_same(a.origin(), b.origin()) || !is_same(a.opposite(), b.opposite())) return false;
  if (!is_same(a.outgoing(), b.outgoing()) || !is_same(a.fans(), b.fans())) return false;
  if (a.is_explicit() != b.is_explicit()) return false;
  if (!a.is_explicit()) return true;
  const auto column = [](const auto& values) {
    return std::span(values.data(), static_cast<std::size_t>(values.size()));
  };
  const PolygonView va = a.polygons();
  const PolygonView vb = b.polygons();
  return is_same(column(va.next_of), column(vb.next_of)) &&
         is_same(column(va.face_of), column(vb.face_of)) &&
         is_same(column(va.first_of), column(vb.first_of));
}

/// "" if the conversion and the way back give the mesh again, or refuse it with this code where
/// they have to.
template <class Make, class Back>
std::string check(const char* what, const Connectivity& mesh, bool has_place, ErrorCode refusal,
                  const Make& make, const Back& back) {
  const auto made = make(mesh);
  if (!has_place) {
    const bool is_refused = !made && made.error().code == refusal;
    return is_refused ? "" : std::string(what) + " takes what it has no place for";
  }
  if (!made) return std::string(what) + " refuses it: " + name(made.error().code);
  const auto mesh_again = back(*made);
  if (!mesh_again) return std::string(what) + " goes not back: " + name(mesh_again.error().code);
  if constexpr (requires { mesh_again->mesh; }) {
    return is_same(mesh_again->mesh, mesh) ? "" : std::string(what) + " comes back changed";
  } else {
    return is_same(*mesh_again, mesh) ? "" : std::string(what) + " comes back changed";
  }
}

std::string check_records(const Connectivity& mesh) {
  std::string fault;
  const auto note = [&](std::string&& found) {
    if (fault.empty()) fault = std::move(found);
  };
  const bool is_triangles = mesh.is_triangle_mesh();
  note(check(
      "corner table", mesh, is_triangles, ErrorCode::not_triangles,
      [](const Connectivity& m) { return build_corner_table(m, kSerial); },
      [](const CornerTable& t) { return build_connectivity(t, kSerial); }));
  note(check(
      "directed edges", mesh, is_triangles, ErrorCode::not_triangles,
      [](const Connectivity& m) { return build_directed_edges(m, kSerial); },
      [](const DirectedEdges& e) { return build_connectivity(e, kSerial); }));
  note(check(
      "DCEL", mesh, true, ErrorCode{}, [](const Connectivity& m) { return build_dcel(m, kSerial); },
      [](const Dcel& d) { return build_connectivity(d); }));
  note(check(
      "split edges", mesh, true, ErrorCode{},
      [](const Connectivity& m) { return build_split_edges(m, kSerial); },
      [](const SplitEdges& e) { return build_connectivity(e); }));
  return fault;
}

// Vertices come back as orbits, numbered as they are met; and those to the last byte.
std::string check_adjacency(const Connectivity& mesh) {
  const auto numbered = build_connectivity(build_adjacency(mesh, kSerial));
  if (!numbered) return std::string("adjacency goes not back: ") + name(numbered.error().code);
  if (!is_same(numbered->opposite(), mesh.opposite())) return "adjacency comes back changed";
  return check(
      "adjacency", *numbered, true, ErrorCode{},
      [](const Connectivity& m) -> Result<Adjacency> { return build_adjacency(m, kSerial); },
      [](const Adjacency& a) { return build_connectivity(a); });
}

std::string check_winged_edges(const Connectivity& mesh, bool has_boundary) {
  // Without boundary half-edges the forms do not differ, and the default one comes back.
  if (mesh.form() == Form::closed && !has_boundary) return "";
  return check(
      "winged-edge tables", mesh, mesh.fans().empty(), ErrorCode::nonmanifold_vertex,
      [](const Connectivity& m) { return build_winged_edges(m); },
      [](const WingedEdgeTables& t) { return build_connectivity(t); });
}

std::string check_nonmanifold_edges(const Connectivity& mesh) {
  const RadialCycles cycles = build_radial(mesh, kSerial);
  std::string fault = check(
      "non-manifold edges", mesh, true, ErrorCode{},
      [&](const Connectivity& m) { return build_nonmanifold_edges(m, cycles); },
      [](const NonmanifoldEdges& e) { return build_connectivity(e); });
  if (!fault.empty()) return fault;
  const auto again = build_connectivity(*build_nonmanifold_edges(mesh, cycles));
  const auto column = [](const RadialCycles& c) {
    return std::span(c.column().data(), static_cast<std::size_t>(c.column().size()));
  };
  return is_same(column(again->cycles), column(cycles)) ? "" : "radial cycles come back changed";
}

}  // namespace

std::string find_lossy_round_trip(const Connectivity& mesh) {
  const auto closed = close_boundary(mesh, kSerial);
  if (!closed) return std::string("closed form: ") + name(closed.error().code);
  const auto opened = open_boundary(*closed, kSerial);
  if (!opened || !is_same(*opened, mesh)) return "the closed form comes back changed";
  const bool has_boundary = closed->halfedge_count() > mesh.halfedge_count();
  std::string fault;
  for (const Connectivity* form : {&mesh, &*closed}) {
    if (fault.empty()) fault = check_records(*form);
    if (fault.empty()) fault = check_adjacency(*form);
    if (fault.empty()) fault = check_winged_edges(*form, has_boundary);
    if (!fault.empty() && form == &*closed) fault += " (closed form)";
  }
  return fault.empty() ? check_nonmanifold_edges(mesh) : fault;
}

}  // namespace hedgerow::test
